#pragma once
/** @file
What a late digit does to each object, all regions of a map together: how often it was held without
delay and with each, and the effect of simultaneity_map.h. The 95 % interval comes from drawing the
object's pairs with replacement: it is of this object under the map's regions and draws, and says
nothing of other objects. It is not adjusted: of twenty objects one excludes zero by chance. */

#include <string>
#include <vector>

#include "datasets/analysis/map/simultaneity_map.h"

namespace graspbench {

struct RateWithDelay {
  double delay = 0.0;  ///< [s]
  double rate = kUnset;
};

struct ObjectEffect {
  std::string hand, object;
  LateDigit late = LateDigit::kNone;
  int num_pairs = 0;
  std::vector<RateWithDelay> rates;  ///< of success; without delay first
  double estimate = kUnset;          ///< of success, for 100 ms
  Answer<Interval> interval = NoAnswer{"no pair"};
  /** Late trials that ended otherwise than without delay, the first ones. */
  std::vector<std::string> changed;
};

/** "By object: with the last digit 0.3 s late success falls most for ..": of a hand; empty: it has
no such pairs. */
std::string DescribeObjects(const std::vector<ObjectEffect>& effects, const std::string& hand);

/** By hand and late digit, the largest loss first. */
std::vector<ObjectEffect> ListObjectEffects(const MapData& data);

}  // namespace graspbench
