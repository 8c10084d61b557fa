#include "human_study/study/inference/order_summary.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

StudyTrial MakeTrial(const std::string& participant,
                     const std::vector<std::vector<std::string>>& groups, int num_ties) {
  StudyTrial trial;
  trial.participant = participant;
  trial.analysis.emplace();
  trial.analysis->order.groups = groups;
  trial.analysis->order.num_ties = num_ties;
  for (const auto& group : groups) {
    trial.analysis->num_touching += static_cast<int>(group.size());
  }
  return trial;
}

// Counted by hand.
TEST(SummariseOrders, CountsFirstDigitsPrecedenceAndTies) {
  StudyResult result;
  result.digits = {"TH", "FF", "MF"};
  result.trials = {MakeTrial("a", {{"TH"}, {"FF"}, {"MF"}}, 0),
                   MakeTrial("a", {{"FF", "TH"}, {"MF"}}, 1),
                   MakeTrial("b", {{"TH"}, {"MF", "FF"}}, 1), MakeTrial("b", {{"MF"}}, 0)};
  result.trials.back().removed = "no contact";
  result.trials.push_back(MakeTrial("b", {{"TH"}, {"FF", "MF"}}, 1));
  const OrderSummary summary = SummariseOrders(result);
  ASSERT_EQ(summary.first.size(), 2u);
  EXPECT_EQ(summary.first[0].participant, "a");
  EXPECT_EQ(summary.first[0].counts, (std::vector<int>{1, 0, 0, 1}));
  EXPECT_EQ(summary.first[1].counts, (std::vector<int>{2, 0, 0, 0}));
  EXPECT_EQ(summary.precedence[0][1].num_before, 3);
  EXPECT_EQ(summary.precedence[0][1].num_both, 4);
  EXPECT_DOUBLE_EQ(summary.precedence[0][1].share(), 0.75);
  EXPECT_EQ(summary.precedence[1][0].num_before, 0);
  EXPECT_EQ(summary.precedence[1][2].num_before, 2);
  EXPECT_EQ(summary.num_ties, 3);
  EXPECT_EQ(summary.num_neighbours, 8);
  ASSERT_EQ(summary.orders.size(), 3u);
  EXPECT_EQ(summary.orders[0].order, "TH<FF=MF");  // however the tied digits were listed
  EXPECT_EQ(summary.orders[0].count, 2);
  EXPECT_DOUBLE_EQ(summary.orders[0].share, 0.5);
}

}  // namespace
}  // namespace graspbench
