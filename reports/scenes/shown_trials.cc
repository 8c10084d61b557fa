#include "reports/scenes/shown_trials.h"

#include <algorithm>

namespace graspbench {
namespace {

constexpr size_t kMaxCells = 250;
constexpr size_t kMaxTrials = 3000;      // of the page
constexpr size_t kMinTrialsOfCell = 10;  // also where the page gets larger by it

}  // namespace

bool IsDrawnInFull(const CellSummary& cell, const SessionSummary& summary) {
  const size_t num_full = std::min(kMaxCells, summary.cells.size());
  return &cell < summary.cells.data() + num_full;
}

std::vector<const TrialRecord*> ChooseShownTrials(const CellSummary& cell,
                                                  const SessionSummary& summary) {
  const size_t num = cell.records.size();
  const size_t num_of_cell = std::max(kMaxTrials / summary.cells.size(), kMinTrialsOfCell);
  if (static_cast<size_t>(summary.total.finished) <= kMaxTrials || num <= num_of_cell) {
    return cell.records;
  }
  std::vector<const TrialRecord*> shown;
  for (size_t i = 0; i < num_of_cell; ++i) shown.push_back(cell.records[i * num / num_of_cell]);
  return shown;
}

std::string MakeTrialAnchor(const PlannedTrial& planned) { return "trial-" + planned.id; }

std::string MakeViewAnchor(const PlannedTrial& planned) { return "view-" + planned.id; }

std::string DescribeShownTrials(size_t num_shown, const CellSummary& cell) {
  if (num_shown == cell.records.size()) return {};
  return std::to_string(num_shown) + " of " + std::to_string(cell.records.size()) +
         " trials, evenly spaced; export/trials.csv has all of them.";
}

}  // namespace graspbench
