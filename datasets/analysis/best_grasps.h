#pragma once
/** @file
Which grasp suits an object best, found from the trials of a session with all grasps, beside the
one that a session takes when nobody chooses (datasets/session/session_plan.h).

Best: most successes by rate; of equal rates the one with the larger median sigma of its successes;
then the first by id. The usual grasp is worse when it succeeds less often on the same draws by more
than chance: the 95 % interval of the paired difference (core/statistics/proportion.h) lies above
zero. The best of several is better than it is by luck, too, which the interval does not know; so
"worse" is a hint to run more trials, not a proof. */

#include <string>
#include <vector>

#include "core/statistics/proportion.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/session/session_inputs.h"

namespace graspbench {

struct BestGrasp {
  const CellSummary* best = nullptr;
  const CellSummary* usual = nullptr;  ///< null: the session has no trial of it
  Interval gain;                       ///< best less usual, on the draws of both
  bool is_usual_worse() const { return usual && gain.low > 0.0; }
};

/** One for each hand and object with a finished trial, in the plan's order.
@param inputs  of the session. The result points into `summary`. */
std::vector<BestGrasp> FindBestGrasps(const Session& session, const SessionSummary& summary,
                                      const SessionInputs& inputs);

}  // namespace graspbench
