#include <gtest/gtest.h>

#include <cmath>

#include "datasets/analysis/session_comparison.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

ThresholdSummary MakeThresholds(const Session& session, const std::vector<double>& values) {
  ThresholdSummary summary;
  summary.scale = &kThresholdScales[0];
  for (size_t i = 0; i < values.size(); ++i) {
    DrawThreshold draw;
    draw.draw = session.records[i].plan;
    draw.value = values[i];
    summary.draws.push_back(draw);
  }
  return summary;
}

// Ratios 1/2, 1, 2, 2, 2, 4, and one draw that only the second session holds, one that is not
// finished.
TEST(ThresholdComparison, ComparesDrawByDraw) {
  const Session before = MakeSession({"tum"}, {"can"}, "g3", 8);
  const Session after = MakeSession({"tum"}, {"can"}, "g3", 8);
  std::vector<TrialPair> pairs;
  for (size_t i = 0; i < 8; ++i) pairs.push_back({&before.records[i], &after.records[i]});
  const auto changes =
      CompareThresholds(pairs, {MakeThresholds(before, {2, 2, 2, 1, 4, 1, HUGE_VAL, kUnset})},
                        {MakeThresholds(after, {1, 2, 4, 2, 8, 4, 16, 1})});
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].hand, "tum");
  EXPECT_EQ(changes[0].num_pairs, 7);
  EXPECT_EQ(changes[0].num_lower, 2) << "no grip held it before";
  EXPECT_EQ(changes[0].num_equal, 1);
  EXPECT_EQ(changes[0].num_higher, 4);
  EXPECT_DOUBLE_EQ(changes[0].ratio, 2.0);
  EXPECT_DOUBLE_EQ(changes[0].low, 0.5);
  EXPECT_DOUBLE_EQ(changes[0].high, 4.0);
  EXPECT_EQ(MakeJsonRows(ListThresholdChangeColumns(), changes)[0]["pairs"], 7);
  EXPECT_TRUE(CompareThresholds(pairs, {}, {MakeThresholds(after, {1.0})}).empty());
}

}  // namespace
}  // namespace graspbench
