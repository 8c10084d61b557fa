#include "core/base/text/range_text.h"
#include "core/base/text/text.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

/** "0.4 (12)": median and largest [%]. */
std::string FormatChange(const ChangeSummary& change) {
  if (change.num == 0) return "n/a";
  return FormatSignificant(100.0 * change.median, 2) + " (" +
         FormatSignificant(100.0 * change.max, 2) + ")";
}

std::string FormatChanges(const std::vector<NumericsSummary>& summaries) {
  std::vector<std::string> head = {"change [%] in", "seat", "held"};
  for (const NumericsMeasure& measure : ListNumericsMeasures()) head.emplace_back(measure.title);
  TextTable table(head);
  for (const NumericsSummary& summary : summaries) {
    for (const SeatNumerics& seat : summary.seats) {
      std::vector<std::string> row = {summary.variant,
                                      seat.seat == Seat::kUnknown ? "n/a" : NameOf(seat.seat),
                                      std::to_string(seat.num_held)};
      for (const ChangeSummary& change : seat.changes) row.push_back(FormatChange(change));
      table.AddRow(row);
    }
  }
  return table.Format();
}

}  // namespace

std::string FormatNumericsTables(const std::vector<NumericsSummary>& summaries,
                                 const std::vector<NumericsComparison>& comparisons) {
  TextTable table({"variant", "trials", "held before", "held now", "flips", "seat flips", "flagged",
                   "others above 10 %"});
  int num_flips = 0, num_failures = 0;
  bool leaves_out = false;
  for (const NumericsSummary& summary : summaries) {
    leaves_out = leaves_out || summary.num_left_out > 0;
    table.AddRow({summary.variant,
                  FormatCountOf(summary.num_trials, summary.num_trials + summary.num_left_out),
                  std::to_string(summary.num_successes_before),
                  std::to_string(summary.num_successes), std::to_string(summary.num_flips),
                  std::to_string(summary.num_seat_flips), std::to_string(summary.num_flagged),
                  std::to_string(summary.num_large)});
    num_flips += summary.num_flips;
    num_failures += summary.num_numerical_failures;
  }
  std::string text = table.Format() +
                     (leaves_out ? "n of N trials: the others are not finished, or the variant's "
                                   "backend cannot move them\n"
                                 : "") +
                     "flagged: held, but reseated or caged; above 10 %: grip, sigma or breaking "
                     "force of the other held\n\n" +
                     FormatChanges(summaries) + "median (largest) of each seat\n";
  if (num_failures > 0) text += FormatCount(num_failures, "numerical failure") + '\n';
  if (num_flips == 0) return text + "\nno verdict flips\n";

  TextTable flips({"flips in", "hand", "object", "grasp", "trial", "before", "after"});
  for (const NumericsComparison& comparison : comparisons) {
    if (!comparison.is_flipped()) continue;
    const PlannedTrial& plan = comparison.before.plan;
    flips.AddRow({comparison.variant, plan.hand, plan.object, plan.grasp,
                  std::to_string(plan.trial), NameOf(comparison.before.result.outcome),
                  NameOf(comparison.after.result.outcome)});
  }
  return text + '\n' + flips.Format();
}

}  // namespace graspbench
