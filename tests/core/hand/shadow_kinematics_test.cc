// Forward kinematics of the Shadow Hand against the figures of its maker's public description,
// composed here with elementary rotations only.

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d Rx(double angle_deg) {
  const double c = std::cos(RadFromDeg(angle_deg)), s = std::sin(RadFromDeg(angle_deg));
  return (Matrix3d() << 1, 0, 0, 0, c, -s, 0, s, c).finished();
}
Matrix3d Ry(double angle_deg) {
  const double c = std::cos(RadFromDeg(angle_deg)), s = std::sin(RadFromDeg(angle_deg));
  return (Matrix3d() << c, 0, s, 0, 1, 0, -s, 0, c).finished();
}
Matrix3d Rz(double angle_deg) {
  const double c = std::cos(RadFromDeg(angle_deg)), s = std::sin(RadFromDeg(angle_deg));
  return (Matrix3d() << c, -s, 0, s, c, 0, 0, 0, 1).finished();
}

class ShadowKinematicsTest : public testing::Test {
 protected:
  void Set(const std::string& joint, double angle_deg) {
    ASSERT_GE(hand_.FindJoint(joint), 0) << joint;
    q_[hand_.FindJoint(joint)] = RadFromDeg(angle_deg);
  }
  /** Pose of a link in the palm, whatever the wrist does. */
  Pose InPalm(const std::string& link) const {
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, q_);
    return X_HL[hand_.palm_link].inverse() * X_HL[hand_.FindLink(link)];
  }
  void Expect(const std::string& link, const Vector3d& p_mm, const Matrix3d& R) {
    const Pose X_PL = InPalm(link);
    EXPECT_LT((X_PL.translation() * 1e3 - p_mm).norm(), 1e-3)
        << link << ": " << (X_PL.translation() * 1e3).transpose() << " against "
        << p_mm.transpose();
    EXPECT_LT((X_PL.linear() - R).cwiseAbs().maxCoeff(), 1e-6) << link;
  }

  Hand hand_ = LoadHand("shadow");
  Eigen::VectorXd q_ = Eigen::VectorXd::Zero(hand_.num_joints());
};

TEST_F(ShadowKinematicsTest, HasTheJointsOfTheMakerInTheOrderFingerByFinger) {
  std::vector<std::string> names;
  for (const HandJoint& joint : hand_.joints) names.push_back(joint.name);
  EXPECT_EQ(names, (std::vector<std::string>{"FFJ4", "FFJ3", "FFJ2", "FFJ1", "MFJ4", "MFJ3",
                                             "MFJ2", "MFJ1", "RFJ4", "RFJ3", "RFJ2", "RFJ1",
                                             "LFJ5", "LFJ4", "LFJ3", "LFJ2", "LFJ1", "THJ5",
                                             "THJ4", "THJ3", "THJ2", "THJ1", "WRJ2", "WRJ1"}));
}

TEST_F(ShadowKinematicsTest, AtRestTheFingersPointUpAndTheThumbToTheIndexSide) {
  Expect("ffdistal", {33, 0, 165}, Matrix3d::Identity());
  Expect("mfdistal", {11, 0, 169}, Matrix3d::Identity());
  Expect("rfdistal", {-11, 0, 165}, Matrix3d::Identity());
  // The little knuckle lies 0.6579 of 100 mm above the metacarpal's joint: c = cos 55 deg.
  Expect("lfdistal", {-33, 0, 20.71 + 65.79 + 70}, Matrix3d::Identity());
  const double along = (38.0 + 32.0) / std::sqrt(2.0);
  Expect("thdistal", {34 + along, -8.58, 29 + along}, Rz(-90) * Rx(-45));
}

TEST_F(ShadowKinematicsTest, FingersBend) {
  struct {
    const char* finger;
    Vector3d knuckle_mm;
    double spread_sign;  // of the rotation about y
    double j4, j3, j2, j1;
  } cases[] = {{"FF", {33, 0, 95}, -1, 12, 30, 40, 20},
               {"MF", {11, 0, 99}, -1, -15, 80, 85, 60},
               {"RF", {-11, 0, 95}, 1, 20, -10, 5, 0}};
  for (const auto& c : cases) {
    const std::string f = c.finger;
    Set(f + "J4", c.j4);
    Set(f + "J3", c.j3);
    Set(f + "J2", c.j2);
    Set(f + "J1", c.j1);
    const Matrix3d R_spread = Ry(c.spread_sign * c.j4);
    const Vector3d p_mm = c.knuckle_mm + R_spread * (Rx(c.j3) * Vector3d(0, 0, 45) +
                                                     Rx(c.j3 + c.j2) * Vector3d(0, 0, 25));
    std::string link = {static_cast<char>(std::tolower(f[0])), 'f'};
    Expect(link + "distal", p_mm, R_spread * Rx(c.j3 + c.j2 + c.j1));
  }
}

TEST_F(ShadowKinematicsTest, TheLittleFingerBendsWithThePalm) {
  Set("LFJ5", 35);
  Set("LFJ4", -8);
  Set("LFJ3", 50);
  Set("LFJ2", 33);
  Set("LFJ1", 12);
  const double turn_deg = DegFromRad(0.9599);
  const Matrix3d R_meta = Ry(-turn_deg) * Rx(35);
  const Matrix3d R_knuckle = R_meta * Ry(turn_deg) * Ry(-8);
  const Vector3d p_mm = Vector3d(-33, 0, 20.71) + R_meta * Vector3d(53.89084, 0, 37.73727) +
                        R_knuckle * (Rx(50) * Vector3d(0, 0, 45) + Rx(83) * Vector3d(0, 0, 25));
  Expect("lfdistal", p_mm, R_knuckle * Rx(95));
}

TEST_F(ShadowKinematicsTest, TheThumbOpposes) {
  Set("THJ5", 40);
  Set("THJ4", 63);
  Set("THJ3", 4);
  Set("THJ2", -17);
  Set("THJ1", 25);
  const Matrix3d R_proximal = Rz(-90) * Rx(-45) * Rz(-40) * Ry(63);
  const Matrix3d R_middle = R_proximal * Ry(4) * Rx(-17);
  const Vector3d p_mm =
      Vector3d(34, -8.58, 29) + R_proximal * Vector3d(0, 0, 38) + R_middle * Vector3d(0, 0, 32);
  Expect("thdistal", p_mm, R_middle * Rx(25));
}

TEST_F(ShadowKinematicsTest, TheWristMovesThePalmButNotTheFingersInThePalm) {
  const Pose at_rest = InPalm("thdistal");
  EXPECT_TRUE(CalcLinkPoses(hand_, q_)[hand_.palm_link].isApprox(Pose::Identity(), 1e-12));
  Set("WRJ2", -20);
  Set("WRJ1", 15);
  // H is the palm at rest, 34 mm above WRJ2.
  const Pose X_HP = CalcLinkPoses(hand_, q_)[hand_.palm_link];
  const Vector3d p_mm = Vector3d(0, 0, -34) + Ry(-20) * Vector3d(0, 0, 34);
  EXPECT_LT((X_HP.translation() * 1e3 - p_mm).norm(), 1e-9);
  EXPECT_LT((X_HP.linear() - Ry(-20) * Rx(15)).norm(), 1e-12);
  EXPECT_TRUE(InPalm("thdistal").isApprox(at_rest, 1e-12));
}

TEST_F(ShadowKinematicsTest, LimitsOfTheMaker) {
  struct {
    const char* joint;
    double lower_deg, upper_deg;
  } limits[] = {{"FFJ4", -20, 20}, {"MFJ3", -15, 90}, {"RFJ2", 0, 90},   {"LFJ1", 0, 90},
                {"LFJ5", 0, 45},   {"THJ5", -60, 60}, {"THJ4", 0, 70},   {"THJ3", -12, 12},
                {"THJ2", -40, 40}, {"THJ1", -15, 90}, {"WRJ2", -30, 10}, {"WRJ1", -40, 28}};
  for (const auto& limit : limits) {
    const HandJoint& joint = hand_.joints[hand_.FindJoint(limit.joint)];
    EXPECT_NEAR(DegFromRad(joint.lower), limit.lower_deg, 1e-5) << limit.joint;
    EXPECT_NEAR(DegFromRad(joint.upper), limit.upper_deg, 1e-5) << limit.joint;
  }
}

TEST_F(ShadowKinematicsTest, PositiveAnglesBendTowardsThePalmAndTheMiddleFinger) {
  for (const std::string f : {"FF", "MF", "RF", "LF"}) {
    std::string link = {static_cast<char>(std::tolower(f[0])), 'f'};
    const Pose before = InPalm(link + "distal");
    for (const char* joint : {"J3", "J2"}) {
      q_.setZero();
      Set(f + joint, 10);
      EXPECT_LT(InPalm(link + "distal").translation().y(), before.translation().y()) << f << joint;
    }
    q_.setZero();
    Set(f + "J4", 10);
    const double moved = InPalm(link + "distal").translation().x() - before.translation().x();
    // FF is at +x; RF and LF are at -x; the middle finger itself goes to the ring finger.
    EXPECT_TRUE(f == "FF" || f == "MF" ? moved < 0.0 : moved > 0.0) << f;
  }
}

}  // namespace
}  // namespace graspbench
