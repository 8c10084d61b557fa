#include "core/trial/measures/seat.h"

#include <algorithm>
#include <cmath>

namespace graspbench {

Seat FindSeat(const TrialResult& result) {
  if (std::isnan(result.closure_rise)) return Seat::kUnknown;
  return result.closure_rise > kReseatedRise ? Seat::kReseated : Seat::kKept;
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
