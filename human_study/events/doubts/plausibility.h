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
  moved_before_touch: the object left its place before the first contact, beyond a limit and three
    times both uncertainties. Not told while a digit touched at an unresolved time.

Limits are for adults who reach for things on a table; a limit of 0 turns its doubt off. */

#include <string>
#include <vector>

#include "human_study/events/contact_detector.h"
#include "human_study/events/hold.h"
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
      {"of the detectors, beyond which the believed contact's interval covers both", 0});
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

/* Three more doubts, about the frames and what the markers stand for.

  frame_jump: frames are missing although the time stamps are even, or the frame of reference moved.
    A marker's own motion in a frame is the mean of its three steps before and its three after; its
    jump is what it goes beyond that, while the steps next to it stay as they were. All markers must
    say the same of one frame, in one of two ways. Either every marker of the hand that is seen, of
    at least three, jumps by more than twice its limit. Or all markers, the object's middle too,
    jump by the same number k >= 0.8 of their own motions, within the limit and half of that: those
    that move jump (three at least, or all), one at rest stays. The limit is the largest of 1 mm,
    four times the marker's usual jump (its noise), and what a jerk of 1000 m/s^3 makes of a healthy
    reach: 2 mm at 100 Hz, 9 mm at 60 Hz, 74 mm at 30 Hz. So a slow camera shows long losses only,
    and a hand at rest none.

  object_left_behind: in the grip of the hold, or without one of the recording's end, the digits rise
    together by 30 mm (or plausibility.min_carried_m, if that is less), and the recorded object
    stays: its marker is not on what the hand carries. One of four digits or more may move.
  thumb_not_opposed: in the hold another digit, not the thumb, is opposite all others: their labels
    are likely exchanged through the whole file. Not seen where a thing is narrower than the row of
    the fingers is long. */

/** Doubt about the frames, from digits, wrist and the middle of the object's markers. */
std::vector<Doubt> FindFrameJump(const ReachTrial& trial);

/** @param tips  filtered. @param travel  of the object, which was recorded and not lifted. */
std::vector<Doubt> FindLeftBehind(const std::vector<SmoothPath>& tips, const ObjectTravel& travel,
                                  const Hold& hold, const LiftOffOptions& lift_off,
                                  const PlausibilityOptions& options);

/** Of four digits or more with a thumb, all seen in the hold. */
std::vector<Doubt> FindSwappedThumb(const std::vector<DigitTrack>& digits,
                                    const std::vector<SmoothPath>& tips, const Hold& hold);

/** A warning, no doubt: thumb and index may carry each other's label. The thumb's marker was farther
from the wrist's than the index's (median from `begin` to the hold, by 5 mm), as no thumb is that
reaches for a thing, and in the hold the index is farther from the middle of the other digits than
the thumb. Both together spare a pinch whose other fingers are curled.
@param wrist  empty: not recorded, and nothing is said. @param begin  of the movement [s]. */
bool MayBeExchanged(const std::vector<DigitTrack>& digits, const std::vector<SmoothPath>& tips,
                    const Trajectory& wrist, double begin, const Hold& hold);

/** A warning, no doubt: before it rises along the stated direction the object goes another way, by
20 mm and three tenths of its rise, and 50 ms earlier: either it is drawn aside first or the
direction is not the recording's up, and then the lift-off is late. other_lift_axis
(plausibility.h) removes what goes farther than it rises. */
bool GoesElsewhereFirst(const ObjectTravel& travel, const EventTime& lift_off,
                        const LiftOffOptions& options);

}  // namespace graspbench
