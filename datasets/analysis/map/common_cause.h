#pragma once
/** @file
Whether contact times correlate with success in trials without delay, and whether a common cause
explains the correlation.

For one hand, x is success and y the rank of GFT (a digit that never touched has the last rank).
Both are residuals of a least-squares fit on object and levels, without factors that scale the
draws, since those are possible causes. r_xy is their correlation over all trials without delay. A
common cause may explain it: with z the residual size of the draw's offset or turn,

    r_z = (r_xy - r_xz r_yz) / sqrt((1 - r_xz^2) (1 - r_yz^2))

95 % intervals come from resampling objects. A cause is named if the interval of r excludes zero and
|r_z| is less than half of |r|; of several causes, the one that leaves the smallest |r_z|. This
explains most of the correlation but does not show that times are harmless: delays decide whether
times matter (simultaneity_map.h).

The finding of a map for a hand, for success and the last digit, strongest evidence first:

    matters        by intervention: the cell over all regions, or a region, costs or gains
    common cause   delays make no difference (none or ceiling), but late digits correlate with
                   failures, and a cause is named
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
  std::string cause;  ///< name of the cause that explains it; empty: none
};

/** Computes the relation of a hand; no answer without trials or with fewer than five objects. */
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

/** Describes the finding in one sentence: "tum: common cause. By delays of ..". */
std::string DescribeFinding(const SimultaneityMap& map, const Answer<NaturalRelation>& natural,
                            const std::string& hand);

}  // namespace graspbench
