#pragma once
/** @file
Whether two hands of one session differ in success, on the draws that both have: the same objects in
identical poses (datasets/analysis/pairs.h). The exact test is clustered by object
(core/statistics/paired_clusters.h); with several pairs of hands its p values are adjusted after
Holm. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "datasets/analysis/pairs.h"

namespace graspbench {

/** Success rate of `hand` minus that of `other`. */
struct HandDifference {
  std::string hand, other;
  int num_planned = 0;    ///< draws of both hands
  ChangeEstimate change;  ///< over the draws that both have finished
  double p = kUnset;      ///< adjusted; NaN: fewer than kFewestClusters objects, or undecided
};

/** Lists every two of these hands, in their order; those without a common draw are left out. Only
trials without condition count. */
std::vector<HandDifference> CompareHands(const Session& session,
                                         const std::vector<std::string>& hands);

/** Returns "mine minus tum, 30 pairs of 6 objects: -10.0 points (-20.0 to 0.0), p 0.2500, not
significant".
@param name, other  of the hands, as displayed. */
std::string DescribeHandDifference(const HandDifference& difference, const std::string& name,
                                   const std::string& other);

Json ToJson(const std::vector<HandDifference>& differences);

}  // namespace graspbench
