#pragma once
/** @file
The grip threshold of a draw: the smallest grip, a margin or a force, with which its trial succeeds.
Found by bisection of the same draw on a logarithmic scale over a range: the largest grip, four
halvings, and one trial more. That one asks halfway between threshold and largest grip, where a draw
that is not monotone may fail again, which bisection alone cannot see; or for the least grip, where
none has failed. So a threshold costs at most kMostThresholdTrials trials and is known to a sixteenth
of the range's logarithm: over 1 to 16, 19 %. It is the smallest grip that succeeded. */

#include <functional>
#include <vector>

#include "core/base/units.h"

namespace graspbench {

inline constexpr int kMostThresholdTrials = 6;

struct ThresholdRange {
  double least = 1.0, most = 16.0;
};

struct GripThreshold {
  double value = kUnset;        ///< NaN: it fails with the largest grip
  bool is_below_range = false;  ///< it succeeds with the least grip: the threshold is no larger
  bool is_monotone = true;      ///< as far as was asked
  std::vector<double> failed, succeeded;  ///< grips, in the order of asking
};

/** @param succeeds  a trial of the draw with this grip.
@param range  0 < least < most */
GripThreshold FindGripThreshold(const ThresholdRange& range,
                                const std::function<bool(double grip)>& succeeds);

}  // namespace graspbench
