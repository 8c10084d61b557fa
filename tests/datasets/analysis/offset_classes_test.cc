#include <gtest/gtest.h>

#include <cmath>

#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

double CalcOffset(const Session& session, const TrialRecord& record) {
  const TrialDraw draw = MakeObjectDraw(session.config, "can", record.plan.trial);
  return std::hypot(draw.offset_x, draw.offset_y);
}

TEST(OffsetClasses, TrialsStandInTheClassOfTheirOffset) {
  const Session session = MakeSession({"tum"}, {"can"}, "g1", 40);
  const std::vector<OffsetClass> classes = ListOffsetClasses(session, {});
  ASSERT_EQ(classes.size(), 4u);
  int num_trials = 0;
  for (const OffsetClass& offset : classes) {
    int expected = 0;
    for (const TrialRecord& record : session.records) {
      const double distance = CalcOffset(session, record);
      expected += distance >= offset.low && distance < offset.high ? 1 : 0;
    }
    EXPECT_EQ(offset.positioning, "nominal");
    EXPECT_EQ(offset.tally.finished, expected) << offset.low;
    num_trials += offset.tally.finished;
  }
  EXPECT_EQ(num_trials, 40);
  EXPECT_EQ(classes.front().low, 0.0);
  EXPECT_NEAR(classes.back().high, std::sqrt(2.0) * session.config.variation.offset, 1e-15);
}

// Where the session has its worst luck far out, the camera has success everywhere; of a setting
// that is no positioning nothing is told.
TEST(OffsetClasses, EachPositioningHasItsOwnOutcomes) {
  Session session = MakeSession({"tum", "shadow"}, {"can"}, "g1", 40);
  const double limit = std::sqrt(2.0) * session.config.variation.offset / 2.0;
  SensitivityData varied;
  for (TrialRecord& record : session.records) {
    const bool is_far = CalcOffset(session, record) >= limit;
    record.result.outcome = is_far ? Outcome::kNoContact : Outcome::kSuccess;
    if (record.plan.trial == 7) continue;  // not run again yet
    varied["positioning=camera"][record.plan.id].outcome = Outcome::kSuccess;
    varied["model.mass_scale=2.0"][record.plan.id].outcome = Outcome::kSlippedInLiftOff;
  }
  const std::vector<OffsetClass> classes = ListOffsetClasses(session, varied);
  ASSERT_EQ(classes.size(), 16u);
  int num_by_camera = 0;
  for (size_t i = 0; i < classes.size(); ++i) {
    const OffsetClass& offset = classes[i];
    EXPECT_EQ(offset.hand, i < 8 ? "tum" : "shadow");
    EXPECT_EQ(offset.positioning, i % 8 < 4 ? "nominal" : "camera");
    const bool is_lost = offset.positioning == "nominal" && i % 4 >= 2;
    EXPECT_EQ(offset.tally.successes(), is_lost ? 0 : offset.tally.finished) << i;
    if (offset.positioning == "camera") num_by_camera += offset.tally.finished;
  }
  EXPECT_EQ(num_by_camera, 2 * 39);
}

TEST(OffsetClasses, WithoutOffsetsThereIsNone) {
  Session session = MakeSession({"tum"}, {"can"}, "g1", 3);
  session.config.variation.offset = 0.0;
  EXPECT_TRUE(ListOffsetClasses(session, {}).empty());
}

}  // namespace
}  // namespace graspbench
