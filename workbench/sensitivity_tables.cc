#include "workbench/sensitivity_tables.h"

#include <cmath>

#include "core/base/text.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace {

/** "-2.9 (-6.4 to 0.5)". */
std::string FormatChange(double change, double low, double high, double scale, int decimals) {
  const std::string text = FormatFixed(scale * change, decimals);
  if (!std::isfinite(low)) return text;
  return text + " (" + FormatFixed(scale * low, decimals) + " to " +
         FormatFixed(scale * high, decimals) + ")";
}

std::string FormatChange(const SettingChange& change, const char* measure, double scale,
                         int decimals) {
  const MeasureChange& part = change.Find(measure);
  return FormatChange(part.change(), part.low, part.high, scale, decimals);
}

}  // namespace

std::string FormatSensitivityTables(const SensitivitySummary& summary) {
  TextTable table(
      {"setting", "was", "hand", "pairs", "success [%]", "GFT [ms]", "GFT% [%]", "sigma [N]"});
  for (const SettingChange& change : summary.changes) {
    table.AddRow({change.setting, change.value, change.hand, std::to_string(change.num_pairs()),
                  FormatChange(change.rate_change(), change.rate_change_low,
                               change.rate_change_high, 100.0, 1),
                  FormatChange(change, "gft_s", 1e3, 0),
                  FormatChange(change, "gft_ratio", 100.0, 1),
                  FormatChange(change, "sigma_n", 1.0, 2)});
  }
  return table.Format() +
         "changes of the success rate and of medians, with 95 % intervals, on the same draws\n";
}

}  // namespace graspbench
