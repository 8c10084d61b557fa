#include "core/arm/arm_inverse.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/arm/load_arm.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "tests/core/arm/draw_posture.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/** Largest difference of angles, whole turns apart being equal. */
double CalcDifference(const VectorXd& a, const VectorXd& b) {
  double difference = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    difference = std::max(difference, std::abs(std::remainder(a[i] - b[i], 2.0 * kPi)));
  }
  return difference;
}

double CalcPoseMiss(const Arm& arm, const VectorXd& q, const Pose& X_BF) {
  return (CalcFlangePose(arm, q).matrix() - X_BF.matrix()).cwiseAbs().maxCoeff();
}

TEST(ArmInverse, TenThousandPosesThereAndBack) {
  for (const char* id : {"puma560", "pa10"}) {
    const Arm arm = LoadArm(id);
    RandomStream random(id, "there and back");
    int num_found = 0, most = 0;
    double worst = 0.0;
    for (int n = 0; n < 10000; ++n) {
      const VectorXd q = DrawPosture(arm, random);
      const Pose X_BF = CalcFlangePose(arm, q);
      const std::optional<double> free =
          arm.num_joints() == 7 ? std::optional<double>(q[2]) : std::nullopt;
      const ArmPostures found = FindArmPostures(arm, X_BF, 1, free);
      bool is_among = false;
      most = std::max(most, static_cast<int>(found.postures.size()));
      for (const VectorXd& closed : found.postures) {
        const std::optional<VectorXd> exact = RefinePosture(arm, X_BF, closed);
        ASSERT_TRUE(exact) << id << " " << n;
        worst = std::max(worst, CalcPoseMiss(arm, *exact, X_BF));
        is_among = is_among || CalcDifference(*exact, q) < 1e-6;
      }
      num_found += is_among;
    }
    EXPECT_LT(worst, 1e-9) << id;
    EXPECT_EQ(num_found, 10000) << id;
    EXPECT_EQ(most, 8) << id;
  }
}

/** The branches differ by shoulder, elbow and wrist: where all are there, they are 2 x 2 x 2. */
TEST(ArmInverse, PumaHasEightBranches) {
  const Arm arm = LoadArm("puma560");
  const Pose X_BF = CalcFlangePose(arm, arm.ready + VectorXd::Constant(6, 0.1));
  const std::vector<VectorXd> all = FindArmPostures(arm, X_BF, 1).postures;
  ASSERT_EQ(all.size(), 8u);
  for (size_t i = 0; i < all.size(); ++i) {
    EXPECT_LT(CalcPoseMiss(arm, all[i], X_BF), 1e-9);
    for (size_t k = 0; k < i; ++k) EXPECT_GT(CalcDifference(all[i], all[k]), 0.01);
  }
}

TEST(ArmInverse, FreeElbowTurnsAboutShoulderAndWrist) {
  const Arm arm = LoadArm("pa10");
  VectorXd q(7);
  q << 0.0, 0.5, 0.0, 1.6, 0.0, 1.0, 0.0;
  const Pose X_BF = CalcFlangePose(arm, q);
  const std::vector<VectorXd> all = FindArmPostures(arm, X_BF, 24).postures;
  EXPECT_GT(all.size(), 100u);
  const Vector3d p_wrist = X_BF * Vector3d(0.0, 0.0, -0.08);
  for (const VectorXd& found : all) {
    const std::vector<Pose> X_BL = CalcArmPoses(arm, found);
    EXPECT_NEAR((X_BL[3].translation() - Vector3d(0.0, 0.0, 0.315)).norm(), 0.45, 1e-9);
    EXPECT_NEAR((X_BL[3].translation() - p_wrist).norm(), 0.5, 1e-7);
  }
}

TEST(ArmInverse, NamesJointThatIsStretchedAndDistance) {
  const Arm puma = LoadArm("puma560");
  Pose X_BF = MakePose(Vector3d(2.0, 0.0, 0.672));
  const ArmPostures far = FindArmPostures(puma, X_BF, 1);
  EXPECT_TRUE(far.postures.empty());
  EXPECT_EQ(far.fault.joint, 2);
  // The wrist centre is 2 m from joint 1's axis and 56 mm below the shoulder; at most it comes to
  // hypot(0.15005, 0.4318 + hypot(0.0203, 0.4318)).
  const double reach = std::hypot(0.15005, 0.4318 + std::hypot(0.0203, 0.4318));
  EXPECT_NEAR(far.fault.shortfall, std::hypot(2.0, 0.05625) - reach, 1e-9);
  // Too near to the waist's axis: the forearm passes 150 mm beside it.
  X_BF = MakePose(Vector3d(0.05, 0.0, 1.1));
  const ArmPostures near = FindArmPostures(puma, X_BF, 1);
  EXPECT_TRUE(near.postures.empty());
  EXPECT_EQ(near.fault.joint, 0);
  const Arm pa10 = LoadArm("pa10");
  X_BF = MakePose(Vector3d(0.0, 1.5, 0.315 + 0.08));
  const ArmPostures beyond = FindArmPostures(pa10, X_BF, 8);
  EXPECT_EQ(beyond.fault.joint, 3);
  EXPECT_NEAR(beyond.fault.shortfall, 1.5 - 0.95, 1e-9);
}

/** Six joints without a spherical wrist: the UR5's table (Universal Robots). */
Arm MakeUr5() {
  const double rows[6][3] = {{0, 0.089159, 90}, {-0.425, 0, 0},    {-0.39225, 0, 0},
                             {0, 0.10915, 90},  {0, 0.09465, -90}, {0, 0.0823, 0}};
  Arm arm;
  arm.content_hash = "ur5";
  for (const auto& row : rows) {
    ArmJoint joint;
    joint.a = row[0];
    joint.d = row[1];
    joint.alpha = RadFromDeg(row[2]);
    joint.lower = -kPi;
    joint.upper = kPi;
    arm.joints.push_back(joint);
  }
  return arm;
}

TEST(ArmInverse, OtherArmsAreSolvedNumerically) {
  const Arm arm = MakeUr5();
  EXPECT_EQ(FindArmForm(arm), ArmForm::kOther);
  RandomStream random("ur5", "there and back");
  int num_own = 0;
  constexpr int kNumPoses = 50;
  for (int n = 0; n < kNumPoses; ++n) {
    const VectorXd q = DrawPosture(arm, random);
    const Pose X_BF = CalcFlangePose(arm, q);
    const std::vector<VectorXd> all = FindArmPostures(arm, X_BF, 1).postures;
    EXPECT_GE(all.size(), 1u);
    bool is_own = false;
    for (const VectorXd& found : all) {
      EXPECT_LT(CalcPoseMiss(arm, found, X_BF), 1e-9);
      is_own = is_own || CalcDifference(found, q) < 1e-5;
    }
    num_own += is_own;
  }
  EXPECT_GE(num_own, 45);
}

}  // namespace
}  // namespace graspbench
