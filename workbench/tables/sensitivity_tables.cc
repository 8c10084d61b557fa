#include "workbench/tables/sensitivity_tables.h"

#include <algorithm>

#include "core/base/text/range_text.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
std::string FormatSensitivityTables(const SensitivitySummary& summary) {
  std::vector<std::string> heading = {"setting",     "was",      "hand",     "pairs",
                                      "success [%]", "GFT [ms]", "GFT% [%]", "sigma [N]"};
  const bool leaves_out =
      std::any_of(summary.changes.begin(), summary.changes.end(),
                  [](const SettingChange& change) { return change.num_left_out > 0; });
  if (leaves_out) heading.push_back("left out");
  TextTable table(heading);
  for (const SettingChange& change : summary.changes) {
    std::vector<std::string> cells = {
        FormatSetting(change.setting),
        FormatSetting(change.value),
        change.hand,
        CountPairs(change),
        FormatWithRange(100.0 * change.rate_change(), 100.0 * change.rate_change_low,
                        100.0 * change.rate_change_high, 1),
        FormatChange(change, "gft_s", 1e3, 0),
        FormatChange(change, "gft_ratio", 100.0, 1),
        FormatChange(change, "sigma_n", 1.0, 2)};
    if (leaves_out) cells.push_back(change.why_left_out);
    table.AddRow(cells);
  }
  return table.Format() + DescribeChanges(summary.changes);
}

}  // namespace graspbench
