#include "core/trial/protocols/palm_approach.h"

#include <gtest/gtest.h>

#include "core/trial/protocols/protocol.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

constexpr double kStep = 0.002, kArmStiffness = 2e4;

// 0 to 5 mm/s in 0.1 s is 0.25 mm; the 15.75 mm that are left take 3.15 s.
TEST(PalmApproach, GoesItsWholeWayWithoutATouch) {
  PalmApproach palm(true);
  EXPECT_EQ(palm.offset(), -0.008);
  int num_steps = 0;
  for (; !palm.has_ended(); ++num_steps) palm.Advance(kStep, 0.0, kArmStiffness);
  EXPECT_NEAR(num_steps * kStep, 3.25, 0.01);
  EXPECT_NEAR(palm.offset(), 0.008, 2e-5);
  EXPECT_FALSE(palm.has_touched());
  EXPECT_EQ(palm.speed(), 0.0);
}

TEST(PalmApproach, StaysAndPressesWhereTheArmBearsTheThreshold) {
  PalmApproach palm(true);
  for (int k = 0; k < 400; ++k) palm.Advance(kStep, 0.999, kArmStiffness);
  const double before = palm.offset();
  palm.Advance(kStep, 1.0, kArmStiffness);
  EXPECT_TRUE(palm.has_touched());
  EXPECT_FALSE(palm.has_ended()) << "it settles";
  EXPECT_NEAR(palm.offset(), before + 5e-5, 1e-12) << "1 N at 20 N/mm";
  palm.Advance(kStep, 0.0, kArmStiffness);
  EXPECT_NEAR(palm.offset(), before + 5e-5, 1e-12);
  for (int k = 0; k < 51; ++k) palm.Advance(kStep, 0.0, kArmStiffness);
  EXPECT_TRUE(palm.has_ended()) << "after 0.1 s";
}

TEST(PalmApproach, AGraspThatDoesNotSeekHasArrived) {
  const PalmApproach palm(false);
  EXPECT_TRUE(palm.has_ended());
  EXPECT_EQ(palm.offset(), 0.0);
}

// From above on a drum as tall as the fingers reach, and from the side: the palm touches before a
// digit closes, stays there, and the table bears at most 5 N more than the object's weight.
TEST(PalmApproach, ThePalmTouchesBeforeTheDigitsClose) {
  const double mass = 0.3;
  GraspObject drum =
      MakeSolid(MakeRevolution({{0.0, -0.055}, {0.028, -0.055}, {0.028, 0.055}, {0.0, 0.055}}, 48),
                mass, 0.4, 0.4);
  drum.id = "drum";
  for (const Approach approach : {Approach::kAbove, Approach::kSide}) {
    drum.approach = approach;
    TrialSetup setup = MakeSetup("tum", "g3", std::make_shared<const GraspObject>(drum));
    setup.grasp.palm_gap = 0.0;
    setup.grasp.seeks_palm = true;
    double worst = 0.0;
    const TrialResult result =
        TrialRunner(setup.hand, setup.object).Run(setup, [&](TrialCourse& course) {
          if (course.phase() <= Phase::kPlacing) {
            worst = std::max(worst, course.report().table_force - mass * kStandardGravity);
          }
        });
    double palm = kUnset;
    for (const ContactEvent& event : result.contact_events) {
      if (event.digit == "palm" && std::isnan(palm)) palm = event.time;
    }
    EXPECT_LT(palm, 0.0) << result.reason;
    EXPECT_LT(worst, 5.0);
    if (approach == Approach::kAbove) {
      EXPECT_GT(worst, 0.5) << "the table feels the touch";
    }
  }
}

}  // namespace
}  // namespace graspbench
