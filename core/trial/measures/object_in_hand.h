#pragma once
/** @file
Position of an object in the hand, and its displacement by the hand.

Some objects have two stable positions in one grasp. A ball stays at the fingertips or is squeezed
up between the bent fingers, and the grip forces of the two differ by a factor of three to four.
Grip force, sigma and contact times are therefore specific to the position, the seat.

A trial is "reseated" if three conditions hold between the first touch and the end of stabilisation.
The object rose in the hand by more than 0.43 of its height, and by more than 5 mm, and it slid by
more than 1 mm through all digits that touched it at once. A rise by half of the height takes the
widest section of a round object past the digits. An object that the digits carry up towards the
palm without sliding, such as a roll of tape, keeps its seat, and so does one that they centre.

A success is "caged" if the normal force that holds the object is below 1.5 N and below five times
its weight. Two contacts with friction 0.8 need 1.25 weights between them to hold by friction alone.
An object held by a few weights or less may thus lie in the fingers rather than be held by them. All
limits are proposed by graspbench. */

#include <optional>
#include <vector>

#include "core/base/units.h"
#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/trial_result.h"

namespace graspbench {

enum class Seat {
  kUnknown,   ///< the trial ended before lift-off, or its record precedes physics version 11
  kKept,      ///< where the digits met the object, or to where they carried it
  kReseated,  ///< squeezed up to another position
};

inline constexpr Seat kSeats[] = {Seat::kKept, Seat::kReseated, Seat::kUnknown};

/** Follows the object in the hand during closure; a value type. */
class SeatMeter {
 public:
  struct Place {
    Pose X_PalmOcm = Pose::Identity();
    double height = 0.0;  ///< of the object's centre of mass above the palm's origin [m]
  };
  bool has_begun() const { return first_.has_value(); }
  void Begin(const Place& place) { first_ = place; }  ///< at the first touch
  /** Call after every step. If all contacts of two or more links slide, the object slides through
  the hand. */
  void Observe(const std::vector<HandContact>& contacts, double step);
  /** Sets rise, displacement and slide of the closure; does nothing before Begin. */
  void End(const Place& place, TrialResult& result) const;

 private:
  std::optional<Place> first_;
  double slide_ = 0.0;  // [m]
};

Seat FindSeat(const TrialResult& result);
const char* NameOf(Seat seat);  ///< "kept", "reseated"; "" if unknown

/** Whether a success is caged; false if the weight is not recorded. */
bool IsCaged(const TrialResult& result);

/** Whether the palm, or another link of no digit, touches the object at the end of the trial. */
bool TouchesPalmAtEnd(const TrialResult& result);

/** Displacement of an object by a hand during the grasp, from the postures that a record stores:

    before lift   motion of the object in the world from the start of closure to lift-off, or to an
                  earlier end of the trial
    in the hand   change of its pose in H from the start of closure to the end of the trial: its
                  deviation from the planned pose in the hand

A shift is that of O, the centre of the object's bounding box. A turn is the angle about any axis;
it means little for a round object. */
struct Disturbance {
  Displacement before_lift;
  Displacement in_hand;
};

/** Returns NaN for a trial that did not reach closure, or whose record has no postures. */
Disturbance CalcDisturbance(const TrialResult& result);

/** Motion of the object in the world, from the start of closure to the last digit's touch, or until
the strategy stops waiting for it. */
class ClosingMeter {
 public:
  void Observe(Phase phase, const Pose& X_WO);
  /** Returns NaN without closure. */
  Displacement Calc() const;

 private:
  std::optional<Pose> start_;
  Pose last_ = Pose::Identity();
  bool has_ended_ = false;
};

}  // namespace graspbench
