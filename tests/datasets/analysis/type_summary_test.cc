#include "datasets/analysis/type_summary.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

// Of five trials four are held: two by the palm, one by pads, one by sides. Digits bear 3 and 5 of
// 10 N, so the palm 2; without a digit's force it counts as 0.
TEST(TypeSummary, CountsOppositionsAndShares) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 5);
  const Opposition found[] = {Opposition::kPalm, Opposition::kPalm, Opposition::kPad,
                              Opposition::kSide};
  for (size_t k = 0; k < 4; ++k) session.records[k].result.opposition = found[k];
  TrialResult& first = session.records[0].result;
  first.stability.hold.normal_force = 10.0;
  first.grip.emplace();
  first.grip->digits.resize(2);
  first.grip->digits[0].digit = "FF";
  first.grip->digits[0].held = 3.0;
  first.grip->digits[1].digit = "TH";
  first.grip->digits[1].held = 5.0;
  const std::vector<TypeSummary> types = ListTypeSummaries(session);
  ASSERT_EQ(types.size(), 1u);
  EXPECT_EQ(types[0].asked, "palm");
  EXPECT_EQ(types[0].num_finished, 5);
  EXPECT_EQ(types[0].num_held, 4);
  EXPECT_EQ(types[0].found, (std::array<int, 3>{1, 2, 1}));
  EXPECT_EQ(types[0].num_as_called, 2);
  EXPECT_DOUBLE_EQ(types[0].share(), 0.5);
  EXPECT_EQ(types[0].parts, "FF 30 %, TH 50 %, palm 20 %");
  EXPECT_EQ(FormatTypeLine(types), "2 of 4 held trials have the intended opposition");
}

TEST(TypeSummary, AGraspOfItsOwnIsAskedNothing) {
  Session session = MakeSession({"tum"}, {"can"}, "new-target", 2);
  session.records[0].result.opposition = Opposition::kPad;
  const std::vector<TypeSummary> types = ListTypeSummaries(session);
  EXPECT_EQ(types.at(0).asked, "");
  EXPECT_TRUE(std::isnan(types[0].share()));
  EXPECT_EQ(FormatTypeLine(types), "");
}

}  // namespace
}  // namespace graspbench
