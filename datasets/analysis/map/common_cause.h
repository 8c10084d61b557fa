#pragma once
/** @file
What correlates with success in trials without delay, and whether that is the digits' times.

Of one hand, x is success and y the rank of GFT (a digit that never touched: the last rank), each
less what object and levels explain (least squares; a factor that scales the draws is left in, for
it is a cause to be found); r_xy is their correlation over all trials without delay. It may come
from a cause of both: with z the size of the draw's offset or turn, treated alike,

    r_z = (r_xy - r_xz r_yz) / sqrt((1 - r_xz^2) (1 - r_yz^2))

95 % intervals from drawing objects. A cause is named where the interval of r excludes zero and
r_z is less than half of r; of several the one that leaves least. That says what most of the
relation goes back to, not that it is harmless: whether times matter is what delays decide
(simultaneity_map.h).

What a map finds of a hand, of success and the last digit, by the strongest design first:

    matters        by intervention: the cell of all trials, or a region, costs or gains
    common cause   delays make no difference (none or ceiling), yet late digits correlate with
                   failures,
                   for a cause that is named
    no effect      delays make no difference
    undecided      delays do not decide */

#include <string>
#include <vector>

#include "datasets/analysis/map/simultaneity_map.h"

namespace graspbench {

struct NaturalRelation {
  int num_trials = 0, num_objects = 0;
  double correlation = kUnset;  ///< < 0: late digits correlate with failures
  Interval interval;
  struct Cause {
    std::string name;  ///< "offset"
    double partial = kUnset;
    Interval interval;
  };
  std::vector<Cause> causes;
  std::string cause;  ///< name of the one that explains it; empty: none does
};

/** No answer without trials, for fewer than five objects, or where nothing varies. */
Answer<NaturalRelation> FindNaturalRelation(const MapData& data, const std::string& hand);

enum class MapFinding { kMatters, kCommonCause, kNoEffect, kUndecided };
struct MapFindingRow {
  MapFinding value;
  const char* name;
};
inline constexpr MapFindingRow kMapFindings[] = {{MapFinding::kMatters, "matters"},
                                                 {MapFinding::kCommonCause, "common cause"},
                                                 {MapFinding::kNoEffect, "no effect"},
                                                 {MapFinding::kUndecided, "undecided"}};

MapFinding FindWhatMatters(const SimultaneityMap& map, const Answer<NaturalRelation>& natural,
                           const std::string& hand);

/** One sentence with its design: "common cause: ..". */
std::string DescribeFinding(const SimultaneityMap& map, const Answer<NaturalRelation>& natural,
                            const std::string& hand);

}  // namespace graspbench
