#include "workbench/tables/threshold_tables.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

TEST(ThresholdTables, SayWhatIsNotKnownAndWhatNeverHeld) {
  ThresholdSummary summary;
  summary.scale = &kThresholdScales[1];
  summary.num_trials = 23;
  summary.cells = {{"", "tum", "can", "g3", 8, 1, 0, {2, 5}, 0.7, 0.5, HUGE_VAL},
                   {"", "tum", "cup", "g3", 2, 2, 0, {}, HUGE_VAL}};
  const std::string text = FormatThresholdTables(summary);
  for (const char* part : {"0.70 N", "0.50 N to none held", "2, 5", "none held", "n/a",
                           "10 draws, 23 trials, 2 not monotone"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST(ThresholdTables, ChangesAreRatios) {
  EXPECT_EQ(FormatThresholdChanges({}), "");
  const std::string text =
      FormatThresholdChanges({{&kThresholdScales[0], "tum", 20, 3, 4, 13, 1.41, 1.19, 2.0}});
  EXPECT_NE(text.find("1.41 (1.19 to 2.00)"), std::string::npos) << text;
}

}  // namespace
}  // namespace graspbench
