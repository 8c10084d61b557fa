#include "workbench/tables/sensitivity_tables.h"

#include "core/base/text/range_text.h"
#include "core/base/text/text.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

std::string FormatChange(const SettingChange& change, const char* measure, double scale,
                         int decimals) {
  const MeasureChange& part = change.Find(measure);
  return FormatWithRange(scale * part.change(), scale * part.low, scale * part.high, decimals);
}

}  // namespace

std::string FormatSensitivityTables(const SensitivitySummary& summary) {
  TextTable table(
      {"setting", "was", "hand", "pairs", "success [%]", "GFT [ms]", "GFT% [%]", "sigma [N]"});
  for (const SettingChange& change : summary.changes) {
    table.AddRow({FormatSetting(change.setting), FormatSetting(change.value), change.hand,
                  std::to_string(change.successes.num_pairs()),
                  FormatWithRange(100.0 * change.rate_change(), 100.0 * change.rate_change_low,
                                  100.0 * change.rate_change_high, 1),
                  FormatChange(change, "gft_s", 1e3, 0),
                  FormatChange(change, "gft_ratio", 100.0, 1),
                  FormatChange(change, "sigma_n", 1.0, 2)});
  }
  return table.Format() +
         "changes of the success rate and of medians, with 95 % intervals, on the same draws\n";
}

}  // namespace graspbench
