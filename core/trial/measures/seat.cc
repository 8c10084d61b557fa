#include "core/trial/measures/seat.h"

#include <algorithm>
#include <cmath>

namespace graspbench {

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
  // Not a number where the weight or the force is none.
  return IsSuccess(result.outcome) &&
         result.stability.hold.normal_force <
             std::fmin(kCagedForce, kCagedWeights * result.weight) &&
         !std::isnan(result.weight);
}

}  // namespace graspbench
