#include "datasets/records/compare_results.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TrialResult MakeResult() { return MakeFakeRecord({"id", "tum", "mug", "g2", 1}).result; }

TEST(CompareResults, EqualResultsDoNotDiffer) {
  TrialResult result = MakeResult();
  result.hold_slip = kUnset;  // missing equals missing
  EXPECT_FALSE(FindFirstDifference(result, result));
}

TEST(CompareResults, TheLastBitOfAFieldCounts) {
  const TrialResult recorded = MakeResult();
  TrialResult now = recorded;
  now.grip_force = std::nextafter(now.grip_force, 100.0);
  const auto difference = FindFirstDifference(recorded, now);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->field, "grip_force_n");
  EXPECT_EQ(std::stod(difference->recorded), recorded.grip_force);
  EXPECT_EQ(std::stod(difference->now), now.grip_force);
}

TEST(CompareResults, NamesTheFirstPlaceWithinLists) {
  const TrialResult recorded = MakeResult();
  TrialResult now = recorded;
  now.contacts[2].time = 17.0;
  now.grip_force = 17.0;
  EXPECT_EQ(FindFirstDifference(recorded, now)->field, "contacts/2/time_s");
  now = recorded;
  now.phases.pop_back();
  const auto difference = FindFirstDifference(recorded, now);
  EXPECT_EQ(difference->field, "phases/1");
  EXPECT_EQ(difference->now, "missing");
  now = recorded;
  now.phases.insert(now.phases.end(), 2, now.phases.back());
  const std::string first = "phases/" + std::to_string(recorded.phases.size());
  EXPECT_EQ(FindFirstDifference(recorded, now)->field, first);
  EXPECT_EQ(FindFirstDifference(recorded, now)->recorded, "missing");
  EXPECT_EQ(FindFirstDifference(now, recorded)->field, first);
}

}  // namespace
}  // namespace graspbench
