#include "workbench/text/study_text.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(FormatZeroGft, GivesLimitAndMedianInMilliseconds) {
  ZeroGft zero;
  zero.num_trials = 4;
  zero.limit = 0.0304;
  zero.median = 0.0126;
  EXPECT_EQ(FormatZeroGft(zero),
            "zero     GFT below 30 ms cannot be told from zero here; touching at once would show a "
            "median of 13 ms\n");
}

TEST(FormatZeroGft, IsEmptyWhereNoTrialSays) { EXPECT_EQ(FormatZeroGft(ZeroGft()), ""); }

TEST(FormatRemoved, SaysThatNoTrialCounts) {
  EXPECT_EQ(FormatRemoved(StudyResult()), "no trial counts:\n");
}

TEST(FormatWarnings, OneLineEachWithItsCode) {
  StudyResult result;
  EXPECT_EQ(FormatWarnings(result), "");
  result.warnings = {{"same_recording", "a and b"}, {"frozen_samples", "30 %"}};
  EXPECT_EQ(FormatWarnings(result),
            "warning  [same_recording] a and b\nwarning  [frozen_samples] 30 %\n");
}

}  // namespace
}  // namespace graspbench
