#include "core/arm/arm.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/arm/arm_inverse.h"
#include "core/arm/load_arm.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/physics/simbody/simtk_conversions.h"
#include "tests/core/arm/draw_posture.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

struct DhRow {
  double a, alpha_deg, d;
};

/** One matrix of the textbook, written out: Spong, Hutchinson and Vidyasagar (2006), (3.10). */
Eigen::Matrix4d MakeDhMatrix(double theta, const DhRow& row) {
  const double alpha = row.alpha_deg * kPi / 180.0;
  Eigen::Matrix4d A;
  A << std::cos(theta), -std::sin(theta) * std::cos(alpha), std::sin(theta) * std::sin(alpha),
      row.a * std::cos(theta), std::sin(theta), std::cos(theta) * std::cos(alpha),
      -std::cos(theta) * std::sin(alpha), row.a * std::sin(theta), 0.0, std::sin(alpha),
      std::cos(alpha), row.d, 0.0, 0.0, 0.0, 1.0;
  return A;
}

// The published tables, typed again; the first d and the PUMA's last are those of arm.yaml.
const std::vector<DhRow> kPuma = {{0, 90, 0.672},  {0.4318, 0, 0}, {0.0203, -90, 0.15005},
                                  {0, 90, 0.4318}, {0, -90, 0},    {0, 0, 0.05625}};
const std::vector<DhRow> kPa10 = {{0, -90, 0.315}, {0, 90, 0}, {0, -90, 0.45}, {0, 90, 0},
                                  {0, -90, 0.5},   {0, 90, 0}, {0, 0, 0.08}};

TEST(Arm, ForwardKinematicsArePublishedTables) {
  for (const auto& [id, table] : {std::pair("puma560", kPuma), std::pair("pa10", kPa10)}) {
    const Arm arm = LoadArm(id);
    RandomStream random(id, "tables");
    for (int n = 0; n < 1000; ++n) {
      const VectorXd q = DrawPosture(arm, random);
      Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
      for (size_t i = 0; i < table.size(); ++i) {
        expected = expected * MakeDhMatrix(q[static_cast<Eigen::Index>(i)], table[i]);
      }
      EXPECT_LT((CalcFlangePose(arm, q).matrix() - expected).cwiseAbs().maxCoeff(), 1e-12) << id;
    }
  }
}

/** By hand: the PUMA's upper arm along x, the forearm up, the flange up. */
TEST(Arm, PumaStandsAsDrawnAtZero) {
  const Pose X_BF = CalcFlangePose(LoadArm("puma560"), VectorXd::Zero(6));
  EXPECT_LT(
      (X_BF.translation() - Vector3d(0.4318 + 0.0203, -0.15005, 0.672 + 0.4318 + 0.05625)).norm(),
      1e-12);
  EXPECT_LT((X_BF.linear().col(2) - Vector3d::UnitZ()).norm(), 1e-12);
}

/** By hand: the PA-10 stands straight up at zero. */
TEST(Arm, Pa10StandsUpAtZero) {
  const Pose X_BF = CalcFlangePose(LoadArm("pa10"), VectorXd::Zero(7));
  EXPECT_LT((X_BF.translation() - Vector3d(0.0, 0.0, 1.345)).norm(), 1e-12);
  EXPECT_LT((X_BF.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
}

TEST(Arm, PosesAndJacobianAreThoseOfSimbody) {
  for (const char* id : {"puma560", "pa10"}) {
    const Arm arm = LoadArm(id);
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter(system);
    SimTK::MobilizedBody last = matter.Ground();
    for (const ArmJoint& joint : arm.joints) {
      const SimTK::Body::Rigid body(
          SimTK::MassProperties(1.0, SimTK::Vec3(0), SimTK::Inertia(1.0)));
      // Simbody turns about z of the frame in the parent; the link's own frame lies behind it.
      const SimTK::Transform outboard(SimTK::Rotation(joint.alpha, SimTK::XAxis),
                                      SimTK::Vec3(joint.a, 0.0, joint.d));
      last = SimTK::MobilizedBody::Pin(
          last, SimTK::Transform(SimTK::Rotation(joint.offset, SimTK::ZAxis)), body, ~outboard);
    }
    SimTK::State state = system.realizeTopology();
    RandomStream random(id, "Simbody");
    for (int n = 0; n < 200; ++n) {
      const VectorXd q = DrawPosture(arm, random), u = DrawPosture(arm, random);
      for (int i = 0; i < arm.num_joints(); ++i) {
        state.updQ()[i] = q[i];
        state.updU()[i] = u[i];
      }
      system.realize(state, SimTK::Stage::Velocity);
      const SimTK::Transform& X_GF = last.getBodyTransform(state);
      const std::vector<Pose> X_BL = CalcArmPoses(arm, q);
      const Eigen::MatrixXd jacobian = CalcArmJacobian(X_BL);
      const VectorXd v = jacobian * u;
      for (int r = 0; r < 3; ++r) {
        EXPECT_NEAR(X_BL.back().translation()[r], X_GF.p()[r], 1e-12);
        EXPECT_NEAR(v[r], last.getBodyOriginVelocity(state)[r], 1e-10);
        EXPECT_NEAR(v[3 + r], last.getBodyAngularVelocity(state)[r], 1e-10);
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(X_BL.back().linear()(r, c), X_GF.R()[r][c], 1e-12);
        }
      }
    }
  }
}

/** At a straight elbow the flange cannot move along the arm. */
TEST(Arm, StraightArmIsSingular) {
  const Arm arm = LoadArm("pa10");
  VectorXd q = VectorXd::Zero(7);
  q[1] = 0.5;
  EXPECT_LT(CalcDexterity(arm, CalcArmJacobian(CalcArmPoses(arm, q))), 1e-6);
  EXPECT_GT(CalcDexterity(arm, CalcArmJacobian(CalcArmPoses(arm, arm.ready))), 0.1);
}

}  // namespace
}  // namespace graspbench
