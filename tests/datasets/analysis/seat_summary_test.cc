#include "datasets/analysis/seat_summary.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

void Place(TrialRecord& record, double rise, double grip, double sigma) {
  TrialResult& result = record.result;
  result.closure_rise = rise;
  result.closure_slide = 0.01;
  result.object_height = 0.043;
  result.weight = 0.45;
  result.stability.hold.normal_force = grip;
  result.stability.sigma = sigma;
}

// Two balls squirted up, two stayed at the fingertips; one of each hand.
TEST(SeatSummary, NoFigureIsOverTwoSeats) {
  Session session = MakeSession({"shadow"}, {"golf_ball", "can"}, "g1", 4);
  Place(session.records[0], 0.002, 12.0, 1.3);
  Place(session.records[1], 0.025, 4.0, 0.7);
  Place(session.records[2], 0.003, 14.0, 1.5);
  Place(session.records[3], 0.026, 1.0, 0.6);
  for (int i = 4; i < 8; ++i) Place(session.records[i], 0.001, 30.0, 3.0);
  session.records[7].result.outcome = Outcome::kDroppedWhileHolding;
  const SessionSummary summary = SummariseSession(session);
  const std::vector<SeatSummary> seats = ListSeats(summary);
  ASSERT_EQ(seats.size(), 3u);
  EXPECT_EQ(seats[0].seat, Seat::kKept);
  EXPECT_EQ(seats[0].num_held, 2);
  EXPECT_DOUBLE_EQ(seats[0].grip.median, 13.0);
  EXPECT_DOUBLE_EQ(seats[0].sigma.median, 1.4);
  EXPECT_EQ(seats[1].seat, Seat::kReseated);
  EXPECT_EQ(seats[1].num_held, 2);
  EXPECT_EQ(seats[1].num_caged, 1);
  EXPECT_DOUBLE_EQ(seats[1].grip.highest, 4.0);
  EXPECT_EQ(seats[1].gft.n, 2);
  EXPECT_EQ(seats[2].cell, &summary.cells[1]);
  EXPECT_EQ(seats[2].num_held, 3) << "what fell sits nowhere";
  EXPECT_EQ(DescribeSeats(seats),
            "of 7 held grasps 2 are reseated, 1 is caged; 1 condition has two seats");
  EXPECT_EQ(ToJson(seats)[1]["seat"], "reseated");
  EXPECT_EQ(ToJson(seats)[1]["grip_n"]["median"], 2.5);
  // Times of the two are apart, too.
  EXPECT_EQ(summary.cells[0].times.gct.n, 2);
  EXPECT_EQ(summary.cells[0].reseated_times.gct.n, 2);
  EXPECT_EQ(summary.cells[1].times.gct.n, 4);
}

TEST(SeatSummary, RecordsOfOlderPhysicsHaveSeatsThatNobodyKnows) {
  const Session session = MakeSession({"tum"}, {"can"}, "g1", 2);
  const SessionSummary summary = SummariseSession(session);
  const std::vector<SeatSummary> seats = ListSeats(summary);
  ASSERT_EQ(seats.size(), 1u);
  EXPECT_EQ(seats[0].seat, Seat::kUnknown);
  EXPECT_EQ(seats[0].num_held, 2);
  EXPECT_EQ(DescribeSeats(seats), "");
  EXPECT_TRUE(ToJson(seats)[0]["seat"].is_null());
}

}  // namespace
}  // namespace graspbench
