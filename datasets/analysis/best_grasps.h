#pragma once
/** @file
Which grasp suits an object best, from the trials of a session with all grasps, compared with the
grasp "best" that a session uses by default (datasets/plan/session_plan.h).

The best grasp has the highest success rate, with at least one success. Ties are broken by the
larger median sigma of the successes, then by id; grasps with the same rate are reported as tied.
The usual grasp is worse if it succeeds significantly less often on the same draws: the 95 %
interval of the paired difference (core/statistics/proportion.h) lies above zero. The interval does
not correct for selecting the best of several grasps, so "worse" is a reason to run more trials, not
a proof. */

#include <string>
#include <vector>

#include "core/statistics/proportion.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

struct BestGrasp {
  std::string hand, object;              ///< ids
  int num_tried = 0;                     ///< grasps with a finished trial
  const CellSummary* best = nullptr;     ///< null: no grasp ever held the object
  std::vector<const CellSummary*> tied;  ///< others with the best one's rate
  const CellSummary* usual = nullptr;    ///< null: the session has no trial of it
  Interval gain;                         ///< rate of best minus usual, on common draws
  bool is_usual_worse() const { return best && usual && gain.low > 0.0; }
  bool is_usual_as_good() const {
    return best && usual && usual->tally.rate() == best->tally.rate();
  }
};

/** Finds the best grasp for each hand and object with a finished trial, in the plan's order. The
result points into `summary`.
@param inputs  of the session. */
std::vector<BestGrasp> FindBestGrasps(const Session& session, const SessionSummary& summary,
                                      const SessionInputs& inputs);

}  // namespace graspbench
