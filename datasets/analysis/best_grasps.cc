#include "datasets/analysis/best_grasps.h"

#include <cmath>
#include <map>

#include "core/trial/outcome.h"

namespace graspbench {
namespace {

double CalcMedianSigma(const CellSummary& cell) {
  std::vector<double> sigmas;
  for (const TrialRecord* record : cell.records) {
    if (IsSuccess(record->result.outcome)) sigmas.push_back(record->result.stability.sigma);
  }
  const Spread spread = CalcSpread(sigmas);
  return spread.n > 0 ? spread.median : 0.0;
}

bool IsBetter(const CellSummary& a, const CellSummary& b) {
  if (a.tally.rate() != b.tally.rate()) return a.tally.rate() > b.tally.rate();
  const double sigma_a = CalcMedianSigma(a), sigma_b = CalcMedianSigma(b);
  return sigma_a != sigma_b ? sigma_a > sigma_b : a.grasp < b.grasp;
}

Interval CalcGain(const CellSummary& usual, const CellSummary& best) {
  std::map<int, bool> usual_successes;  // by number of the draw
  for (const TrialRecord* record : usual.records) {
    usual_successes[record->plan.trial] = IsSuccess(record->result.outcome);
  }
  PairedCounts counts;
  for (const TrialRecord* record : best.records) {
    const auto other = usual_successes.find(record->plan.trial);
    if (other != usual_successes.end()) {
      counts.Add(other->second, IsSuccess(record->result.outcome));
    }
  }
  return CalcPairedDifferenceInterval(counts);
}

}  // namespace

std::vector<BestGrasp> FindBestGrasps(const Session& session, const SessionSummary& summary,
                                      const SessionInputs& inputs) {
  SessionConfig usual = session.config;
  usual.grasps = {"best"};
  usual.trials = 1;
  usual = SessionConfigFromJson(ToJson(usual));  // without a camera that only chose grasps
  std::vector<BestGrasp> found;
  for (const PlannedTrial& planned : MakePlan(usual, inputs)) {
    BestGrasp row;
    row.hand = planned.hand;
    row.object = planned.object;
    for (const CellSummary& cell : summary.cells) {
      if (cell.hand != planned.hand || cell.object != planned.object) continue;
      if (cell.tally.finished == 0) continue;
      ++row.num_tried;
      if (cell.grasp == planned.grasp) row.usual = &cell;
      if (cell.tally.successes() == 0) continue;
      if (!row.best || IsBetter(cell, *row.best)) row.best = &cell;
    }
    if (row.num_tried == 0) continue;
    for (const CellSummary& cell : summary.cells) {
      const bool is_other = row.best && &cell != row.best && cell.tally.finished > 0;
      if (!is_other || cell.hand != row.hand || cell.object != row.object) continue;
      if (cell.tally.rate() == row.best->tally.rate()) row.tied.push_back(&cell);
    }
    if (row.best && row.usual) row.gain = CalcGain(*row.usual, *row.best);
    found.push_back(row);
  }
  return found;
}

}  // namespace graspbench
