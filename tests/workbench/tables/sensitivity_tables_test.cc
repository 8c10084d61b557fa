#include "workbench/tables/sensitivity_tables.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(SensitivityTables, ShowChangesWithTheirIntervals) {
  SettingChange change;
  change.setting = "model.mass_scale=2.0";
  change.value = "1.0";
  change.hand = "tum";
  change.successes.both = 6;
  change.successes.first_only = 3;
  change.successes.neither = 1;
  change.rate_change_low = -0.6;
  change.rate_change_high = 0.05;
  for (const char* measure : {"gct_s", "gft_s", "gft_ratio", "got_ratio", "sigma_n"}) {
    change.measures.push_back({measure, 6, 0.1, 0.2, 0.05, 0.25, ""});
  }
  change.measures.back() = {"sigma_n", 0, kUnset, kUnset, kUnset, kUnset, "no pair has it twice"};
  SensitivitySummary summary;
  summary.changes = {change};
  EXPECT_EQ(FormatSensitivityTables(summary),
            "setting               was  hand  pairs  success [%]           GFT [ms]         "
            "GFT% [%]            sigma [N]\n"
            "model.mass_scale=2.0  1.0  tum      10  -30.0 (-60.0 to 5.0)  100 (50 to 250)  "
            "10.0 (5.0 to 25.0)        n/a\n"
            "changes of the success rate and of medians, with 95 % intervals, on the same "
            "draws\n");
}

}  // namespace
}  // namespace graspbench
