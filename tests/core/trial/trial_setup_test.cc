#include "core/trial/trial_setup.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/arm/load_arm.h"
#include "core/arm/mounted_arm.h"
#include "core/base/units.h"
#include "core/physics/implicit_world.h"
#include "core/physics/simbody/compliant_world.h"
#include "core/trial/measures/diagnosis_text.h"
#include "core/trial/protocols/table_lift.h"
#include "core/trial/trial_trace.h"
#include "objects/catalogue.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

TrialSetup MakeTrial() { return MakeSetup("tum-evolved", "g1", LoadObject("remote_control")); }

Pose FindRelativePose(const SceneSnapshot& snapshot) {
  return snapshot.X_WH.inverse() * snapshot.X_WO;
}

// Who knows the object's place exactly meets it as if it lay where it should: the whole trial is
// moved over the table.
TEST(Positioning, TrueMeetsTheObjectAsWithoutOffset) {
  TrialSetup setup = MakeTrial();
  const TrialResult centred = RunSetup(setup);
  ASSERT_EQ(centred.outcome, Outcome::kSuccess) << centred.reason;
  EXPECT_TRUE(std::isnan(centred.believed_x));
  EXPECT_FALSE(ToJson(centred).contains("believed_x_m"));

  setup.draw.offset_x = 0.03;
  setup.draw.offset_y = -0.02;
  setup.draw.offset_yaw = 0.6;
  setup.positioning = Positioning::kTrue;
  const TrialResult moved = RunSetup(setup);
  EXPECT_EQ(moved.outcome, Outcome::kSuccess) << moved.reason;
  EXPECT_EQ(moved.believed_x, 0.03);
  EXPECT_EQ(moved.believed_yaw, 0.6);
  ASSERT_EQ(moved.snapshots.size(), centred.snapshots.size());
  const Pose difference =
      FindRelativePose(centred.snapshots[0]).inverse() * FindRelativePose(moved.snapshots[0]);
  EXPECT_LT(difference.translation().norm(), 1e-4);
  EXPECT_LT(Eigen::AngleAxisd(difference.linear()).angle(), 1e-3);
  EXPECT_NEAR(moved.timing.gct, centred.timing.gct, 0.01);

  setup.positioning = Positioning::kNominal;
  EXPECT_NE(RunSetup(setup).outcome, Outcome::kSuccess);
}

TEST(Positioning, TheCameraFindsTheObject) {
  TrialSetup setup = MakeTrial();
  setup.draw.offset_x = 0.03;
  setup.draw.offset_y = -0.02;
  setup.draw.offset_yaw = 0.6;
  setup.positioning = Positioning::kCamera;
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(result.outcome, Outcome::kSuccess) << result.reason;
  EXPECT_NEAR(result.believed_x, 0.03, 0.001);
  EXPECT_NEAR(result.believed_y, -0.02, 0.001);
  EXPECT_NEAR(result.believed_yaw, 0.6, RadFromDeg(1.0));
  ExpectSurvivesItsRecord(result);
  // The same again, by a course that makes its own camera.
  EXPECT_EQ(ToJson(TableLift(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim),
                             setup)
                       .Run()),
            ToJson(result));
}

TEST(Positioning, WhatIsNotSeenIsAResultWithItsReason) {
  TrialSetup setup = MakeTrial();
  setup.draw.offset_x = 0.2;
  setup.positioning = Positioning::kCamera;
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(result.outcome, Outcome::kNotSeen);
  EXPECT_EQ(result.reason, "what is seen reaches over the picture's edge");
  EXPECT_EQ(result.num_steps, 0);
  EXPECT_TRUE(std::isnan(result.believed_x));
  ExpectSurvivesItsRecord(result);
}

TrialSetup MakeTrialWithArm(const Arm& arm) {
  TrialSetup setup = MakeTrial();
  setup.arm = std::make_shared<const MountedArm>(
      MountArm(ArmConfig(), std::make_shared<const Arm>(arm), *setup.hand));
  return setup;
}

/** Without an arm the record is as before; with it the hand gives way, the more the softer. */
TEST(TrialWithArm, HandYieldsAsTheJointsDo) {
  const TrialResult alone = RunSetup(MakeTrial());
  EXPECT_FALSE(ToJson(alone).contains("arm"));
  for (const char* id : {"puma560", "pa10"}) {
    Arm arm = LoadArm(id);
    const TrialResult carried = RunSetup(MakeTrialWithArm(arm));
    EXPECT_EQ(carried.outcome, alone.outcome) << id << ": " << carried.reason;
    ASSERT_TRUE(carried.arm) << id;
    EXPECT_GT(carried.arm->margin, 0.0);
    EXPECT_GT(carried.arm->reach_time, 0.0);
    EXPECT_EQ(carried.arm->q.size(), arm.num_joints());
    EXPECT_GT(carried.arm->deflection, 1e-6);
    EXPECT_LT(carried.arm->deflection, 2e-3);
    EXPECT_GT(carried.arm->deflection_angle, 0.0);
    EXPECT_GT(carried.arm->torque_share, 0.0);
    EXPECT_LT(carried.arm->torque_share, 1.0);
    EXPECT_FALSE(carried.arm->torque_joint.empty());
    ExpectSurvivesItsRecord(carried);
    for (ArmJoint& joint : arm.joints) joint.stiffness *= 0.2;
    const TrialResult soft = RunSetup(MakeTrialWithArm(arm));
    EXPECT_GT(soft.arm->deflection, 2.0 * carried.arm->deflection) << id;
  }
}

/** Joints go straight from the ready posture to the pre-grasp, half way at half the time; the hand
goes with them, from its joints at 0 to its pre-grasp posture, and the object stays. */
TEST(TrialWithArm, GrossMotionIsSimulated) {
  for (const char* id : {"puma560", "pa10"}) {
    const Arm arm = LoadArm(id);
    const TrialSetup setup = MakeTrialWithArm(arm);
    TrialRunner runner(setup.hand, setup.object);
    const TracedTrial traced = TraceTrial(runner, setup, 0.01);
    ASSERT_TRUE(traced.result.arm) << id;
    const double time = traced.result.arm->reach_time;
    const TraceInstant& first = traced.trace.front();
    EXPECT_EQ(first.phase, Phase::kPreGrasp);
    EXPECT_EQ(first.q_arm, arm.ready);
    EXPECT_TRUE(first.q.isZero());
    const TraceInstant& last = *ListPhaseEnds(traced.trace).front();
    EXPECT_EQ(last.phase, Phase::kPreGrasp);
    EXPECT_NEAR(last.time, time, 0.02);
    EXPECT_LT((last.q_asked - setup.grasp.q_pre).norm(), 1e-9) << id;  // fingers sag below it
    const TraceInstant& middle = FindInstant(traced.trace, 0.5 * time);
    const double x = middle.time / time;
    const double share = x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
    const Eigen::VectorXd turn = last.q_arm - arm.ready;
    EXPECT_LT((middle.q_arm - arm.ready - share * turn).cwiseAbs().maxCoeff(), 1e-3) << id;
    double path = 0.0;
    for (size_t k = 1; traced.trace[k].phase == Phase::kPreGrasp; ++k) {
      const TraceInstant &before = traced.trace[k - 1], &now = traced.trace[k];
      path += (now.X_WH.translation() - before.X_WH.translation()).norm();
      for (int i = 0; i < arm.num_joints(); ++i) {
        EXPECT_LE(std::abs(now.q_arm[i] - before.q_arm[i]),
                  1.01 * arm.joints[static_cast<size_t>(i)].speed * (now.time - before.time));
      }
      EXPECT_LT((now.X_WO.translation() - first.X_WO.translation()).norm(), 1e-4);
      EXPECT_TRUE(now.contacts.empty());
    }
    EXPECT_NEAR(path, traced.result.arm->reach_path, 0.01 * path) << id;
    ASSERT_FALSE(traced.result.phases.empty());
    EXPECT_EQ(traced.result.phases.front().name, NameOf(Phase::kPlacing));
    EXPECT_NEAR(traced.result.phases.front().time + traced.closure_start, last.time, 1e-9);
    EXPECT_NEAR(traced.closure_start - last.time, setup.strategy.placing_time, 0.021);
  }
}

/** The shoulder can give a little less than the trial needs. */
TEST(TrialWithArm, JointAtItsLimitIsNamed) {
  Arm arm = LoadArm("puma560");
  const TrialResult needed = RunSetup(MakeTrialWithArm(arm));
  ASSERT_EQ(needed.arm->torque_joint, "shoulder");
  arm.joints[1].torque *= 0.999 * needed.arm->torque_share;
  const TrialResult result = RunSetup(MakeTrialWithArm(arm));
  EXPECT_EQ(result.outcome, Outcome::kArmOverloaded);
  EXPECT_EQ(result.reason.find("joint \"shoulder\" of the arm is at its limit of "), 0U)
      << result.reason;
  EXPECT_EQ(result.arm->torque_joint, "shoulder");
  EXPECT_NEAR(result.arm->torque_share, 1.0, 1e-9);
  ASSERT_TRUE(result.diagnosis);
  EXPECT_EQ(result.diagnosis->mechanism, Mechanism::kArmAtLimit);
  EXPECT_EQ(DescribeDiagnosis(result).find("The arm gave way at the limit of joint shoulder, at"),
            0U)
      << DescribeDiagnosis(result);
  ExpectSurvivesItsRecord(result);
}

TEST(TrialWithArm, WhatIsOutOfReachEndsAtOnceWithItsJoint) {
  TrialSetup setup = MakeTrial();
  ArmConfig config;
  config.x = -1.5;
  setup.arm = std::make_shared<const MountedArm>(
      MountArm(config, std::make_shared<const Arm>(LoadArm("puma560")), *setup.hand));
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(result.outcome, Outcome::kArmOutOfReach);
  EXPECT_NE(result.reason.find("joint 3 (elbow) cannot go farther"), std::string::npos)
      << result.reason;
  EXPECT_EQ(result.num_steps, 0);
  ASSERT_TRUE(result.arm);
  EXPECT_EQ(result.arm->joint, "elbow");
  EXPECT_EQ(result.arm->q.size(), 0);
  EXPECT_FALSE(result.diagnosis);
  ExpectSurvivesItsRecord(result);
}

TEST(CompliantTrial, TakesBalls) {
  EXPECT_TRUE(CanMoveCompliantly(*LoadObject("golf_ball")));
  EXPECT_TRUE(CanMoveCompliantly(*LoadObject("tennis_ball")));
  EXPECT_FALSE(CanMoveCompliantly(*LoadObject("toy_cube")));
  EXPECT_FALSE(CanMoveCompliantly(*LoadObject("can")));
}

TEST(CompliantTrial, TouchesAndGripsAsOurOwnWorldDoes) {
  TrialSetup setup = MakeSetup("tum-evolved", "g1", LoadObject("golf_ball"));
  const TrialResult ours = RunSetup(setup);
  setup.is_compliant = true;
  const TrialResult theirs = RunSetup(setup);
  EXPECT_EQ(theirs.outcome, ours.outcome) << theirs.reason;
  EXPECT_NEAR(theirs.timing.gct, ours.timing.gct, 0.01);
  EXPECT_NEAR(theirs.timing.gft, ours.timing.gft, 0.01);
  EXPECT_NEAR(theirs.grip_force, ours.grip_force, 0.05 * ours.grip_force);
}

}  // namespace
}  // namespace graspbench
