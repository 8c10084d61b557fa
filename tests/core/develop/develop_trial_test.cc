#include "core/develop/develop_trial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

class DevelopTrialTest : public testing::Test {
 protected:
  DevelopTrialTest() {
    object_.mass_properties.mass = 0.1;
    result_.contacts = {{"TH", true, 0.4}, {"FF", false, std::nan("")}};
  }
  double Score(Outcome outcome) {
    result_.outcome = outcome;
    return MakeDevelopTrial(grasp_, object_, result_).score;
  }
  void Lift(double height) { result_.lift_height = height; }

  Grasp grasp_;
  GraspObject object_;
  TrialResult result_;
};

TEST_F(DevelopTrialTest, FailuresLeadTowardsSuccess) {
  EXPECT_EQ(Score(Outcome::kNumericalFailure), 0.0);
  const double one_touched = Score(Outcome::kNoContact);
  EXPECT_NEAR(one_touched, 0.15, 1e-12);
  result_.contacts[1].time = 0.5;
  const double all_touched = Score(Outcome::kSlippedInLiftOff);
  EXPECT_GT(all_touched, one_touched);
  Lift(0.05);
  const double half_lifted = Score(Outcome::kDroppedWhileHolding);
  EXPECT_NEAR(half_lifted, all_touched + 0.1, 1e-12);
  Lift(5.0);
  EXPECT_LT(Score(Outcome::kDroppedWhileHolding), 1.0);
}

// One of two digits touched: 0.1 of 0.2.
TEST_F(DevelopTrialTest, FirmIsBetterThanLoose) {
  result_.stability.sigma = 0.0;
  EXPECT_NEAR(Score(Outcome::kSuccess), 1.1, 1e-12);
  // x = 1: as much pull as weight and 0.2 N.
  result_.stability.sigma = 0.1 * kStandardGravity + 0.2;
  EXPECT_NEAR(Score(Outcome::kSuccess), 1.25, 1e-12);
}

TEST_F(DevelopTrialTest, APalmThatStillTouchesCountsWhereItMay) {
  result_.stability.sigma = 0.0;
  result_.contact_events = {{0.1, ContactEventKind::kTouch, "palm", "palm", kUnset}};
  EXPECT_NEAR(Score(Outcome::kSuccess), 1.1, 1e-12);
  grasp_.palm_may_touch = true;
  EXPECT_NEAR(Score(Outcome::kSuccess), 1.7, 1e-12);
  result_.contact_events.push_back({0.2, ContactEventKind::kLost, "palm", "palm", 0.1});
  EXPECT_NEAR(Score(Outcome::kSuccess), 1.1, 1e-12);
}

TEST_F(DevelopTrialTest, EveryDigitThatTouchesCounts) {
  result_.stability.sigma = 0.0;
  result_.contacts[1].time = 0.5;
  EXPECT_NEAR(Score(Outcome::kSuccess), 1.2, 1e-12);
}

TEST_F(DevelopTrialTest, EarlyContactsAreWorseThanNone) {
  result_.stability.sigma = 0.0;
  result_.timing.contact_before_start = true;
  EXPECT_NEAR(Score(Outcome::kSuccess), 0.8, 1e-12);
}

TEST_F(DevelopTrialTest, SidesCountInAPinchAlone) {
  result_.stability.sigma = 0.0;
  result_.opposition = Opposition::kSide;
  EXPECT_NEAR(Score(Outcome::kSuccess), 1.1, 1e-12);
  grasp_.type = GraspType::kTwoFingerPinch;
  EXPECT_NEAR(Score(Outcome::kSuccess), 1.25, 1e-12);
  result_.opposition = Opposition::kPad;
  EXPECT_NEAR(Score(Outcome::kSuccess), 1.1, 1e-12);
}

TEST(DevelopScoreTest, MeanAndCount) {
  EXPECT_EQ(CalcMeanScore({}), 0.0);
  const std::vector<DevelopTrial> trials = {{Outcome::kSuccess, 1.2}, {Outcome::kNoContact, 0.2}};
  EXPECT_NEAR(CalcMeanScore(trials), 0.7, 1e-12);
  EXPECT_EQ(CountSuccesses(trials), 1);
}

}  // namespace
}  // namespace graspbench
