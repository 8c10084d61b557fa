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
  EXPECT_EQ(DescribeFaults(grips[0].faults), "FF: no touch 1; FF: limit 2; TH: balance 1");
  EXPECT_EQ(DescribeFaults({}), "");
}

}  // namespace
}  // namespace graspbench
