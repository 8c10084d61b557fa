#include "datasets/analysis/timing_groups.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

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
