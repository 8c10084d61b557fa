#include "human_study/study/inference/published_values.h"

#include <gtest/gtest.h>

#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

/** Two people and two weights; contact to lift is 0.1 s and 0.4 s per kg. */
StudyResult MakeResult() {
  StudyResult result;
  result.study.factors = {{"mass_kg", {"0.2", "0.6"}, {0.2, 0.6}, ""}};
  for (const char* person : {"P1", "P2"}) {
    for (const char* level : {"0.2", "0.6"}) {
      StudyTrial trial;
      trial.participant = person;
      trial.levels = {level};
      trial.analysis.emplace();
      DigitContactEvents digit;
      digit.contact.time = 1.0;
      trial.analysis->contacts = {digit};
      const double own = std::string(person) == "P1" ? 0.0 : 0.02;
      trial.analysis->object.lift_off.time = 1.0 + 0.1 + own + (0.4 + own) * std::stod(level);
      trial.analysis->closure_start_value = 0.1;
      result.trials.push_back(trial);
    }
  }
  return result;
}

TEST(ComparePublished, ContactToLiftStandsWithItsGrowthByWeight) {
  const std::vector<ComparedValue> compared = ComparePublished(MakeResult());
  int num_medians = 0, num_slopes = 0;
  for (const ComparedValue& value : compared) {
    if (std::string(value.published->measure) != "contact_to_lift_s") {
      EXPECT_FALSE(value.published->is_slope) << "no size was varied";
      continue;
    }
    if (value.published->is_slope) {
      ++num_slopes;
      EXPECT_EQ(value.factor, "mass_kg");
      ASSERT_TRUE(value.slopes.test);
      EXPECT_NEAR(value.slopes.test->mean, 0.41, 1e-9);
    } else {
      ++num_medians;
      ASSERT_TRUE(value.summary);
      EXPECT_EQ(value.summary->count, 4);
    }
  }
  EXPECT_EQ(num_medians, 1);
  EXPECT_EQ(num_slopes, 1);
}

TEST(ComparePublished, AStudyWithoutATrialSaysNothing) {
  StudyResult result = MakeResult();
  for (StudyTrial& trial : result.trials) trial.removed = "late";
  EXPECT_TRUE(ComparePublished(result).empty());
}

TEST(PublishedValues, EveryOneIsAMeasureWithASource) {
  for (const PublishedValue& value : PublishedValueList()) {
    EXPECT_NO_THROW(FindMeasure(value.measure));
    EXPECT_FALSE(std::string(value.source).empty());
  }
}

}  // namespace
}  // namespace graspbench
