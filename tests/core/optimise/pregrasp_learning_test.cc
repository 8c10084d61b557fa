#include "core/optimise/pregrasp_learning.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr PreGraspWidth kWidths[] = {PreGraspWidth::kWidest, PreGraspWidth::kAboveTable,
                                     PreGraspWidth::kHalf};
constexpr double kPrecision = 2e-3;  ///< of s, by the field and the steps of the course

constexpr double kRadius = 0.025;

const GraspObject& GolfBall() {
  static const GraspObject ball = [] {
    GraspObject made;
    made.size = Vector3d::Constant(2.0 * kRadius);
    made.mesh = MakeSphere(kRadius, 48);
    made.field = std::make_shared<const SignedDistanceField>(SignedDistanceField::Build(made.mesh));
    return made;
  }();
  return ball;
}

class LearnPreGraspTest : public testing::Test {
 protected:
  LearnPreGraspTest() : hand_(LoadHand("tum")) {
    grasp_ = LoadStandardGrasps(hand_).at(5);  // g6, encloses
    grasp_.placement = CalcPlacement(hand_, grasp_, GolfBall().size, Vector3d::Zero());
    follows_.assign(grasp_.digits.size(), VectorXd::Zero(hand_.num_joints()));
  }

  const Digit& FindDigit(const std::string& id) const {
    return *std::find_if(hand_.digits.begin(), hand_.digits.end(),
                         [&](const Digit& digit) { return digit.id == id; });
  }
  double FindTouch(size_t digit, const VectorXd& q_pre, const VectorXd& deviation) const {
    return CalcDigitCourse(hand_, GolfBall(), grasp_, FindDigit(grasp_.digits[digit]), q_pre,
                           deviation)
        .touch;
  }
  LearnedPreGrasp Learn(const std::vector<VectorXd>& deviations,
                        PreGraspWidth width = PreGraspWidth::kWidest) const {
    return LearnPreGrasp(hand_, GolfBall(), grasp_, deviations, width);
  }
  /** Closes a digit's pre-grasp by a part of its way to the target. */
  void CloseIn(const std::string& id, double share) {
    for (const int joint : FindDrivenJoints(hand_, FindDigit(id))) {
      grasp_.q_pre[joint] += share * (grasp_.q_target[joint] - grasp_.q_pre[joint]);
    }
    grasp_.q_pre = CalcClosingPosture(hand_, grasp_, 0.0);
  }

  Hand hand_;
  Grasp grasp_;
  std::vector<VectorXd> follows_;  ///< a hand that moves as it is told
};

TEST_F(LearnPreGraspTest, AllDigitsMeetTheBallAtTheSameTime) {
  CloseIn("TH", 0.3);
  for (const PreGraspWidth width : kWidths) {
    const LearnedPreGrasp learned = Learn(follows_, width);
    ASSERT_TRUE(learned.is_new);
    for (size_t d = 0; d < grasp_.digits.size(); ++d) {
      EXPECT_EQ(learned.digit_cases[d], DigitCase::kLearned);
      EXPECT_NEAR(FindTouch(d, learned.q_pre, follows_[d]), learned.common_closing, kPrecision);
    }
  }
}

// What the lesson showed of lag and of fingers in each other's way is expected again.
TEST_F(LearnPreGraspTest, DeviationsAreMadeUpFor) {
  const int joint = hand_.FindJoint(grasp_.digits[1] + "q2");
  follows_[1][joint] = -RadFromDeg(5.0);
  const LearnedPreGrasp learned = Learn(follows_);
  ASSERT_TRUE(learned.is_new);
  for (size_t d = 0; d < grasp_.digits.size(); ++d) {
    EXPECT_NEAR(FindTouch(d, learned.q_pre, follows_[d]), learned.common_closing, kPrecision);
  }
  EXPECT_LT(FindTouch(1, learned.q_pre, VectorXd::Zero(hand_.num_joints())),
            learned.common_closing - 0.05);
}

// (q_c - s* q_target) / (1 - s*), with the angles q_c at which the digit touched.
TEST_F(LearnPreGraspTest, IsTheClosedFormWhereNoJointIsAtItsLimit) {
  CloseIn("TH", 0.3);
  const LearnedPreGrasp learned = Learn(follows_, PreGraspWidth::kHalf);
  const size_t thumb = static_cast<size_t>(
      std::find(grasp_.digits.begin(), grasp_.digits.end(), "TH") - grasp_.digits.begin());
  const double touch = FindTouch(thumb, grasp_.q_pre, follows_[thumb]);
  const double s = learned.common_closing;
  for (const int j : FindDrivenJoints(hand_, FindDigit("TH"))) {
    const double contact = grasp_.q_pre[j] + touch * (grasp_.q_target[j] - grasp_.q_pre[j]);
    EXPECT_NEAR(learned.q_pre[j], (contact - s * grasp_.q_target[j]) / (1.0 - s), RadFromDeg(0.3));
  }
}

TEST_F(LearnPreGraspTest, ADigitThatNeverComesKeepsItsPreGrasp) {
  const Digit& index = FindDigit("FF");
  for (const int joint : FindDrivenJoints(hand_, index)) {
    grasp_.q_target[joint] = grasp_.q_pre[joint];
  }
  const LearnedPreGrasp learned = Learn(follows_);
  ASSERT_TRUE(learned.is_new);
  for (size_t d = 0; d < grasp_.digits.size(); ++d) {
    const bool is_index = grasp_.digits[d] == "FF";
    EXPECT_EQ(learned.digit_cases[d] == DigitCase::kNeverTouched, is_index);
  }
  for (const int joint : FindDrivenJoints(hand_, index)) {
    EXPECT_EQ(learned.q_pre[joint], grasp_.q_pre[joint]);
  }
}

TEST_F(LearnPreGraspTest, ADigitThatTouchesAtOnceIsOpened) {
  CloseIn("TH", 0.6);
  const LearnedPreGrasp learned = Learn(follows_);
  ASSERT_TRUE(learned.is_new);
  for (size_t d = 0; d < grasp_.digits.size(); ++d) {
    EXPECT_EQ(learned.digit_cases[d] == DigitCase::kTouchedAtOnce, grasp_.digits[d] == "TH");
    EXPECT_NEAR(FindTouch(d, learned.q_pre, follows_[d]), learned.common_closing, kPrecision);
  }
}

// The lesson's posture minus the command, of the digit's own joints.
TEST_F(LearnPreGraspTest, DeviationsAreThoseOfTheDigitsOwnJoints) {
  const std::vector<double> closings = {0.3, 0.4, std::nan("")};
  std::vector<VectorXd> q(3);
  for (size_t d = 0; d < 2; ++d) {
    q[d] = CalcClosingPosture(hand_, grasp_, closings[d]);
    q[d].array() += 0.01 * static_cast<double>(d + 1);
  }
  const std::vector<VectorXd> deviations = CalcDeviations(hand_, grasp_, closings, q);
  ASSERT_EQ(deviations.size(), 3u);
  for (int j = 0; j < hand_.num_joints(); ++j) {
    const int digit = hand_.FindDigitOfLink(hand_.joints[j].link);
    for (size_t d = 0; d < 3; ++d) {
      const bool is_own = hand_.digits[digit].id == grasp_.digits[d];
      EXPECT_NEAR(deviations[d][j], is_own && d < 2 ? 0.01 * static_cast<double>(d + 1) : 0.0,
                  1e-12);
    }
  }
}

TEST(LearnPreGrasp, WorksForEveryStandardGraspOfEveryHand) {
  for (const std::string& id : ListHands()) {
    const Hand hand = LoadHand(id);
    for (Grasp grasp : LoadStandardGrasps(hand)) {
      grasp.placement = CalcPlacement(hand, grasp, GolfBall().size, Vector3d::Zero());
      const std::vector<VectorXd> follows(grasp.digits.size(), VectorXd::Zero(hand.num_joints()));
      for (const PreGraspWidth width : kWidths) {
        const LearnedPreGrasp learned = LearnPreGrasp(hand, GolfBall(), grasp, follows, width);
        EXPECT_GE(learned.opening, learned.required_opening) << id << " " << grasp.id;
        EXPECT_LE(learned.common_closing, kLargestCommonClosing);
        for (int j = 0; j < hand.num_joints(); ++j) {
          EXPECT_GE(learned.q_pre[j], hand.joints[j].lower - 1e-9);
          EXPECT_LE(learned.q_pre[j], hand.joints[j].upper + 1e-9);
        }
      }
    }
  }
}

class DigitCourseTest : public testing::Test {
 protected:
  DigitCourseTest() : hand_(LoadHand("tum")), grasp_(LoadStandardGrasps(hand_).at(5)) {
    grasp_.placement = CalcPlacement(hand_, grasp_, GolfBall().size, Vector3d::Zero());
  }

  DigitCourse Calc(const Digit& digit, const VectorXd& deviation) const {
    return CalcDigitCourse(hand_, GolfBall(), grasp_, digit, grasp_.q_pre, deviation);
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
      const Vector3d p_WS = grasp_.placement->X_WH * (X_HL[sphere.link] * sphere.p_LS);
      gap = std::min(gap, (p_WS - Vector3d(0, 0, kRadius)).norm() - kRadius - sphere.radius);
    }
    return gap;
  }

  Hand hand_;
  Grasp grasp_;
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

const double kNoTouch = std::nan("");

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
      LearnDelays(MakeGrasp(), {MakeTrial(0.2, kNoTouch, 0.5), MakeTrial(0.2, kNoTouch, 0.5)}, 1.0);
  ASSERT_EQ(closing.size(), 1u);
  EXPECT_NEAR(closing.at("TH").delay, 0.3, 1e-12);
  EXPECT_TRUE(LearnDelays(MakeGrasp(), {}, 1.0).empty());
}

}  // namespace
}  // namespace graspbench
