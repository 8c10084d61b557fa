#include "datasets/analysis/grip_summary.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {

namespace {

GripRecord MakeGrip(double asked, double held, GripFault index, GripFault thumb) {
  GripRecord grip;
  grip.asked = asked;
  grip.held = held;
  grip.digits.resize(2);
  grip.digits[0].digit = "FF";
  grip.digits[0].fault = index;
  grip.digits[1].digit = "TH";
  grip.digits[1].fault = thumb;
  return grip;
}

TEST(GripSummary, CountsSumsAndNamesDigitsWithTheirReasons) {
  Session session = MakeSession({"tum"}, {"can", "cup"}, "g3", 4);
  session.records[0].result.grip = MakeGrip(2.0, 2.3, GripFault::kNone, GripFault::kNone);
  session.records[1].result.grip = MakeGrip(3.0, 2.3, GripFault::kLimit, GripFault::kBalance);
  session.records[2].result.grip = MakeGrip(4.0, 4.0, GripFault::kLimit, GripFault::kNone);
  session.records[3].result.grip = MakeGrip(9.0, kUnset, GripFault::kNoTouch, GripFault::kNone);
  const SessionSummary summary = SummariseSession(session);
  const std::vector<GripSummary> grips = ListGrips(summary);
  ASSERT_EQ(grips.size(), 1u) << "the cup's trials close to their posture";
  EXPECT_EQ(grips[0].cell, &summary.cells[0]);
  EXPECT_EQ(grips[0].held.n, 3) << "one never reached the hold";
  EXPECT_DOUBLE_EQ(grips[0].asked.median, 3.0);
  EXPECT_DOUBLE_EQ(grips[0].held.median, 2.3);
  EXPECT_EQ(grips[0].num_within, 2);
  EXPECT_EQ(DescribeFaults(grips[0].faults), "FF: limit 2; TH: balance 1");
  EXPECT_EQ(DescribeFaults({}), "");
}

// Of five trials: one within its band, three below it, of these one lost before its hold; one never
// closed.
TEST(GripSummary, CountsTrialsThatDidNotReachWhatWasAsked) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 5);
  session.records[0].result.grip = MakeGrip(10.0, 8.1, GripFault::kBalance, GripFault::kBalance);
  session.records[1].result.grip = MakeGrip(10.0, 4.0, GripFault::kLimit, GripFault::kNone);
  session.records[2].result.grip = MakeGrip(20.0, 6.0, GripFault::kLimit, GripFault::kBalance);
  session.records[3].result.grip = MakeGrip(30.0, kUnset, GripFault::kNoTouch, GripFault::kNone);
  session.records[3].result.grip->closed = 5.0;
  session.records[4].result.grip = MakeGrip(40.0, kUnset, GripFault::kNoTouch, GripFault::kNone);
  const GripShortfall shortfall = FindShortfall(SummariseSession(session));
  EXPECT_EQ(shortfall.num, 3);
  EXPECT_EQ(shortfall.num_closed, 4);
  EXPECT_DOUBLE_EQ(shortfall.asked.median, 20.0);
  EXPECT_DOUBLE_EQ(shortfall.reached.median, 5.0);
  EXPECT_EQ(DescribeShortfall(shortfall),
            "grip     in 3 of 4 trials the total grip stayed below its setpoint: 5.00 N instead of "
            "20.00 N (medians), first in tum-can-g3:1; most frequent reason: limit");
  EXPECT_EQ(
      DescribeShortfall(FindShortfall(SummariseSession(MakeSession({"tum"}, {"can"}, "g3", 1)))),
      "");
}

// The hand estimates what was asked; bounds by hand: 1.5 times 4 N is 6 N.
TEST(GripSummary, SaysWhatIsPressedBeyondWhatWasAsked) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  for (TrialRecord& record : session.records) {
    record.result.grip = MakeGrip(4.0, 4.0, GripFault::kNone, GripFault::kNone);
    record.result.touch.emplace();
    record.result.stability.hold.normal_force = 5.9;
  }
  session.records[1].result.stability.hold.normal_force = 6.1;
  const SessionSummary summary = SummariseSession(session);
  const GripShortfall shortfall = FindShortfall(summary);
  EXPECT_EQ(shortfall.num, 0);
  EXPECT_EQ(DescribeExcess(shortfall),
            "grip     1 of 3 trials exceeded 1.5 times the setpoint: total setpoint 4.00 N, true "
            "total 6.10 N (medians)");
  EXPECT_DOUBLE_EQ(ListGrips(summary)[0].pressed.median, 5.9);
  for (TrialRecord& record : session.records) record.result.touch.reset();
  EXPECT_EQ(DescribeExcess(FindShortfall(SummariseSession(session))), "");
}

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
