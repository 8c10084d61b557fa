#include "core/trial/measures/object_in_hand.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace graspbench {
namespace {

constexpr double kReseatedRise = 0.005;   // [m]
constexpr double kReseatedShare = 0.43;   // of the object's height
constexpr double kReseatedSlide = 0.001;  // [m]
constexpr double kCagedForce = 1.5;       // [N]
constexpr double kCagedWeights = 5.0;

/** Returns null if the trial ended before this moment. */
const SceneSnapshot* FindSnapshot(const TrialResult& result, Moment moment) {
  const auto found =
      std::find_if(result.snapshots.begin(), result.snapshots.end(),
                   [moment](const SceneSnapshot& snapshot) { return snapshot.moment == moment; });
  return found == result.snapshots.end() ? nullptr : &*found;
}

Displacement CalcDisplacement(const Pose& before, const Pose& after) {
  const Eigen::Matrix3d turn = before.linear().transpose() * after.linear();
  return {(after.translation() - before.translation()).norm(), Eigen::AngleAxisd(turn).angle()};
}

}  // namespace

void SeatMeter::Observe(const std::vector<HandContact>& contacts, double step) {
  const auto is_of_another_link = [&](const HandContact& contact) {
    return contact.link != contacts.front().link;
  };
  if (std::none_of(contacts.begin(), contacts.end(), is_of_another_link)) return;
  double speed = contacts.front().slip_speed;
  for (const HandContact& contact : contacts) speed = std::min(speed, contact.slip_speed);
  slide_ += step * speed;
}

void SeatMeter::End(const Place& place, TrialResult& result) const {
  if (!first_) return;
  result.closure_rise = place.height - first_->height;
  result.closure_displacement =
      (place.X_PalmOcm.translation() - first_->X_PalmOcm.translation()).norm();
  result.closure_slide = slide_;
}

Seat FindSeat(const TrialResult& result) {
  if (std::isnan(result.closure_rise) || std::isnan(result.closure_slide) ||
      std::isnan(result.object_height)) {
    return Seat::kUnknown;
  }
  const double rise_limit = std::max(kReseatedRise, kReseatedShare * result.object_height);
  return result.closure_rise > rise_limit && result.closure_slide > kReseatedSlide ? Seat::kReseated
                                                                                   : Seat::kKept;
}

const char* NameOf(Seat seat) {
  return seat == Seat::kKept ? "kept" : seat == Seat::kReseated ? "reseated" : "";
}

bool IsCaged(const TrialResult& result) {
  // NaN if weight or force is missing.
  return IsSuccess(result.outcome) &&
         result.stability.hold.normal_force <
             std::fmin(kCagedForce, kCagedWeights * result.weight) &&
         !std::isnan(result.weight);
}

bool TouchesPalmAtEnd(const TrialResult& result) {
  std::map<std::string, bool> touches;  // by link
  for (const ContactEvent& event : result.contact_events) {
    if (event.digit != "palm" || event.kind == ContactEventKind::kSlip) continue;
    touches[event.link] = event.kind != ContactEventKind::kLost;
  }
  return std::any_of(touches.begin(), touches.end(), [](const auto& link) { return link.second; });
}

Disturbance CalcDisturbance(const TrialResult& result) {
  Disturbance disturbance;
  const SceneSnapshot* start = FindSnapshot(result, Moment::kPreGrasp);
  const SceneSnapshot* end = FindSnapshot(result, Moment::kLifted);
  if (!start || !end) return disturbance;
  const SceneSnapshot* closed = FindSnapshot(result, Moment::kClosed);
  disturbance.before_lift = CalcDisplacement(start->X_WO, closed ? closed->X_WO : end->X_WO);
  disturbance.in_hand =
      CalcDisplacement(start->X_WH.inverse() * start->X_WO, end->X_WH.inverse() * end->X_WO);
  return disturbance;
}

void ClosingMeter::Observe(Phase phase, const Pose& X_WO) {
  if (!start_ && phase >= Phase::kClosure) start_ = X_WO;
  has_ended_ = has_ended_ || phase >= Phase::kStabilisation;
  if (!has_ended_) last_ = X_WO;
}

Displacement ClosingMeter::Calc() const {
  return start_ ? CalcDisplacement(*start_, last_) : Displacement();
}

}  // namespace graspbench
