#pragma once
/** @file
Where an object sits in the hand, and how far the hand moves it.

Some things have two stable places in one grasp: a ball stays at
the fingertips or is squeezed up between the bent fingers, and grips of the two differ by three to
four times. So grip force, sigma and contact times have one value per seat.

A trial is "reseated" when, between the first touch and the end of stabilisation, the object rose in
the hand by more than 0.43 of its height, and by more than 5 mm, and slid by more than 1 mm through
all digits that touched it at once. Half of the height is what takes the widest part of a round
thing past the digits. What digits carry up towards the palm without letting it slide, such as a
roll of tape, keeps its seat, and so does what they centre.

A success is "caged" when less normal force holds it than 1.5 N or five times its weight, whichever
is less: two contacts with friction 0.8 need 1.25 weights between them to hold by friction alone, so
what is held by a few weights or less may lie in the fingers rather than be held by them. All limits
are proposed by graspbench. */

#include <optional>
#include <vector>

#include "core/base/units.h"
#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/trial_result.h"

namespace graspbench {

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

/** The palm holds with the digits: whether it, or another link of no digit, touches the object when
the trial ends. */
bool TouchesPalmAtEnd(const TrialResult& result);

/** How far a hand moves an object while it grasps it, from the postures that a record keeps:

    before lift   the object's motion in the world from the start of closure to lift-off, or to the
                  end of a trial that ends earlier
    in the hand   the change of its pose in H from the start of closure to the end of the trial: how
                  far it is from where the plan has it in the hand

A shift is that of O, the centre of the object's bounding box; a turn is the angle about any axis. A
round object's turn means little. */
struct Disturbance {
  Displacement before_lift;
  Displacement in_hand;
};

/** All NaN for a trial that did not come to closure, or whose record came without its postures. */
Disturbance CalcDisturbance(const TrialResult& result);

/** In the world, from the start of closure to the last digit's touch or to where the strategy waits
no longer for it; told of every step of a trial. */
class ClosingMeter {
 public:
  void Observe(Phase phase, const Pose& X_WO);
  /** NaN without closure. */
  Displacement Calc() const;

 private:
  std::optional<Pose> start_;
  Pose last_ = Pose::Identity();
  bool has_ended_ = false;
};

}  // namespace graspbench
