#pragma once
/** @file
Where an object sits in the hand. Some things have two stable places in one grasp: a ball stays at
the fingertips or is squeezed up between the bent fingers, and grips of the two differ by three to
four times. So grip force, sigma and contact times have one value per seat.

A trial is "reseated" when, between the first touch and the end of stabilisation, the object rose in
the hand by more than kReseatedShare of its height, and by more than kReseatedRise, and slid through
all digits that touched it at once. Half of the height is what takes the widest part of a round
thing past the digits. What digits carry up towards the palm without letting it slide, such as a
roll of tape, keeps its seat, and so does what they centre.

A success is "caged" when less normal force holds it than kCagedForce or kCagedWeights times its
weight, whichever is less: two contacts with friction 0.8 need 1.25 weights between them to hold by
friction alone, so what is held by a few weights or less may lie in the fingers rather than be held
by them. All limits are proposed by graspbench. */

#include <optional>
#include <vector>

#include "core/physics/world.h"
#include "core/trial/trial_result.h"

namespace graspbench {

inline constexpr double kReseatedRise = 0.005;   ///< [m]
inline constexpr double kReseatedShare = 0.43;   ///< of the object's height
inline constexpr double kReseatedSlide = 0.001;  ///< [m]
inline constexpr double kCagedForce = 1.5;       ///< [N]
inline constexpr double kCagedWeights = 5.0;

enum class Seat {
  kUnknown,   ///< the trial ended before lift-off, or its record is older than physics 11
  kKept,      ///< where the digits met it, or where they carried it
  kReseated,  ///< squeezed up to another place
};

inline constexpr Seat kSeats[] = {Seat::kKept, Seat::kReseated, Seat::kUnknown};

/** Follows the object in the hand while it closes; a value. */
class SeatMeter {
 public:
  struct Place {
    Pose X_PalmOcm = Pose::Identity();
    double height = 0.0;  ///< of the object's centre of mass above the palm's origin [m]
  };
  bool has_begun() const { return first_.has_value(); }
  void Begin(const Place& place) { first_ = place; }  ///< at the first touch
  /** After every step: what slides against all of two or more links slides through the hand. */
  void Observe(const std::vector<HandContact>& contacts, double step);
  /** Sets rise, displacement and slide of the closure; nothing before Begin. */
  void End(const Place& place, TrialResult& result) const;

 private:
  std::optional<Place> first_;
  double slide_ = 0.0;  // [m]
};

Seat FindSeat(const TrialResult& result);
const char* NameOf(Seat seat);  ///< "kept", "reseated"; "" of an unknown one

/** A success that holds with so little force; false where the weight is not recorded. */
bool IsCaged(const TrialResult& result);

}  // namespace graspbench
