#include "core/optimise/pregrasp_learning.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

using Eigen::VectorXd;

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

const Hand& TumHand() {
  static const Hand hand = LoadHand("tum");
  return hand;
}

/** A grasp far from all limits, so that these do not bind. */
StandardGrasp MakeGrasp() {
  const Hand& hand = TumHand();
  StandardGrasp grasp = LoadStandardGrasps(hand).at(2);
  for (const char* finger : {"FF", "MF", "TH"}) {
    const std::string id = finger;
    grasp.q_pre[hand.FindJoint(id + "q1")] = 0.0;
    grasp.q_pre[hand.FindJoint(id + "q2")] = RadFromDeg(0.0);
    grasp.q_pre[hand.FindJoint(id + "q3")] = RadFromDeg(10.0);
    grasp.q_target[hand.FindJoint(id + "q1")] = RadFromDeg(2.0);
    grasp.q_target[hand.FindJoint(id + "q2")] = RadFromDeg(20.0);
    grasp.q_target[hand.FindJoint(id + "q3")] = RadFromDeg(30.0);
  }
  return grasp;
}

/** When a digit of a hand that follows its commands without lag meets a thing that it touches at a
certain angle of its base joint. */
double FindTouch(const StandardGrasp& grasp, const std::string& digit, double angle) {
  const int joint = TumHand().FindJoint(digit + "q2");
  return (angle - grasp.q_pre[joint]) / (grasp.q_target[joint] - grasp.q_pre[joint]);
}

// On a hand that moves as it is told the rule is exact: all digits meet the object at s*.
TEST(LearnPreGrasp, ALinearHandTouchesWithAllDigitsAtTheSameTime) {
  const Hand& hand = TumHand();
  const StandardGrasp grasp = MakeGrasp();
  const double angles[] = {RadFromDeg(14.0), RadFromDeg(9.0), RadFromDeg(11.0)};
  std::vector<double> closings;
  for (size_t d = 0; d < 3; ++d) closings.push_back(FindTouch(grasp, grasp.digits[d], angles[d]));
  const LearnedPreGrasp learned = LearnPreGrasp(hand, grasp, closings);
  EXPECT_EQ(learned.share, 1.0);
  StandardGrasp better = grasp;
  better.q_pre = learned.q_pre;
  for (size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(FindTouch(better, grasp.digits[d], angles[d]), learned.common_closing, 1e-12);
    EXPECT_EQ(learned.digit_cases[d], DigitCase::kLearned);
  }
  EXPECT_GT(learned.common_closing, 0.0);
}

TEST(LearnPreGrasp, OpensAsFarAsTheFirstJointLimit) {
  const Hand& hand = TumHand();
  const StandardGrasp grasp = MakeGrasp();
  const LearnedPreGrasp learned = LearnPreGrasp(hand, grasp, {0.7, 0.5, 0.6});
  int num_at_limit = 0;
  for (int j = 0; j < hand.num_joints(); ++j) {
    const HandJoint& joint = hand.joints[static_cast<size_t>(j)];
    if (joint.coupled_to >= 0) continue;
    EXPECT_GE(learned.q_pre[j], joint.lower);
    EXPECT_LE(learned.q_pre[j], joint.upper);
    num_at_limit += learned.q_pre[j] < joint.lower + 1e-9;
  }
  EXPECT_GE(num_at_limit, 1);
  EXPECT_GT(learned.opening, CalcOpening(hand, grasp, grasp.q_pre));
}

TEST(LearnPreGrasp, ADigitThatNeverTouchesKeepsItsPreGrasp) {
  const Hand& hand = TumHand();
  const StandardGrasp grasp = MakeGrasp();
  const LearnedPreGrasp learned = LearnPreGrasp(hand, grasp, {0.7, kNever, 0.5});
  EXPECT_EQ(learned.digit_cases[1], DigitCase::kNeverTouched);
  for (const Digit& digit : hand.digits) {
    for (const int joint : FindDrivenJoints(hand, digit)) {
      if (digit.id == grasp.digits[1]) {
        EXPECT_EQ(learned.q_pre[joint], grasp.q_pre[joint]);
      } else {
        EXPECT_NE(learned.q_pre[joint], grasp.q_pre[joint]);
      }
    }
  }
}

TEST(LearnPreGrasp, ADigitThatTouchesAtOnceIsOpenedAndDoesNotBindTheOthers) {
  const Hand& hand = TumHand();
  const StandardGrasp grasp = MakeGrasp();
  const LearnedPreGrasp two = LearnPreGrasp(hand, grasp, {0.7, kNever, 0.5});
  const LearnedPreGrasp learned = LearnPreGrasp(hand, grasp, {0.7, -0.01, 0.5});
  EXPECT_EQ(learned.digit_cases[1], DigitCase::kTouchedAtOnce);
  EXPECT_EQ(learned.common_closing, two.common_closing);
  const int joint = hand.FindJoint(grasp.digits[1] + "q2");
  EXPECT_LT(learned.q_pre[joint], grasp.q_pre[joint]);
}

TEST(LearnPreGrasp, NothingIsLearnedFromOneDigit) {
  const StandardGrasp grasp = MakeGrasp();
  const LearnedPreGrasp learned = LearnPreGrasp(TumHand(), grasp, {0.7, kNever, 0.0});
  EXPECT_EQ(learned.share, 0.0);
  EXPECT_EQ(learned.q_pre, grasp.q_pre);
}

TEST(LearnPreGrasp, TheOpeningStaysTwentyMillimetresAboveTheWidth) {
  const Hand& hand = TumHand();
  StandardGrasp grasp = MakeGrasp();
  // All fingers at their lower limits: s* is the earliest touch, the late digits must close in.
  for (const Digit& digit : hand.digits) {
    for (const int joint : FindDrivenJoints(hand, digit)) {
      if (grasp.q_target[joint] > grasp.q_pre[joint]) {
        grasp.q_pre[joint] = hand.joints[static_cast<size_t>(joint)].lower;
      }
    }
  }
  const LearnedPreGrasp learned = LearnPreGrasp(hand, grasp, {0.95, 0.95, 0.3});
  EXPECT_LT(learned.share, 1.0);
  EXPECT_GE(learned.opening, learned.required_opening);
  EXPECT_LT(learned.opening, learned.required_opening + 0.002);
  EXPECT_LE(learned.required_opening, CalcOpening(hand, grasp, grasp.q_pre));
}

TEST(LearnPreGrasp, WorksForEveryStandardGraspOfEveryHand) {
  for (const std::string& id : ListHands()) {
    const Hand hand = LoadHand(id);
    for (const StandardGrasp& grasp : LoadStandardGrasps(hand)) {
      std::vector<double> closings;
      for (size_t d = 0; d < grasp.digits.size(); ++d) {
        closings.push_back(0.3 + 0.6 * static_cast<double>(d) / 5.0);
      }
      const LearnedPreGrasp learned = LearnPreGrasp(hand, grasp, closings);
      EXPECT_TRUE(learned.q_pre.allFinite());
      EXPECT_GE(learned.opening, learned.required_opening) << id << " " << grasp.id;
      EXPECT_LE(learned.common_closing, kLargestCommonClosing);
      for (int j = 0; j < hand.num_joints(); ++j) {
        EXPECT_GE(learned.q_pre[j], hand.joints[static_cast<size_t>(j)].lower - 1e-9);
        EXPECT_LE(learned.q_pre[j], hand.joints[static_cast<size_t>(j)].upper + 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace graspbench
