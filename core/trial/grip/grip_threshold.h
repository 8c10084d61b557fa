#pragma once
/** @file
The grip threshold of a draw: the smallest grip, a margin or a force, with which its trial succeeds.
Found by bisection of the same draw over seventeen grips, equal steps of the logarithm from the
least to the largest of a scale:

    grip_k = least (most / least)^(k / 16),   k = 0 .. 16

First the largest grip, then four halvings, then one trial that asks halfway between threshold and
largest grip, where a draw that is not monotone may fail again, which bisection alone cannot see; or
the least grip, where none has failed. Where the largest grip fails, as of an object that is squeezed
out of the hand, weaker ones are asked, 8, 4, 2, then 12, until one holds: such a draw has a
threshold and is not monotone. So a threshold costs at most kMostThresholdTrials trials, and is the
smallest grip that was asked and held. */

#include <functional>
#include <optional>
#include <vector>

#include "core/grasp/strategy.h"

namespace graspbench {

inline constexpr int kMostThresholdTrials = 6;
inline constexpr int kMostGripPlace = 16;

/** What is bisected. */
struct ThresholdScale {
  GripMode mode;
  const char* name;  ///< for people
  const char* key;   ///< of the setting
  const char* unit;
  double least, most;
};
inline constexpr ThresholdScale kThresholdScales[] = {
    {GripMode::kMargin, "margin", "strategy.grip_margin", "", 1.0, 16.0},
    {GripMode::kForce, "force", "strategy.grip_force_n", "N", 0.1, 12.8}};

/** grip_k. @pre 0 <= place <= kMostGripPlace */
double CalcGripAt(const ThresholdScale& scale, int place);

struct GripThreshold {
  std::optional<int> place;     ///< none: no grip that was asked held
  bool is_below_range = false;  ///< it succeeds with the least grip: the threshold is no larger
  bool is_monotone = true;      ///< as far as was asked
  std::vector<int> failed, succeeded;  ///< places, in the order of asking
  std::optional<int> next;             ///< must be asked to go on; the threshold is not found yet
};

/** @param succeeds  a trial of the draw with the grip at this place; none: it is not known.
@param most  the largest place to ask, at least 0: no drive gives more. */
GripThreshold FindGripThreshold(const std::function<std::optional<bool>(int place)>& succeeds,
                                int most = kMostGripPlace);

}  // namespace graspbench
