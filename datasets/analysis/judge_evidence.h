#pragma once
/** @file
How well measures of a grasp predict the judge's result: their rank correlation with the smallest
breaking force over all judged grasps, and how well measures taken before lift-off predict success.
Intervals come from resampling cells (hand, object, grasp), because trials of one cell are alike. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/statistics/bootstrap.h"
#include "core/trial/measures/object_in_hand.h"
#include "datasets/analysis/session_summary.h"

namespace graspbench {

struct RankEvidence {
  std::string measure;  ///< column of trials.csv
  Answer<BootstrapInterval> correlation;
};

struct RocEvidence {
  std::string measure;             ///< column of trials.csv
  Answer<BootstrapInterval> area;  ///< under the curve; 0.5 is chance
};

/** How often two rules agree on a judged grasp. */
struct Agreement {
  int num_both = 0, num_neither = 0;
  int num_first = 0, num_second = 0;  ///< passed by only one of them

  /** Share of judged grasps on which the two rules agree; NaN without any. */
  double share() const;
};

struct JudgeEvidence {
  int num_judged = 0;
  int num_cells = 0;                        ///< with a judged grasp
  int num_finished = 0, num_successes = 0;  ///< trials, judged or not; without numerical failures
  std::vector<RankEvidence> ranks;          ///< signs are set so that larger is better
  std::vector<RocEvidence> roc;             ///< over all finished trials; missing values count as 0
  std::vector<std::string> rules;           ///< names
  std::vector<std::vector<Agreement>> agreements;  ///< (rules x rules)
};

/** The judge's results for the held grasps of one cell with the same seat. */
struct CellLoads {
  const CellSummary* cell = nullptr;
  Seat seat = Seat::kUnknown;
  int num_judged = 0;
  Spread force;   ///< smallest of six pulls, in addition to the weight [N]
  Spread moment;  ///< smallest of six twists [N m]
  Spread sigma;   ///< [N]
  Spread epsilon;
};
/** Lists the cells that have a judged trial, seat by seat. The result points into `summary`. */
std::vector<CellLoads> ListCellLoads(const SessionSummary& summary);

JudgeEvidence CalcJudgeEvidence(const std::vector<TrialRecord>& records);
Json ToJson(const JudgeEvidence& evidence);

}  // namespace graspbench
