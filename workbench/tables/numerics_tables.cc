#include "workbench/tables/numerics_tables.h"

#include "core/base/text/text.h"
#include "workbench/tables/text_table.h"

namespace graspbench {

std::string FormatNumericsTables(const std::vector<NumericsSummary>& summaries,
                                 const std::vector<NumericsComparison>& comparisons) {
  TextTable table({"variant", "trials", "held before", "held now", "flips", "GCT [ms]", "max",
                   "GFT [ms]", "max", "GOT [ms]", "max", "sigma", "max"});
  int num_flips = 0, num_failures = 0;
  for (const NumericsSummary& summary : summaries) {
    std::vector<std::string> row = {summary.variant, std::to_string(summary.num_trials),
                                    std::to_string(summary.num_successes_before),
                                    std::to_string(summary.num_successes),
                                    std::to_string(summary.num_flips)};
    const auto add = [&row](const ChangeSummary& change, double scale, int decimals) {
      for (const double value : {change.median, change.max}) {
        row.push_back(change.num == 0 ? "n/a" : FormatFixed(scale * value, decimals));
      }
    };
    add(summary.gct, 1e3, 1);
    add(summary.gft, 1e3, 1);
    add(summary.got, 1e3, 1);
    add(summary.sigma, 1.0, 3);
    table.AddRow(row);
    num_flips += summary.num_flips;
    num_failures += summary.num_numerical_failures;
  }
  std::string text = table.Format() + "changes of GCT, GFT, GOT, sigma: median and largest\n";
  if (num_failures > 0) text += FormatCount(num_failures, "numerical failure") + '\n';
  if (num_flips == 0) return text + "\nno verdict flips\n";

  TextTable flips({"flips in", "hand", "object", "grasp", "trial", "before", "after"});
  for (const NumericsComparison& comparison : comparisons) {
    if (!comparison.is_flipped()) continue;
    const PlannedTrial& plan = comparison.before.plan;
    flips.AddRow({comparison.variant, plan.hand, plan.object, plan.grasp,
                  std::to_string(plan.trial), NameOf(comparison.before.result.outcome),
                  NameOf(comparison.after.outcome)});
  }
  return text + '\n' + flips.Format();
}

}  // namespace graspbench
