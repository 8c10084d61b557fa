#include "datasets/analysis/judge_evidence.h"

#include <gtest/gtest.h>

#include "core/trial/judge/judge.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

TEST(JudgeEvidence, RanksMeasuresAgainstTheBreakingForce) {
  const JudgeEvidence evidence = CalcJudgeEvidence(MakeJudgedSession().records);
  EXPECT_EQ(evidence.num_judged, 24);
  EXPECT_EQ(evidence.num_cells, 12);
  EXPECT_EQ(evidence.num_finished, 24);
  EXPECT_EQ(evidence.num_successes, 24);
  for (const RankEvidence& rank : evidence.ranks) {
    // The intervals of perfect order are no intervals; then the reason stands in their place.
    if (rank.measure == "volume") {
      EXPECT_FALSE(rank.correlation);
    }
    if (rank.measure == "sigma" && rank.correlation) {
      EXPECT_DOUBLE_EQ(rank.correlation->estimate, 1.0);
    }
    if (rank.measure == "epsilon" && rank.correlation) {
      EXPECT_DOUBLE_EQ(rank.correlation->estimate, -1.0);
    }
  }
}

// Cells are drawn, not trials: trials that repeat their cell must not narrow an interval.
TEST(JudgeEvidence, TrialsOfACellThatSayTheSameAddNothing) {
  const auto rank_sigma = [](int trials) {
    Session session = MakeSession({"tum", "shadow"}, {"a", "b", "c", "d", "e", "f"}, "g1", trials);
    for (size_t i = 0; i < session.records.size(); ++i) {
      const auto cell = static_cast<int>(i) / trials;
      Judgement judgement = MakeEmptyHandJudgement();
      judgement.breaking_force = 1.0 + cell;
      session.records[i].result.stability.sigma = (5 * cell) % 7;
      session.records[i].judgement = judgement;
    }
    const JudgeEvidence evidence = CalcJudgeEvidence(session.records);
    EXPECT_EQ(evidence.num_cells, 12);
    EXPECT_EQ(evidence.ranks.front().measure, "sigma");
    return evidence.ranks.front().correlation;
  };
  const auto one = rank_sigma(1), ten = rank_sigma(10);
  ASSERT_TRUE(one && ten);
  EXPECT_NEAR(ten->estimate, one->estimate, 1e-12);
  EXPECT_NEAR(ten->interval.low, one->interval.low, 1e-12);
  EXPECT_NEAR(ten->interval.high, one->interval.high, 1e-12);
}

TEST(JudgeEvidence, CountsWhereRulesAgree) {
  const JudgeEvidence evidence = CalcJudgeEvidence(MakeJudgedSession().records);
  const Agreement& agreement = evidence.agreements[0][1];
  EXPECT_EQ(agreement.num_both, 18);
  EXPECT_EQ(agreement.num_first, 6);
  EXPECT_EQ(agreement.num_second, 0);
  EXPECT_EQ(agreement.num_neither, 0);
  EXPECT_EQ(evidence.agreements[1][1].num_both, 18);
}

TEST(JudgeEvidence, ASessionWithoutJudgementsHasNone) {
  const JudgeEvidence evidence = CalcJudgeEvidence(MakeSession({"tum"}, {"a"}, "g1", 2).records);
  EXPECT_EQ(evidence.num_judged, 0);
  EXPECT_TRUE(evidence.ranks.empty());
}

TEST(JudgeEvidence, LoadsOfACellAreThoseOfItsJudgedTrials) {
  Session session = MakeJudgedSession();  // forces 1 and 2 in the first cell
  session.records[2].judgement.reset();   // force 3 of 3 and 4 in the second
  session.records[4].judgement.reset();
  session.records[5].judgement.reset();
  const SessionSummary summary = SummariseSession(session);
  const std::vector<CellLoads> loads = ListCellLoads(summary);
  ASSERT_EQ(loads.size(), 11u);
  EXPECT_EQ(loads[0].num_judged, 2);
  EXPECT_EQ(loads[0].force.median, 1.5);
  EXPECT_EQ(loads[0].force.lowest, 1.0);
  EXPECT_EQ(loads[0].sigma.median, 0.5 * (0.5 + 2.0));
  EXPECT_EQ(loads[1].num_judged, 1);
  EXPECT_EQ(loads[1].force.median, 4.0);
  EXPECT_EQ(loads[2].cell, &summary.cells[3]);
}

}  // namespace
}  // namespace graspbench
