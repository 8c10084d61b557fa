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
  EXPECT_EQ(
      FormatSensitivityTables(summary),
      "setting               was  hand  pairs  success [%]           GFT [ms]                "
      "        GFT% [%]                           sigma [N]\n"
      "model.mass_scale=2.0  1.0  tum      10  -30.0 (-60.0 to 5.0)  100 (50 to 250), 6 of 10 "
      "pairs  10.0 (5.0 to 25.0), 6 of 10 pairs  n/a, 0 of 10 pairs\n"
      "changes of the success rate and of medians, with 95 % intervals, on the same "
      "draws\n"
      "n of N pairs: in each other pair a trial has no value\n");
  summary.changes[0].measures.assign(5, {"gft_s", 10, 0.1, 0.2, kUnset, kUnset, ""});
  summary.changes[0].measures[1].measure = "gft_ratio";
  summary.changes[0].measures[2].measure = "sigma_n";
  summary.changes[0].num_left_out = 4;
  summary.changes[0].why_left_out = "4 without a trial under the setting";
  EXPECT_EQ(FormatSensitivityTables(summary),
            "setting               was  hand  pairs     success [%]           GFT [ms]  GFT% [%]  "
            "sigma [N]  left out\n"
            "model.mass_scale=2.0  1.0  tum   10 of 14  -30.0 (-60.0 to 5.0)       100      10.0  "
            "     0.10  4 without a trial under the setting\n"
            "changes of the success rate and of medians, with 95 % intervals, on the same "
            "draws\n");
}

}  // namespace
}  // namespace graspbench
