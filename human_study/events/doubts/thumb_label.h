#pragma once
/** @file
Whether the marker that is called the thumb's is on the thumb, from anatomy. Labels that are
exchanged through a whole file leave no jump to see (label_jump of plausibility.h), but

  * while the hand is open the tips of neighbouring fingers are a row and the thumb is off it: with
    the labels of thumb and one finger exchanged the row of the labelled fingers is longer than with
    them put right;
  * a thumb is shorter than a finger: its tip is nearer to the wrist. Of one public hand (kinesis,
    thumb and finger) it is nearer by 22 to 44 mm, of another, whose "wrist" is on the back of the
    hand, no farther than 10 mm.

Open are those of some 200 samples before the hold in which the thumb and that finger are at least 0.9
of their largest distance apart; each distance is the median over them. A row says so where it is
longer by 15 mm and a fifth, the wrist by 15 mm; a row is sure that is longer by 30 mm and 1.8 times
as long, whatever a "wrist" says that may be anywhere on the arm.

Not told: thumb and index alone without a wrist; fingers without a neighbour (thumb, index, little);
a pinch whose other fingers are curled into the palm, without a wrist or against it. */

#include <string>
#include <vector>

#include "human_study/events/contact_detector.h"
#include "human_study/events/reach_trial.h"

namespace graspbench {

enum class ThumbLabel {
  kTold,       ///< it is on the thumb; also of a recording without one
  kExchanged,  ///< a sure row says it is not, or row and wrist do: thumb_not_opposed
  kUnlikely,   ///< row or wrist alone says it is not
  kNotTold     ///< nothing says so, or one against the other
};

struct ThumbCheck {
  ThumbLabel label = ThumbLabel::kTold;
  std::string text;  ///< of kExchanged: which finger, what was found, what to do
};

/** @param contacts  of the digits of the trial: a digit that no detector finds touching takes no
part in the row. @param until  the hold, or the end of the trial [s]. */
ThumbCheck CheckThumb(const ReachTrial& trial, const std::vector<DigitContactEvents>& contacts,
                      double until);

}  // namespace graspbench
