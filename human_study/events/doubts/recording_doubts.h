#pragma once
/** @file
Three more doubts of plausibility.h, about the frames and what the markers stand for.

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

#include <vector>

#include "human_study/events/doubts/plausibility.h"

namespace graspbench {

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
