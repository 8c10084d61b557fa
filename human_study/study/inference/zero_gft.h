#pragma once
/** @file
What GFT a study would report if all digits had touched at once.

GFT = T_all - T_first is a range: errors of the single contacts cannot make it negative, so they
lift a true zero. Every kept trial is drawn repeatedly with its own digits and the
uncertainties of its own contacts (markers' places, gaps, noise, frame rate, filter, push and speed
of that very trial stand behind them), without what all digits of a trial share. */

#include <limits>
#include <vector>

namespace graspbench {

struct StudyTrial;

struct ZeroGft {
  int num_trials = 0;                                        ///< with two contacts or more
  double median = std::numeric_limits<double>::quiet_NaN();  ///< over trials and draws [s]
  /** 95 % of single trials with a true zero lie below [s]. */
  double limit = std::numeric_limits<double>::quiet_NaN();
};

ZeroGft CalcZeroGft(const std::vector<StudyTrial>& trials);

}  // namespace graspbench
