#include "core/optimise/digit_course.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kRadius = 0.025;

std::shared_ptr<const SignedDistanceField> BallField() {
  static const auto field = std::make_shared<const SignedDistanceField>(
      SignedDistanceField::Build(MakeSphere(kRadius, 48)));
  return field;
}

class DigitCourseTest : public testing::Test {
 protected:
  DigitCourseTest() : hand_(LoadHand("tum")), grasp_(LoadStandardGrasps(hand_).at(2)) {
    ball_.size = Vector3d::Constant(2.0 * kRadius);
    ball_.field = BallField();
    grasp_.placement = CalcPlacement(hand_, grasp_, ball_.size, Vector3d::Zero());
  }

  DigitCourse Calc(const Digit& digit, const VectorXd& deviation) const {
    return CalcDigitCourse(hand_, ball_, grasp_, digit, grasp_.q_pre, deviation);
  }
  DigitCourse Calc(const Digit& digit) const {
    return Calc(digit, VectorXd::Zero(hand_.num_joints()));
  }

  /** Distance of a digit's nearest sphere from the ball, in closed form. */
  double CalcGap(const Digit& digit, double s) const {
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosingPosture(hand_, grasp_, s));
    double gap = 1.0;
    for (const ContactSphere& sphere : hand_.contact_spheres) {
      if (std::find(digit.links.begin(), digit.links.end(), sphere.link) == digit.links.end()) {
        continue;
      }
      const Vector3d p_WS =
          grasp_.placement->X_WH * (X_HL[static_cast<size_t>(sphere.link)] * sphere.p_LS);
      gap = std::min(gap, (p_WS - Vector3d(0, 0, kRadius)).norm() - kRadius - sphere.radius);
    }
    return gap;
  }

  Hand hand_;
  Grasp grasp_;
  GraspObject ball_;
};

TEST_F(DigitCourseTest, EndsWhereTheDigitMeetsABall) {
  for (const Digit& digit : hand_.digits) {
    const DigitCourse course = Calc(digit);
    ASSERT_GT(course.touch, 0.0) << digit.id;
    EXPECT_NEAR(CalcGap(digit, course.touch), 0.0, 1e-4) << digit.id;
    EXPECT_GT(CalcGap(digit, course.touch - 0.05), 5e-4) << digit.id;
    EXPECT_GT(course.lowest, 0.0);
    EXPECT_LT(course.lowest, 2.0 * kRadius);
  }
}

// Joints that are ahead by a part of the whole closing meet the ball earlier by that part.
TEST_F(DigitCourseTest, ADeviationAlongTheClosingMovesTheTouch) {
  constexpr double kAhead = 0.07;
  const VectorXd ahead =
      kAhead * (CalcClosingPosture(hand_, grasp_, 1.0) - CalcClosingPosture(hand_, grasp_, 0.0));
  for (const Digit& digit : hand_.digits) {
    EXPECT_NEAR(Calc(digit, ahead).touch, Calc(digit).touch - kAhead, 1e-3) << digit.id;
  }
}

TEST_F(DigitCourseTest, IsMissingForADigitThatNeverComesAndZeroForOneThatIsThere) {
  const Digit& digit = hand_.digits.front();
  grasp_.placement->X_WH.pretranslate(Vector3d(0.0, 0.0, 0.3));
  EXPECT_TRUE(std::isnan(Calc(digit).touch));
  const double touch = [&] {
    grasp_.placement->X_WH.pretranslate(Vector3d(0.0, 0.0, -0.3));
    return Calc(digit).touch;
  }();
  grasp_.q_pre = CalcClosingPosture(hand_, grasp_, touch + 0.1);
  EXPECT_EQ(Calc(digit).touch, 0.0);
}

}  // namespace
}  // namespace graspbench
