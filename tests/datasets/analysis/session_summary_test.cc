#include "datasets/analysis/session_summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {

namespace {

TEST(CalcSpread, OddEvenAndMissing) {
  const Spread odd = CalcSpread({3.0, 1.0, 2.0});
  EXPECT_EQ(odd.n, 3);
  EXPECT_EQ(odd.median, 2.0);
  EXPECT_EQ(odd.lowest, 1.0);
  EXPECT_EQ(odd.highest, 3.0);
  EXPECT_EQ(CalcSpread({1.0, 2.0, std::nan(""), 10.0, 3.0}).median, 2.5);
  EXPECT_EQ(CalcSpread({1.0, 2.0, std::nan("")}).n, 2);
  EXPECT_EQ(CalcSpread({}).n, 0);
  EXPECT_TRUE(std::isnan(CalcSpread({std::nan("")}).median));
}

TEST(SummariseSession, CountsCellsInThePlansOrder) {
  const Session session = MakeSession({"tum", "shadow"}, {"can", "cup", "pencil"}, "g3", 4);
  const SessionSummary summary = SummariseSession(session);
  ASSERT_EQ(summary.cells.size(), 6u);
  EXPECT_EQ(summary.cells[1].object, "cup");
  EXPECT_EQ(summary.cells[3].hand, "shadow");
  EXPECT_EQ(summary.total.finished, 24);
  EXPECT_EQ(summary.TallyOf("tum").successes(), 12);
  EXPECT_EQ(summary.TallyOf("tum", "g1").planned, 0);
  EXPECT_EQ(summary.FindCell("tum", "can", "g1"), nullptr);
}

TEST(SummariseSession, MediansAndWorstValuesOfACell) {
  const Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  const CellSummary cell = SummariseSession(session).cells.at(0);
  EXPECT_NEAR(cell.times.gct.median, 0.61, 1e-12);
  EXPECT_NEAR(cell.times.gft.median, 0.2, 1e-12);
  EXPECT_NEAR(cell.times.got.median, 0.1, 1e-12);
  EXPECT_NEAR(cell.times.gft_ratio.median, 0.2 / 0.61, 1e-12);
  EXPECT_NEAR(cell.times.gct.highest, 0.62, 1e-12);
  EXPECT_EQ(cell.tally.worst_penetration, session.records[2].result.worst_penetration);
  EXPECT_EQ(cell.tally.worst_energy_residual, 0.000321);
  EXPECT_EQ(cell.tally.num_unconverged, 0 + 1 + 2);
}

TEST(SummariseSession, OrdersOfContactAreCounted) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);  // FF, TH, MF in all trials
  TrialResult& result = session.records[0].result;
  result.contacts[1].time = result.contacts[0].time;
  const CellSummary cell = SummariseSession(session).cells.at(0);
  const std::vector<std::pair<std::string, int>> expected = {{"FF<TH<MF", 2}, {"FF=MF<TH", 1}};
  EXPECT_EQ(cell.orders, expected);
}

TEST(SummariseSession, ADigitThatNeverTouchedIsMissingNotZero) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 2);
  TrialResult& result = session.records[0].result;
  result.contacts[1].time = std::nan("");
  result.timing = CalcContactTiming(result.contacts, 0.0);
  const CellSummary cell = SummariseSession(session).cells.at(0);
  EXPECT_EQ(cell.times.gct.n, 1);
  EXPECT_EQ(cell.times.got.n, 2);
}

TEST(SummariseSession, ATouchBeforeClosureIsAClassOfItsOwn) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  TrialResult& result = session.records[0].result;
  result.contacts[0].time = -0.2;
  result.timing = CalcContactTiming(result.contacts, 0.0);
  const CellSummary cell = SummariseSession(session).cells.at(0);
  EXPECT_EQ(cell.num_early, 1);
  EXPECT_EQ(cell.tally.successes(), 3);
  for (const Spread& spread : {cell.times.gct, cell.times.gft, cell.times.got, cell.times.gft_ratio,
                               cell.times.got_ratio}) {
    EXPECT_EQ(spread.n, 2);
  }
  EXPECT_NEAR(cell.times.gft.highest, 0.2, 1e-12);
}

TEST(SummariseSession, ANumericalFailureCountsInTheRateAndNowhereElse) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  session.records[2].result.outcome = Outcome::kNumericalFailure;
  session.records[2].result.worst_penetration = 1.0;
  const CellSummary cell = SummariseSession(session).cells.at(0);
  EXPECT_EQ(cell.tally.finished, 3);
  EXPECT_EQ(cell.tally.successes(), 2);
  EXPECT_EQ(cell.times.gct.n, 2);
  EXPECT_LT(cell.tally.worst_penetration, 0.001);
}

TEST(SummariseSession, AnEmptySessionHasNoWorstValue) {
  const SessionSummary summary = SummariseSession(Session());
  EXPECT_TRUE(summary.cells.empty());
  EXPECT_TRUE(std::isnan(summary.total.worst_penetration));
}

TEST(Tally, RateComesWithItsInterval) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 10);
  session.records[3].result.outcome = Outcome::kPushedAway;
  const Tally tally = SummariseSession(session).total;
  EXPECT_EQ(tally.rate(), 0.9);
  EXPECT_NEAR(tally.rate_interval().low, 0.5958, 1e-4);  // Wilson 1927
  EXPECT_EQ(FormatRateInterval(tally), "59.6 to 98.2");
  EXPECT_EQ(FormatRate(tally), FormatRate(9, 10));
  EXPECT_TRUE(std::isnan(Tally().rate()));
}

TEST(DescribeGrasp, CountsWhatTheCameraChose) {
  Session session = MakeSession({"tum"}, {"can"}, "by-sight", 5);
  EXPECT_EQ(DescribeGrasp(SummariseSession(session).cells.at(0)), "by-sight");
  for (TrialRecord& record : session.records) record.result.sight_grasp = "g3";
  session.records[1].result.sight_grasp = "g1";
  session.records[2].result.sight_grasp = kNotSeenGrasp;
  EXPECT_EQ(DescribeGrasp(SummariseSession(session).cells.at(0)),
            "by-sight: 3 g3, 1 g1, 1 not seen");
}

TEST(CalcContactSpread, IsOfOneDigit) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  session.records[2].result.contacts[0].time = std::nan("");
  const CellSummary cell = SummariseSession(session).cells.at(0);
  const Spread first = CalcContactSpread(cell, "FF");
  EXPECT_EQ(first.n, 2);
  EXPECT_NEAR(first.median, 0.405, 1e-12);
  EXPECT_NEAR(CalcContactSpread(cell, "MF").median, 0.61, 1e-12);
  EXPECT_EQ(CalcContactSpread(cell, "LF").n, 0);
}

TEST(TimingGroups, AHandWithOneGraspHasOneGroup) {
  const Session session = MakeSession({"tum", "shadow"}, {"can"}, "g3", 3);
  const std::vector<TimingGroup> groups = ListTimingGroups(session);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].hand, "tum");
  EXPECT_EQ(groups[0].grasp, "g3");
  ASSERT_TRUE(groups[0].ratios.gft);
  EXPECT_NEAR(groups[0].ratios.gft->median, 0.2 / 0.61, 1e-12);
  EXPECT_NEAR(groups[0].ratios.got->median, 0.1 / 0.61, 1e-12);
}

TEST(TimingGroups, AllGraspsComeFirstAndFailuresAndMissingOnesAreApart) {
  Session session = MakeSession({"tum"}, {"can", "cup"}, "g3", 3);
  for (size_t i = 3; i < 6; ++i) {
    session.plan[i].grasp = session.records[i].plan.grasp = "g1";
  }
  session.records[0].result.outcome = Outcome::kNumericalFailure;
  session.records[1].result.timing.gft_ratio = std::nan("");
  const std::vector<TimingGroup> groups = ListTimingGroups(session);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].grasp, "");
  EXPECT_EQ(groups[1].grasp, "g1");
  EXPECT_EQ(groups[2].grasp, "g3");
  EXPECT_EQ(groups[0].ratios.gft->count, 4);
  EXPECT_EQ(groups[0].ratios.num_without_gft, 1);
  EXPECT_EQ(groups[2].ratios.got->count, 2);
  EXPECT_FALSE(SummariseTimings({}).gft);
}

}  // namespace

}  // namespace graspbench
