#include "core/optimise/pregrasp_learning.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "core/optimise/digit_course.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr PreGraspWidth kWidths[] = {PreGraspWidth::kWidest, PreGraspWidth::kAboveTable,
                                     PreGraspWidth::kHalf};
constexpr double kPrecision = 2e-3;  ///< of s, by the field and the steps of the course

constexpr double kRadius = 0.025;

const GraspObject& Ball() {
  static const GraspObject ball = [] {
    GraspObject made;
    made.size = Vector3d::Constant(2.0 * kRadius);
    made.mesh = MakeSphere(kRadius);
    made.field = std::make_shared<const SignedDistanceField>(SignedDistanceField::Build(made.mesh));
    return made;
  }();
  return ball;
}

class LearnPreGraspTest : public testing::Test {
 protected:
  LearnPreGraspTest() : hand_(LoadHand("tum")) {
    grasp_ = LoadStandardGrasps(hand_).at(2);
    grasp_.placement = CalcPlacement(hand_, grasp_, Ball().size, Vector3d::Zero());
    follows_.assign(grasp_.digits.size(), VectorXd::Zero(hand_.num_joints()));
  }

  const Digit& FindDigit(const std::string& id) const {
    return *std::find_if(hand_.digits.begin(), hand_.digits.end(),
                         [&](const Digit& digit) { return digit.id == id; });
  }
  double FindTouch(size_t digit, const VectorXd& q_pre, const VectorXd& deviation) const {
    return CalcDigitCourse(hand_, Ball(), grasp_, FindDigit(grasp_.digits[digit]), q_pre, deviation)
        .touch;
  }
  LearnedPreGrasp Learn(const std::vector<VectorXd>& deviations,
                        PreGraspWidth width = PreGraspWidth::kWidest) const {
    return LearnPreGrasp(hand_, Ball(), grasp_, deviations, width);
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

TEST_F(LearnPreGraspTest, TheThreeWidthsAreInOrder) {
  CloseIn("TH", 0.3);
  const double widest = Learn(follows_, PreGraspWidth::kWidest).common_closing;
  const double above_table = Learn(follows_, PreGraspWidth::kAboveTable).common_closing;
  const double half = Learn(follows_, PreGraspWidth::kHalf).common_closing;
  EXPECT_GE(widest, above_table);
  EXPECT_GT(above_table, half + 0.01);
  double first = 1.0;
  for (size_t d = 0; d < 3; ++d) first = std::min(first, FindTouch(d, grasp_.q_pre, follows_[d]));
  EXPECT_NEAR(half, 0.5 * (above_table + first), 1e-12);
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

TEST_F(LearnPreGraspTest, NothingIsLearnedFromOneDigit) {
  for (const char* id : {"FF", "MF"}) {
    for (const int joint : FindDrivenJoints(hand_, FindDigit(id))) {
      grasp_.q_target[joint] = grasp_.q_pre[joint];
    }
  }
  const LearnedPreGrasp learned = Learn(follows_);
  EXPECT_FALSE(learned.is_new);
  EXPECT_EQ(learned.q_pre, grasp_.q_pre);
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
    const int digit = hand_.FindDigitOfLink(hand_.joints[static_cast<size_t>(j)].link);
    for (size_t d = 0; d < 3; ++d) {
      const bool is_own = hand_.digits[static_cast<size_t>(digit)].id == grasp_.digits[d];
      EXPECT_NEAR(deviations[d][j], is_own && d < 2 ? 0.01 * static_cast<double>(d + 1) : 0.0,
                  1e-12);
    }
  }
}

TEST(LearnPreGrasp, WorksForEveryStandardGraspOfEveryHand) {
  for (const std::string& id : ListHands()) {
    const Hand hand = LoadHand(id);
    for (Grasp grasp : LoadStandardGrasps(hand)) {
      grasp.placement = CalcPlacement(hand, grasp, Ball().size, Vector3d::Zero());
      const std::vector<VectorXd> follows(grasp.digits.size(), VectorXd::Zero(hand.num_joints()));
      for (const PreGraspWidth width : kWidths) {
        const LearnedPreGrasp learned = LearnPreGrasp(hand, Ball(), grasp, follows, width);
        EXPECT_GE(learned.opening, learned.required_opening) << id << " " << grasp.id;
        EXPECT_LE(learned.common_closing, kLargestCommonClosing);
        for (int j = 0; j < hand.num_joints(); ++j) {
          EXPECT_GE(learned.q_pre[j], hand.joints[static_cast<size_t>(j)].lower - 1e-9);
          EXPECT_LE(learned.q_pre[j], hand.joints[static_cast<size_t>(j)].upper + 1e-9);
        }
      }
    }
  }
}

}  // namespace
}  // namespace graspbench
