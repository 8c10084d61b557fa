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

struct DynamicRow {
  double mass;              // 0: not published
  Vector3d p_com, inertia;  // 0: not published
  double rotor, gear;
};

void ExpectDynamics(const Arm& arm, const std::vector<DynamicRow>& rows) {
  const int first = arm.num_joints() - static_cast<int>(rows.size());
  for (int i = first; i < arm.num_joints(); ++i) {
    const ArmJoint& joint = arm.joints[static_cast<size_t>(i)];
    const DynamicRow& row = rows[static_cast<size_t>(i - first)];
    EXPECT_TRUE(row.mass == 0.0 || joint.mass == row.mass) << joint.name;
    EXPECT_LT((joint.p_com - row.p_com).norm(), 1e-12) << joint.name;
    EXPECT_TRUE(row.inertia.isZero() || joint.inertia == row.inertia) << joint.name;
    const double armature = row.rotor * row.gear * row.gear;
    EXPECT_NEAR(joint.armature, armature, 2e-3 * armature) << joint.name;  // three digits
  }
}

/** The tables typed again. PUMA 560: masses, centres and moments of mdl_puma560.m, motors and gears
of mdl_puma560akb.m (Robotics Toolbox); link 1 has no mass there, and frame 6 is the wrist's. PA-10:
Siconos and Choreonoid, joints 2 to 7. */
TEST(Arm, DynamicsArePublishedTables) {
  ExpectDynamics(LoadArm("puma560"),
                 {{0.0, {0, 0, 0}, {0, 0.35, 0}, 291e-6, -62.6111},
                  {17.4, {-0.3638, 0.006, 0.2275}, {0.13, 0.524, 0.539}, 409e-6, 107.815},
                  {4.8, {-0.0203, -0.0141, 0.070}, {0.066, 0.086, 0.0125}, 299e-6, -53.7063},
                  {0.82, {0, 0.019, 0}, {1.8e-3, 1.3e-3, 1.8e-3}, 35e-6, 76.0364},
                  {0.34, {0, 0, 0}, {0.3e-3, 0.4e-3, 0.3e-3}, 35e-6, 71.923},
                  {0.09, {0, 0, 0.032 - 0.05625}, {0.15e-3, 0.15e-3, 0.04e-3}, 35e-6, 76.686}});
  ExpectDynamics(LoadArm("pa10"), {{8.41, {0, 0, 0.06325}, {0, 0, 0}, 3.0e-4, 50},
                                   {3.51, {0, 0.08944, 0}, {0, 0, 0}, 8.5e-5, 50},
                                   {4.31, {0, 0, 0.04609}, {0, 0, 0}, 8.5e-5, 50},
                                   {3.45, {0, 0.1647, 0}, {0, 0, 0}, 2.3e-6, 50},
                                   {1.46, {0, 0, -0.03}, {0, 0, 0}, 2.3e-6, 50},
                                   {0.24, {0, 0, -0.029}, {0, 0, 0}, 2.3e-6, 50}});
}

/** Heights of the centres of mass of the upright arm in Choreonoid's PA10.body. */
TEST(Arm, CentresOfMassOfThePa10LieWhereAnotherModelHasThem) {
  const Arm arm = LoadArm("pa10");
  const std::vector<Pose> X_BL = CalcArmPoses(arm, VectorXd::Zero(7));
  const double heights[] = {0.37675, 0.672141, 0.80959, 1.09875, 1.2335, 1.3145};
  for (size_t i = 1; i < 7; ++i) {
    EXPECT_NEAR((X_BL[i + 1] * arm.joints[i].p_com).z(), heights[i - 1], 0.004) << i;
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

/** Moments that a rigid body can have: those of the PUMA are in part unmeasured and 0. */
Arm LoadArmWithInertias(const char* id) {
  Arm arm = LoadArm(id);
  double size = 0.05;
  for (ArmJoint& joint : arm.joints) {
    joint.inertia = size * Vector3d(1.0, 1.2, 1.4);
    size *= 0.8;
  }
  return arm;
}

/** Poses, speeds, mass matrix, weight and accelerations. */
TEST(Arm, MotionIsThatOfSimbody) {
  for (const char* id : {"puma560", "pa10"}) {
    const Arm arm = LoadArmWithInertias(id);
    const Vector3d gravity_B(1.0, -2.0, -9.0);
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter(system);
    SimTK::MobilizedBody last = matter.Ground();
    for (const ArmJoint& joint : arm.joints) {
      const SimTK::Body::Rigid body(
          MakeMassProperties(joint.mass, joint.p_com, joint.inertia.asDiagonal().toDenseMatrix()));
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
      SimTK::Matrix M;
      matter.calcM(state, M);
      SimTK::Vector_<SimTK::SpatialVec> weights(arm.num_joints() + 1,
                                                SimTK::SpatialVec(SimTK::Vec3(0)));
      for (int i = 0; i < arm.num_joints(); ++i) {
        const SimTK::MobilizedBody& link =
            matter.getMobilizedBody(SimTK::MobilizedBodyIndex(i + 1));
        const SimTK::Vec3 weight = link.getBodyMass(state) * ToSimTK(gravity_B);
        weights[i + 1] = {
            (link.getBodyRotation(state) * link.getBodyMassCenterStation(state)) % weight, weight};
      }
      SimTK::Vector torques;
      matter.multiplyBySystemJacobianTranspose(state, weights, torques);
      const Eigen::MatrixXd own_M = CalcArmMass(arm, X_BL);
      const VectorXd own_torques = CalcArmWeight(arm, X_BL, gravity_B);
      for (int i = 0; i < arm.num_joints(); ++i) {
        EXPECT_NEAR(own_torques[i], torques[i], 1e-10);
        for (int k = 0; k < arm.num_joints(); ++k) {
          const double armature = i == k ? arm.joints[static_cast<size_t>(i)].armature : 0.0;
          EXPECT_NEAR(own_M(i, k), M(i, k) + armature, 1e-10);
        }
      }
      SimTK::Vector_<SimTK::SpatialVec> accelerations;
      matter.calcBodyAccelerationFromUDot(state, SimTK::Vector(arm.num_joints(), 0.0),
                                          accelerations);
      const auto own = CalcArmVelocityTerm(X_BL, u);
      for (int r = 0; r < 3; ++r) {
        EXPECT_NEAR(own[r], accelerations[arm.num_joints()][1][r], 1e-9);
        EXPECT_NEAR(own[3 + r], accelerations[arm.num_joints()][0][r], 1e-9);
      }
    }
  }
}

/** Two links in the plane, l1 and l2, written out: C = J K^-1 J^T. */
TEST(Arm, ComplianceOfTwoLinksIsItsClosedForm) {
  constexpr double kL1 = 0.5, kL2 = 0.4, kK1 = 4000.0, kK2 = 2500.0;
  Arm arm;
  arm.joints.resize(2);
  arm.joints[0].a = kL1;
  arm.joints[0].stiffness = kK1;
  arm.joints[1].a = kL2;
  arm.joints[1].stiffness = kK2;
  for (const double bend : {1.2, 0.0}) {
    const Eigen::Vector2d q(0.3, bend);
    const auto C = CalcArmCompliance(arm, CalcArmJacobian(CalcArmPoses(arm, q)));
    const Eigen::Vector2d elbow = kL1 * Eigen::Vector2d(std::cos(0.3), std::sin(0.3));
    const Eigen::Vector2d fore = kL2 * Eigen::Vector2d(std::cos(0.3 + bend), std::sin(0.3 + bend));
    const auto turn = [](const Eigen::Vector2d& r) { return Eigen::Vector2d(-r.y(), r.x()); };
    const Eigen::Vector2d by_shoulder = turn(elbow + fore), by_elbow = turn(fore);
    const Eigen::Matrix2d expected =
        by_shoulder * by_shoulder.transpose() / kK1 + by_elbow * by_elbow.transpose() / kK2;
    EXPECT_LT((C.topLeftCorner<2, 2>() - expected).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_NEAR(C(5, 5), 1.0 / kK1 + 1.0 / kK2, 1e-15);
    EXPECT_EQ(C.row(2).norm(), 0.0);  // out of the plane
    if (bend == 0.0) {
      EXPECT_LT((C.topLeftCorner<2, 2>() * elbow.normalized()).norm(), 1e-17) << "lost, so stiff";
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
