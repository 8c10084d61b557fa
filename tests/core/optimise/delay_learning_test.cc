#include "core/optimise/delay_learning.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

const double kNever = std::nan("");

LearningTrial MakeTrial(double thumb, double first, double middle) {
  LearningTrial trial;
  trial.contacts = {{"TH", true, thumb}, {"FF", false, first}, {"MF", false, middle}};
  return trial;
}

Grasp MakeGrasp() {
  Grasp grasp;
  grasp.digits = {"TH", "FF", "MF"};
  return grasp;
}

// Medians 0.3, 0.5, 0.6 s.
const std::vector<LearningTrial> kTrials = {MakeTrial(0.3, 0.5, 0.9), MakeTrial(0.1, 0.6, 0.6),
                                            MakeTrial(0.4, 0.2, 0.5), LearningTrial()};

TEST(LearnDelays, EachDigitWaitsForTheLastOne) {
  const auto closing = LearnDelays(MakeGrasp(), kTrials, 1.0);
  ASSERT_EQ(closing.size(), 2u);
  EXPECT_NEAR(closing.at("TH").delay, 0.3, 1e-12);
  EXPECT_NEAR(closing.at("FF").delay, 0.1, 1e-12);
  EXPECT_NEAR(LearnDelays(MakeGrasp(), kTrials, 0.5).at("TH").delay, 0.15, 1e-12);
}

TEST(LearnDelays, StartsFromTheSchedulesThatTheGraspHas) {
  Grasp grasp = MakeGrasp();
  grasp.closing = {{"FF", {0.05, 2.0}}, {"MF", {0.1, 1.0}}};
  const auto closing = LearnDelays(grasp, kTrials, 1.0);  // 0.3, 0.15, 0.1, then less 0.1
  ASSERT_EQ(closing.size(), 2u);
  EXPECT_NEAR(closing.at("TH").delay, 0.2, 1e-12);
  EXPECT_NEAR(closing.at("FF").delay, 0.05, 1e-12);
  EXPECT_EQ(closing.at("FF").speed, 2.0);
}

TEST(LearnDelays, ADigitThatNeverTouchesDoesNotWait) {
  const auto closing =
      LearnDelays(MakeGrasp(), {MakeTrial(0.2, kNever, 0.5), MakeTrial(0.2, kNever, 0.5)}, 1.0);
  ASSERT_EQ(closing.size(), 1u);
  EXPECT_NEAR(closing.at("TH").delay, 0.3, 1e-12);
  EXPECT_TRUE(LearnDelays(MakeGrasp(), {}, 1.0).empty());
}

TEST(DescribeDelays, NamesTheDigitsThatWait) {
  Grasp grasp = MakeGrasp();
  EXPECT_EQ(DescribeDelays(grasp), "");
  grasp.closing = {{"FF", {0.026, 1.0}}, {"MF", {0.0, 2.0}}, {"TH", {0.0879, 1.0}}};
  EXPECT_EQ(DescribeDelays(grasp), "TH waits 88 ms, FF 26 ms");
}

}  // namespace
}  // namespace graspbench
