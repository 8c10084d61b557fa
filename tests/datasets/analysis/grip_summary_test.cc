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
            "grip     3 of 4 trials did not reach what was asked: asked 20.00 N, reached 5.00 N "
            "(sums, medians); mostly: limit");
  EXPECT_EQ(
      DescribeShortfall(FindShortfall(SummariseSession(MakeSession({"tum"}, {"can"}, "g3", 1)))),
      "");
}

// The elements feel what was asked; the digits press beside them.
TEST(GripSummary, SaysWhatIsPressedBesideWhatFeels) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  for (TrialRecord& record : session.records) {
    record.result.grip = MakeGrip(4.0, 4.0, GripFault::kNone, GripFault::kNone);
    record.result.touch.emplace();
    record.result.stability.hold.normal_force = 4.5;
  }
  session.records[1].result.stability.hold.normal_force = 50.0;
  const SessionSummary summary = SummariseSession(session);
  const GripShortfall shortfall = FindShortfall(summary);
  EXPECT_EQ(shortfall.num, 0);
  EXPECT_EQ(DescribeExcess(shortfall),
            "grip     1 of 3 trials pressed more than twice as hard as asked, beside what feels: "
            "asked 4.00 N, in truth 50.00 N (sums, medians)");
  EXPECT_DOUBLE_EQ(ListGrips(summary)[0].pressed.median, 4.5);
  for (TrialRecord& record : session.records) record.result.touch.reset();
  EXPECT_EQ(DescribeExcess(FindShortfall(SummariseSession(session))), "");
}

}  // namespace
}  // namespace graspbench
