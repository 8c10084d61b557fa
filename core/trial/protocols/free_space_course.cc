#include "core/trial/protocols/free_space_course.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/physics/implicit_world.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr char kPalm[] = "palm";
constexpr size_t kTouchesThatRelease = 2;  // of digits and palm

}  // namespace

FreeSpaceCourse::FreeSpaceCourse(const ProfiledScene& scene, const FreeSpaceProfile& profile,
                                 double trace_interval)
    : scene_(scene),
      profile_(profile),
      is_lift_(RowFromName(kProfileTests, profile.test, "test").value == ProfileTest::kLift),
      world_(MakeWorld()),
      trace_interval_(trace_interval) {}

WorldCopy FreeSpaceCourse::MakeWorld() const {
  return WorldCopy(ImplicitWorld(*scene_.hand, *scene_.object, profile_.sim,
                                 is_lift_ ? TablePresence::kPresent : TablePresence::kNone));
}

void FreeSpaceCourse::PutObject(WorldState& state) const {
  state.R_WO = scene_.X_WO.linear();
  state.p_WOcm = scene_.X_WO * scene_.object->mass_properties.p_OOcm;
  state.w_WO = state.v_WOcm = Vector3d::Zero();
}

void FreeSpaceCourse::Begin() {
  WorldState state;
  state.gravity_W = MakeGravity(profile_.sim);
  state.X_WH = scene_.X_WO * scene_.stages.front().X_OH;
  state.q = scene_.stages.front().q;
  state.u = VectorXd::Zero(world_->dynamics().num_dofs());
  PutObject(state);
  world_->Reset(state);
  if (is_traced()) Trace();
}

void FreeSpaceCourse::Push(const Vector3d& acceleration_W) {
  world_->SetExternalLoad(world_->mass_properties().mass * acceleration_W, Vector3d::Zero());
}

int FreeSpaceCourse::CountSteps(double duration) const {
  return std::max(1, static_cast<int>(std::lround(duration / profile_.sim.step)));
}

void FreeSpaceCourse::Go(const Pose& X_WH0, const VectorXd& q0, const Pose& X_WH1,
                         const VectorXd& q1, double duration) {
  const int num_steps = CountSteps(duration);
  const int updates = profile_.stage_updates > 0 ? profile_.stage_updates : num_steps;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_WH0.linear().transpose() * X_WH1.linear()));
  const Vector3d moved = X_WH1.translation() - X_WH0.translation();
  for (int step = 0; step < num_steps && report_.is_finite; ++step) {
    const double share = static_cast<double>(step * updates / num_steps + 1) / updates;
    command_.q = q0 + share * (q1 - q0);
    command_.X_WH = MakePose(
        X_WH0.linear() * Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix(),
        X_WH0.translation() + share * moved);
    if (profile_.stage_updates == 0) {
      command_.v_WH = moved / duration;
      command_.w_WH = X_WH0.linear() * turn.axis() * (turn.angle() / duration);
    }
    Step();
  }
  command_.v_WH = command_.w_WH = Vector3d::Zero();
}

bool FreeSpaceCourse::CloseOnHeld(const Pose& X_WH, const VectorXd& q, double duration) {
  const int num_steps = CountSteps(duration);
  command_.X_WH = X_WH;
  command_.q = q;
  for (int step = 0; step < num_steps; ++step) {
    Step();
    if (!report_.is_finite) return false;
    WorldState state = world_->state();
    PutObject(state);
    world_->Reset(state);
    if (ListTouching().size() >= kTouchesThatRelease) return true;
  }
  return false;
}

void FreeSpaceCourse::Wait(double duration) {
  const int num_steps = CountSteps(duration);
  for (int step = 0; step < num_steps && report_.is_finite; ++step) Step();
}

VectorXd FreeSpaceCourse::MakeCommand(const ScriptedStage& stage) const {
  VectorXd q = stage.q;
  if (scene_.hand->coupling != CouplingRule::kMiddleFirst) return q;
  for (size_t j = 0; j < scene_.hand->joints.size(); ++j) {
    const HandJoint& joint = scene_.hand->joints[j];
    if (joint.coupled_to < 0 || joint.is_mimic) continue;
    q[joint.coupled_to] += stage.q[static_cast<Eigen::Index>(j)];
  }
  return q;
}

ObjectMotion FreeSpaceCourse::CalcMoved(double height) const {
  const Pose X_WO = world_->CalcObjectPose();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(scene_.X_WO.linear().transpose() * X_WO.linear()));
  const Vector3d start = scene_.X_WO.translation() + Vector3d(0.0, 0.0, height);
  return {(X_WO.translation() - start).norm(), DegFromRad(turn.angle())};
}

std::vector<std::string> FreeSpaceCourse::ListTouching() const {
  const Hand& hand = *scene_.hand;
  std::vector<bool> touches(hand.digits.size(), false);
  bool palm_touches = false;
  for (size_t link = 0; link < report_.link_touches_object.size(); ++link) {
    if (!report_.link_touches_object[link]) continue;
    const int digit = hand.FindDigitOfLink(static_cast<int>(link));
    digit < 0 ? palm_touches = true : touches[static_cast<size_t>(digit)] = true;
  }
  std::vector<std::string> names;
  for (size_t d = 0; d < touches.size(); ++d) {
    if (touches[d]) names.push_back(hand.digits[d].id);
  }
  if (palm_touches) names.push_back(kPalm);
  return names;
}

void FreeSpaceCourse::Step() {
  report_ = world_->Step(command_);
  ++num_steps_;
  num_unconverged_ += !report_.converged;
  if (!is_traced() || !report_.is_finite) return;
  const double time = num_steps_ * profile_.sim.step;
  if (time >= trace_.back().time + trace_interval_ - 1e-9) Trace();
}

void FreeSpaceCourse::SetPhase(Phase phase) {
  if (is_traced()) {
    Trace();
    trace_.back().next_phase = phase;
  }
  phase_ = phase;
}

std::vector<TraceInstant> FreeSpaceCourse::TakeTrace() {
  if (is_traced() && !trace_.empty()) Trace();
  return std::move(trace_);
}

void FreeSpaceCourse::Trace() {
  if (!trace_.empty() && trace_.back().time == num_steps_ * profile_.sim.step) return;
  const WorldState& state = world_->state();
  TraceInstant instant;
  instant.time = num_steps_ * profile_.sim.step;
  instant.phase = instant.next_phase = phase_;
  instant.X_WH = state.X_WH;
  instant.X_WO = world_->CalcObjectPose();
  instant.q = state.q;
  instant.q_asked = command_.q;
  world_->FindHandContacts(instant.contacts);
  instant.grip_force = report_.grip_force;
  instant.table_force = report_.table_force;
  trace_.push_back(std::move(instant));
}

}  // namespace graspbench
