// Where hand and object are when a trial on a table begins.

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/json.h"
#include "core/trial/protocols/table_lift.h"
#include "core/trial/rest_pose.h"
#include "core/vision/wrist_camera.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** The simulation starts this long before the hand could first touch anything [s]. */
constexpr double kLeadTime = 0.06;
constexpr double kSafeGap = 0.004;  ///< [m]

}  // namespace

std::string TableLift::FormatDraw() const {
  const TrialDraw& draw = setup_.draw;
  return FormatJson({setup_.object->id, draw.offset_x, draw.offset_y, draw.offset_yaw});
}

Sighting TableLift::Look(WristCamera* camera) const {
  std::unique_ptr<WristCamera> own;
  if (!camera) {
    own = std::make_unique<WristCamera>(setup_.hand, setup_.object, setup_.camera);
    camera = own.get();
  }
  return camera->FindObject(CalcStartPose(), ApplyError(setup_.grasp.q_pre), FormatDraw());
}

void TableLift::Position(WristCamera* camera) {
  if (setup_.sight) {
    const bool is_found = !setup_.sight->grasp.empty();
    notes_.result.sight_grasp = is_found ? setup_.sight->grasp : kNotSeenGrasp;
    notes_.not_seen = setup_.sight->reason;
    if (!is_found) return;
  }
  PlanarPose believed;
  switch (setup_.positioning) {
    case Positioning::kNominal:
      return;
    case Positioning::kTrue:
      believed = {setup_.draw.offset_x, setup_.draw.offset_y, setup_.draw.offset_yaw};
      break;
    case Positioning::kCamera: {
      const Sighting sighting = Look(camera);
      if (!sighting.is_found) {
        notes_.not_seen = sighting.reason;
        return;
      }
      believed = sighting.pose;
      break;
    }
  }
  notes_.result.believed_x = believed.x;
  notes_.result.believed_y = believed.y;
  notes_.result.believed_yaw = believed.yaw;
  const Pose X_WN = MakePose(MakeRotationRpy(0.0, 0.0, believed.yaw),  // N: where O is believed
                             Vector3d(believed.x, believed.y, 0.0));
  placement_.X_WH = X_WN * placement_.X_WH;
  placement_.approach_W = X_WN.linear() * placement_.approach_W;
}

Eigen::VectorXd TableLift::ApplyError(const Eigen::VectorXd& q_asked) const {
  Eigen::VectorXd q = q_asked + setup_.draw.joint_error;
  for (size_t j = 0; j < hand_.joints.size(); ++j) {
    const auto joint = static_cast<Eigen::Index>(j);
    q[joint] = std::clamp(q[joint], hand_.joints[j].lower, hand_.joints[j].upper);
  }
  ApplyCoupling(hand_, q);
  return q;
}

Pose TableLift::CalcStartPose() const {
  return CalcRestPose(setup_.draw.offset_x, setup_.draw.offset_y, setup_.draw.offset_yaw);
}

Pose TableLift::CalcBelievedPose() const {
  const TrialResult& known = notes_.result;
  if (std::isnan(known.believed_x)) return CalcRestPose(0.0, 0.0, 0.0);
  return CalcRestPose(known.believed_x, known.believed_y, known.believed_yaw);
}

Pose TableLift::CalcRestPose(double x, double y, double yaw) const {
  Pose X_WO = MakePose(Vector3d(x, y, 0.0));
  X_WO.rotate(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
  if (const std::optional<Pose> X_NO = FindRestPose(*setup_.object, setup_.sim)) {
    return X_WO * *X_NO;
  }
  X_WO.pretranslate(Vector3d(0.0, 0.0, -world_->collider().CalcLowestPoint(X_WO)));
  return X_WO;
}

Pose TableLift::CalcPlacingPose(double before_arrival) const {
  const double ahead = notes_.palm.offset() - notes_.strategy.CalcPlacingDistance(before_arrival);
  Pose X_WH = placement_.X_WH;
  X_WH.pretranslate(ahead * placement_.approach_W);
  return X_WH;
}

/** How long before the hand's arrival the simulation starts [s]: the part of the placing in which
nothing can touch is skipped. */
double TableLift::FindPlacingStart(const Pose& X_WO, const Eigen::VectorXd& q) {
  const double placing_time = setup_.strategy.placing_time;
  double before_arrival = 0.0;
  constexpr double kSearchStep = 0.01;
  for (; before_arrival < placing_time; before_arrival += kSearchStep) {
    const Pose X_WH = CalcPlacingPose(before_arrival);
    world_->dynamics().UpdatePositions(X_WH, q);
    if (world_->collider().CalcSmallestGap(world_->dynamics(), X_WO) > kSafeGap) break;
  }
  return std::min(std::max(before_arrival, setup_.strategy.closure_lead) + kLeadTime, placing_time);
}

void TableLift::Begin() {
  WorldState state;
  state.gravity_W = MakeGravity(setup_.sim);
  state.q = ApplyError(setup_.grasp.q_pre);
  state.u = Eigen::VectorXd::Zero(world_->dynamics().num_dofs());

  const Pose X_WO = CalcStartPose();
  state.R_WO = X_WO.linear();
  state.p_WOcm = X_WO * setup_.object->mass_properties.p_OOcm;
  if (!X_WO.matrix().allFinite() || !state.q.allFinite()) {
    throw Error(ErrorKind::kRange, "the object's start pose or a joint error is not finite");
  }
  notes_.rest_height = X_WO.translation().z();
  notes_.rest_position = state.p_WOcm;

  double before_arrival = 0.0;
  if (const GraspCourse& course = setup_.grasp.course; course.is_set()) {
    WorldCommand first;
    first.q = setup_.grasp.q_pre + setup_.draw.joint_error;
    notes_.grip.Command(first);
    state.q = ApplyError(first.q - setup_.draw.joint_error);
    before_arrival = course.duration();
    state.X_WH = placement_.X_WH * MakePose(CalcHandAway(course, 0.0));
    state.v_WH = placement_.X_WH.linear() * CalcHandSpeed(course, 0.0);
  } else {
    before_arrival = FindPlacingStart(X_WO, state.q);
    state.X_WH = CalcPlacingPose(before_arrival);
  }
  world_->Reset(state);
  notes_.start_gap = CalcGap(nullptr);
  notes_.rest_extent = CalcExtent();
  notes_.clear_time = setup_.strategy.placing_time - before_arrival;
  if (!setup_.arm || !StartReach()) notes_.strategy.StartPlacing(before_arrival);
  notes_.phase = notes_.strategy.phase();
}

}  // namespace graspbench
