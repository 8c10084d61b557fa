#pragma once
/** @file
What a person who looks at a trial would notice at once: contacts after the hand has long stopped,
an object that moves before anything touched it. Each doubt has a code for programs and a text with
the numbers; none repairs anything.

  carried_unseen: the object was not recorded and the hand carried it: the digits moved together,
    not against each other. Against the laboratory they then stop where the hand stops, not where
    they touch, so contacts are not determined.
  other_lift_axis: the object moves far, but not along the stated direction of the lift, or it first
    goes another way and in the end 1.5 times as far there; names the likely one (recordings with y
    up). A thing that goes two ways at once is not seen.
  wrong_unit: the digits are as far apart as no hand's (more than 0.3 m in a quarter of the samples,
    or never 12 mm), or faster than any reach (5 m/s over 50 ms); names the unit that would explain
    it.
  label_jump: a digit is elsewhere from one frame to the next, faster against the other digits than
    3 m/s and farther than 15 mm and eight of its usual steps, was where it was for five frames and
    stays for five: markers that exchanged their labels. In slow recordings only long jumps are seen
    (100 mm at 30 Hz).
  no_movement: no digit moves as far as 20 mm.
  far_digit: one digit is as far from the others as no hand's, which alone would be a hand.
  hand_centred: the hand's middle stays at the origin of its own coordinates (landmarks of a camera
    that count from the hand): its reach is not in them.
  wrong_shape: in the hold the markers lie inside the stated solid, or all are farther from it than
    from any skin they could sit on (than the given pad offsets explain).
  contact_after_end: a contact later after the end of the movement than a limit, unless the object
    was recorded and is lifted after it: the wrist may wait while the digits close.
  closure_too_long: GCT above a limit.
  detectors_disagree: another detector finds a digit's contact elsewhere, beyond a limit and beyond
    three times what both say of their uncertainty. "multiplied" and "speed" are not asked: they
    stop at thresholds, which slow arrivals cross early.
  moved_before_touch: the object left its place before the first contact, beyond a limit and three
    times both uncertainties.

Limits are for adults who reach for things on a table; a limit of 0 turns its doubt off. */

#include <string>
#include <vector>

#include "human_study/events/contact_detector.h"
#include "human_study/events/lift_off.h"
#include "human_study/events/movement.h"

namespace graspbench {

struct PlausibilityOptions {
  double max_contact_after_end = 0.3;  ///< [s]
  double max_closure_time = 1.5;       ///< [s]
  double max_hold_distance = 0.02;     ///< of the digits' markers from the surface, median [m]
  double max_disagreement = 0.1;       ///< [s]
  double max_moved_before = 0.05;      ///< [s]
  double min_carried = 0.05;           ///< a shorter way is no carrying [m]
  bool lift_axis = true;               ///< look for other directions of the lift

  template <class V>
  void Visit(V&& v) {
    v("max_contact_after_end_s", max_contact_after_end, {"a later contact is doubted", 0});
    v("max_closure_time_s", max_closure_time, {"a longer closure is doubted", 0});
    v("max_hold_distance_m", max_hold_distance,
      {"markers farther from the surface make the shape doubted", 0});
    v("max_disagreement_s", max_disagreement,
      {"of the detectors, before their contacts are doubted", 0});
    v("max_moved_before_s", max_moved_before,
      {"an object that moved earlier before its first contact is doubted", 0});
    v("min_carried_m", min_carried, {"a shorter way is no carrying", 0});
    v("lift_axis", lift_axis, "look for other directions of the lift");
  }
};

struct Doubt {
  std::string code;
  std::string text;
};

/** Doubt about the unit of length, or about the one digit that would explain it. */
std::vector<Doubt> FindWrongUnit(const std::vector<DigitTrack>& digits);

/** Doubt about labels that jump to another marker. */
std::vector<Doubt> FindLabelJump(const std::vector<DigitTrack>& digits);

/** Doubt about a recording without a reach. */
std::vector<Doubt> FindNoMovement(const std::vector<DigitTrack>& digits);

/** Doubt about what the places are counted from: the middle of the digits stays within 0.15 m of the
origin and within 0.05 m of its own place in every sample that shows all digits, which are at least
half of them. */
std::vector<Doubt> FindHandCentred(const std::vector<DigitTrack>& digits);

/** Doubt about the object's shape, from where the markers are in the hold.
@param is_lifted  the object is: the digits are at it, then. */
std::vector<Doubt> FindWrongShape(const std::vector<DigitContactEvents>& contacts, bool is_lifted,
                                  const PlausibilityOptions& options);

/** How far the digits moved together up to the hold: the longest stretch that ends there and in
which no distance between two of them leaves that of the hold by more than 3 mm (or four standard
deviations of the tips' noise); the largest distance of their middle from that in the hold [m]. 0
when fewer than two are seen in the hold. */
double CalcJointTravel(const std::vector<SmoothPath>& tips, const Hold& hold);

/** Doubt about an object that is carried but was not recorded. */
std::vector<Doubt> FindUnseenCarrying(const std::vector<SmoothPath>& tips, const Hold& hold,
                                      const PlausibilityOptions& options);

/** Doubt about the direction of the lift of a recorded object that was not lifted along it. */
std::vector<Doubt> FindOtherLiftAxis(const ObjectTravel& travel, const ObjectEvents& object,
                                     const LiftOffOptions& lift_off,
                                     const PlausibilityOptions& options);

/** Doubts about contacts. @param gct  [s]; NaN: missing, as everything else that may be. */
std::vector<Doubt> FindContactDoubts(const std::vector<DigitContactEvents>& contacts,
                                     const Movement& movement, const ObjectEvents& object,
                                     double gct, const PlausibilityOptions& options);

}  // namespace graspbench
