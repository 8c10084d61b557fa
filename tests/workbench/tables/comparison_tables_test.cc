#include "workbench/tables/comparison_tables.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

bool Contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(ComparisonTables, NameBothHandsAndCompareNoGraspsOfTwoHands) {
  const Session tum = MakeSession({"tum"}, {"can", "cup"}, "g3", 3);
  Session mine = MakeSession({"mine"}, {"can", "cup"}, "g1", 3);
  for (size_t i = 0; i < 3; ++i) {  // the can
    mine.plan[i].grasp = mine.records[i].plan.grasp = "g3";
  }
  mine.records[0].result.outcome = Outcome::kNoContact;
  const ComparedSessions result = CompareAll(tum, mine);
  const std::string text = FormatComparison(result);
  EXPECT_TRUE(Contains(text, "6 pairs of the same draw, first tum, second mine; 0 trials")) << text;
  EXPECT_TRUE(Contains(text, "all pairs  mine minus tum")) << text;
  EXPECT_FALSE(Contains(text, "same grasp")) << text;
  EXPECT_FALSE(Contains(text, "changed grasp")) << text;
  EXPECT_TRUE(Contains(text, "both fail [%]: share of the pairs in which both")) << text;
  const Json json = ToJson(result);
  EXPECT_EQ(json.at("hand"), "tum");
  EXPECT_EQ(json.at("other_hand"), "mine");
  EXPECT_EQ(json.at("other_grasp"), 0);
  EXPECT_EQ(json.at("objects").at(0).at("hand"), "tum");
}

TEST(ComparisonTables, ChangedGraspsAreThoseOfOneHand) {
  const Session before = MakeSession({"tum"}, {"can"}, "g3", 3);
  Session after = MakeSession({"tum"}, {"can"}, "g1", 3);
  const std::string text = FormatComparison(CompareAll(before, after));
  EXPECT_TRUE(Contains(text, "3 of 3 pairs changed grasp\n")) << text;
  EXPECT_TRUE(Contains(text,
                       "\np: not testable with one object; the exact test clustered by "
                       "object needs 6 or more\n"))
      << text;
}

TEST(ComparisonTables, ChangesOfThresholdsAreRatios) {
  EXPECT_EQ(FormatThresholdChanges({}), "");
  const std::string text =
      FormatThresholdChanges({{&kThresholdScales[0], "tum", 20, 3, 4, 13, 1.41, 1.19, 2.0}});
  EXPECT_TRUE(Contains(text, "1.41 (1.19 to 2.00)")) << text;
}

}  // namespace
}  // namespace graspbench
