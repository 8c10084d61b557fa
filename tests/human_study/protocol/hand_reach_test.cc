#include "tests/human_study/protocol/hand_reach.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "human_study/study/run/trial_flags.h"
#include "tests/human_study/protocol/everyday_study.h"

namespace graspbench::everyday {
namespace {

TEST(HandReach, TipsAreWhereBonesLetThemBe) {
  Conditions conditions;
  conditions.noise_sd = 0.0;
  for (int trial = 0; trial < 8; ++trial) {
    const Reach reach = MakeHandReach(conditions, "bones " + std::to_string(trial / 4), trial);
    const size_t held = reach.times.size() - 1;
    constexpr double kDiameters[] = {6e-3, 20e-3, 45e-3, 80e-3};
    // Both nails are a pad and the thing, twice a tip's half thickness each, apart.
    const double apart = (reach.digits[0][held] - reach.digits[1][held]).norm();
    EXPECT_GT(apart, kDiameters[trial % 4] + 14e-3) << trial;
    EXPECT_LT(apart, kDiameters[trial % 4] + 36e-3) << trial;
    double widest = 0.0;
    for (size_t i = 0; i < reach.times.size(); ++i) {
      if (reach.times[i] > reach.touch_times[0]) break;
      widest = std::max(widest, (reach.digits[0][i] - reach.digits[1][i]).norm());
      EXPECT_LT((reach.digits[0][i] - reach.wrist[i]).norm(), 0.165) << trial;
      EXPECT_LT((reach.digits[2][i] - reach.wrist[i]).norm(), 0.235) << trial;
    }
    EXPECT_GT(widest, apart + 15e-3) << trial;
  }
}

/** Trials of a study by what is said of the thumb's label. */
struct Said {
  int num_removed = 0, num_unlikely = 0, num_not_told = 0, num_silent = 0;
  int num_elsewise = 0;  ///< removed by another name
  bool is_warned = false;
};

Said CountSaid(StudyPlan plan) {
  plan.seed = "hands of bones";
  plan.num_people = 5;
  plan.trials_per_person = 4;
  plan.has_shape = false;
  const StudyResult result =
      RunPlan(plan, std::filesystem::path(::testing::TempDir()) /
                        (std::string("hand_reach_") +
                         ::testing::UnitTest::GetInstance()->current_test_info()->name()))
          .result;
  Said said;
  for (const StudyTrial& trial : result.trials) {
    if (trial.removed_code == "thumb_not_opposed") {
      ++said.num_removed;
    } else if (!trial.IsKept()) {
      ++said.num_elsewise;
    } else if (trial.analysis->thumb_label == ThumbLabel::kUnlikely) {
      ++said.num_unlikely;
    } else {
      ++(trial.analysis->thumb_label == ThumbLabel::kNotTold ? said.num_not_told : said.num_silent);
    }
  }
  for (const StudyWarning& warning : result.warnings) {
    said.is_warned |= warning.code == "thumb_exchanged";
  }
  std::printf("%-30s %s %s: removed %d, unlikely %d%s, not told %d, nothing said %d, other %d\n",
              plan.digits.c_str(), plan.has_wrist ? "wrist" : "     ",
              plan.conditions.is_swapped ? "exchanged" : "right    ", said.num_removed,
              said.num_unlikely, said.is_warned ? " (warned)" : "", said.num_not_told,
              said.num_silent, said.num_elsewise);
  return said;
}

TEST(HandReach, ExchangedLabelsOfAGraspAreReportedAndRightOnesAreNot) {
  for (const char* digits : {"thumb index middle ring little", "thumb index middle"}) {
    for (const bool has_wrist : {true, false}) {
      StudyPlan plan;
      plan.make_reach = MakeHandReach;
      plan.digits = digits;
      plan.has_wrist = has_wrist;
      const Said right = CountSaid(plan);
      EXPECT_EQ(right.num_removed + right.num_unlikely, 0);
      EXPECT_FALSE(right.is_warned);
      plan.conditions.is_swapped = true;
      const Said exchanged = CountSaid(plan);
      EXPECT_EQ(exchanged.num_silent, 0);
      EXPECT_GE(exchanged.num_removed + exchanged.num_unlikely, 19);
    }
  }
}

TEST(HandReach, OfThumbAndIndexTheWristAloneTells) {
  StudyPlan plan;
  plan.make_reach = MakeHandReach;
  plan.digits = "thumb index";
  const Said right = CountSaid(plan);
  EXPECT_EQ(right.num_removed + right.num_unlikely, 0);
  plan.conditions.is_swapped = true;
  const Said exchanged = CountSaid(plan);
  EXPECT_EQ(exchanged.num_silent, 0);
  EXPECT_TRUE(exchanged.is_warned);
  plan.has_wrist = false;  // nothing tells, and that is said
  const Said not_told = CountSaid(plan);
  EXPECT_EQ(not_told.num_silent, 0);
  EXPECT_EQ(not_told.num_unlikely, 0);
}

TEST(HandReach, APinchWithCurledFingersIsNeverRemovedNorSilentlyWrong) {
  StudyPlan plan;
  plan.make_reach = MakePinchReach;
  plan.has_wrist = false;
  EXPECT_EQ(CountSaid(plan).num_removed, 0);
  plan.has_wrist = true;
  const Said right = CountSaid(plan);
  EXPECT_EQ(right.num_removed + right.num_unlikely, 0);
  plan.conditions.is_swapped = true;
  EXPECT_EQ(CountSaid(plan).num_silent, 0);
}

}  // namespace
}  // namespace graspbench::everyday
