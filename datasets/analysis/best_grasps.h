#pragma once
/** @file
Which grasp suits an object best, found from the trials of a session with all grasps, beside the
one that a session takes when nobody chooses (datasets/plan/session_plan.h).

Best: most successes by rate, and one at least; of equal rates the one with the larger median sigma
of its successes; then the first by id. Those of its rate are as good by success. The usual grasp is
worse when it succeeds less often on the same draws by more than chance: the 95 % interval of the
paired difference (core/statistics/proportion.h) lies above zero. The best of several is better than
it is by luck, too, which the interval does not know; so
"worse" is a hint to run more trials, not a proof. */

#include <string>
#include <vector>

#include "core/statistics/proportion.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

struct BestGrasp {
  std::string hand, object;              ///< ids
  int num_tried = 0;                     ///< grasps with a finished trial
  const CellSummary* best = nullptr;     ///< null: none ever held the object
  std::vector<const CellSummary*> tied;  ///< others with the best one's rate
  const CellSummary* usual = nullptr;    ///< null: the session has no trial of it
  Interval gain;                         ///< best less usual, on the draws of both
  bool is_usual_worse() const { return best && usual && gain.low > 0.0; }
  bool is_usual_as_good() const {
    return best && usual && usual->tally.rate() == best->tally.rate();
  }
};

/** One for each hand and object with a finished trial, in the plan's order.
@param inputs  of the session. The result points into `summary`. */
std::vector<BestGrasp> FindBestGrasps(const Session& session, const SessionSummary& summary,
                                      const SessionInputs& inputs);

}  // namespace graspbench
