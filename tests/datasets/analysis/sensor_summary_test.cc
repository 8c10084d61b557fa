#include "datasets/analysis/sensor_summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

// Each trial's belief is off by 1, 2, 3 and 4 mm along x and a turn of half a circle and 0.1 rad;
// one more trial saw nothing.
TEST(SensorSummary, ErrorsAreThoseAgainstTheDraw) {
  Session session = MakeSession({"tum"}, {"can"}, "g1", 5);
  for (TrialRecord& record : session.records) {
    const TrialDraw draw = MakeObjectDraw(session.config, "can", record.plan.trial);
    if (record.plan.trial == 4) {
      record.result.outcome = Outcome::kNotSeen;
      continue;
    }
    record.result.believed_x = draw.offset_x + 0.001 * (record.plan.trial + 1);
    record.result.believed_y = draw.offset_y;
    record.result.believed_yaw = draw.offset_yaw + kPi + 0.1;
  }
  const SensorSummary summary = SummariseSensors(session);
  ASSERT_EQ(summary.places.size(), 1u);
  const PlaceErrors& place = summary.places[0];
  EXPECT_EQ(place.num_trials, 5);
  EXPECT_EQ(place.num_found, 4);
  EXPECT_NEAR(place.median, 0.0025, 1e-12);
  EXPECT_NEAR(place.worst, 0.004, 1e-12);
  EXPECT_NEAR(place.median_turn, 0.1, 1e-12);
}

TEST(SensorSummary, TouchesAddUpByHand) {
  Session session = MakeSession({"tum", "shadow"}, {"can"}, "g1", 2);
  EXPECT_TRUE(SummariseSensors(session).touches.empty());
  int i = 0;
  for (TrialRecord& record : session.records) {
    ++i;
    record.result.touch = TouchRecord{10 * i, 9 * i, 0, i, 0.001 * i, {0.1 * i, 1.0 / i}};
  }
  const SensorSummary summary = SummariseSensors(session);
  ASSERT_EQ(summary.touches.size(), 2u);
  EXPECT_EQ(summary.touches[0].hand, "tum");
  EXPECT_EQ(summary.touches[0].num_trials, 2);
  EXPECT_EQ(summary.touches[0].sum.num_touches, 30);
  EXPECT_EQ(summary.touches[0].sum.num_felt_in_time, 27);
  EXPECT_EQ(summary.touches[0].sum.num_elsewhere, 3);
  EXPECT_EQ(summary.touches[0].sum.longest_delay, 0.002);
  EXPECT_EQ(summary.touches[0].sum.peak, (std::vector<double>{0.2, 1.0}));
  EXPECT_EQ(summary.touches[1].sum.num_touches, 70);
}

}  // namespace
}  // namespace graspbench
