#include "core/trial/protocols/free_space.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kForce = 1.0;       // of each finger [N]
constexpr double kHalfWidth = 0.03;  // of the block, along x [m]
constexpr double kMass = 0.1;
constexpr double kStiffness = 20.0;  // of the drives [N m/rad]

/** Two balls on the block's +x and -x sides (small_scenes.h), pressed by drives that are springs:
where the block has not moved, each presses with kForce after the squeeze. */
struct Pinch {
  FreeSpaceProfile profile;
  Hand hand = MakeSqueezeHand(2, kHalfWidth, kForce, 0.0);
  GraspObject object = MakeBlock(kMass);
  std::vector<ScriptedStage> stages;

  Pinch() {
    SoftenFingers();
    profile.drives.law = "own";
    profile.surfaces.pads = "given";
    profile.surfaces.torsion_radius = 0.01;
    profile.drives.beyond_limits = "ignore";
    profile.mass = kMass;
    profile.sim.gravity = 0.0;
    profile.sim.step = 0.002;
    // Else the pads' own compliance turns the block before the force along it is resisted.
    profile.max_turn_deg = 60.0;
    const Pose X_OH = MakePose(Vector3d(0.0, 0.0, kSqueezeLever));
    // Drive and contact are springs in series.
    const double squeeze = kForce * (kSqueezeLever / kStiffness +
                                     1.0 / (kSqueezeLever * profile.sim.contact_stiffness));
    const std::vector<std::pair<const char*, double>> angles = {
        {"pregrasp", 0.0}, {"grasp", 0.5 * squeeze}, {"squeeze", squeeze}};
    for (const auto& [name, q] : angles) {
      stages.push_back({name, X_OH, VectorXd::Constant(2, q)});
    }
  }

  /** And the root lighter, so that the arm can move it. */
  void SoftenFingers() {
    for (HandJoint& joint : hand.joints) joint.drive = {kStiffness, 0.2, 10.0};
    hand.links[0].mass = 1.0;
    hand.links[0].I_LLcm = 1e-3 * Eigen::Matrix3d::Identity();
  }

  ProfiledScene MakeScene(const Pose& X_WO = Pose::Identity()) const {
    const std::vector<bool> is_asked(hand.joints.size(), true);
    return MakeProfiledScene(MakeProfiledHand(hand, profile, is_asked),
                             MakeProfiledObject(object, profile), X_WO, stages, profile);
  }
  FreeSpaceResult Run() const { return RunFreeSpace(MakeScene(), profile); }
};

// Across the fingers two contacts stand 2 mu N; along them the drives stand more.
TEST(FreeSpace, HoldsWhatTwoContactsCanHold) {
  for (const double step : {0.002, 0.0005}) {
    Pinch pinch;
    pinch.profile.sim.step = step;
    pinch.profile.surfaces.friction = 0.4;
    const double most = 2.0 * 0.4 * kForce / kMass;  // [m/s^2]
    pinch.profile.acceleration = 0.95 * most;
    const FreeSpaceResult below = pinch.Run();
    EXPECT_TRUE(below.passed) << below.reason;
    EXPECT_EQ(below.num_stood, 6);
    EXPECT_NEAR(below.grip_force, 2.0 * kForce, 0.02 * kForce);
    EXPECT_GT(below.epsilon, 0.0) << "two soft pads close";
    pinch.profile.acceleration = 1.05 * most;
    const FreeSpaceResult above = pinch.Run();
    EXPECT_FALSE(above.passed);
    EXPECT_EQ(above.failed_stage, "push -y") << above.reason;
    EXPECT_EQ(above.num_stood, 2) << "the pushes along the fingers";
  }
}

TEST(FreeSpace, AFingerAlonePushesTheObjectAway) {
  Pinch pinch;
  pinch.hand = MakeSqueezeHand(1, kHalfWidth, kForce, 0.0);
  pinch.SoftenFingers();
  pinch.stages.resize(1);
  pinch.stages.push_back({"squeeze", pinch.stages[0].X_OH, VectorXd::Constant(1, 0.5)});
  pinch.stages[0].q = VectorXd::Zero(1);
  const FreeSpaceResult result = pinch.Run();
  EXPECT_FALSE(result.passed);
  EXPECT_EQ(result.failed_stage, "squeeze") << result.reason;
  EXPECT_GT(result.closing_shift, pinch.profile.max_shift);
}

TEST(FreeSpace, StartPenetrationIsAResult) {
  Pinch pinch;
  for (ScriptedStage& stage : pinch.stages) stage.X_OH.translation().x() = 0.012;
  const FreeSpaceResult result = pinch.Run();
  EXPECT_EQ(result.failed_stage, "start") << result.reason;
  EXPECT_NEAR(result.start_penetration, 0.012, 5e-4);
  pinch.profile.max_start_penetration = 0.02;
  EXPECT_NE(pinch.Run().failed_stage, "start");
}

TEST(FreeSpace, AHandThatMissesTheObjectFailsWhereItShouldHoldIt) {
  Pinch pinch;
  for (ScriptedStage& stage : pinch.stages) stage.X_OH = MakePose(Vector3d(0.0, 0.0, 10.0));
  const FreeSpaceResult result = pinch.Run();
  EXPECT_FALSE(result.passed);
  EXPECT_EQ(result.failed_stage, "squeeze");
  EXPECT_EQ(result.epsilon, 0.0);
  EXPECT_NE(result.reason.find("nothing touched it"), std::string::npos) << result.reason;
}

TEST(FreeSpace, OpeningAfterTheGraspLetsGo) {
  Pinch pinch;
  pinch.stages[2].q.setConstant(-0.3);
  const FreeSpaceResult result = pinch.Run();
  EXPECT_FALSE(result.passed);
  EXPECT_EQ(result.touching, "");
  EXPECT_EQ(result.failed_stage, "squeeze") << result.reason;
}

// The root turns and moves with the stages, and carries what it holds.
TEST(FreeSpace, TheRootTurnsBetweenStages) {
  for (const int updates : {0, 10}) {
    Pinch pinch;
    pinch.profile.stage_updates = updates;
    pinch.profile.max_shift = 0.2;
    pinch.profile.acceleration = 1.0;
    pinch.profile.surfaces.friction = 0.8;
    const double turn = RadFromDeg(12.0);
    ScriptedStage turned = pinch.stages.back();
    turned.name = "turn";
    turned.X_OH = MakePose(Vector3d(0.02, 0.0, 0.0)) *
                  Pose(Eigen::AngleAxisd(turn, Vector3d::UnitX())) * turned.X_OH;
    pinch.stages.push_back(turned);
    const FreeSpaceResult result = pinch.Run();
    EXPECT_TRUE(result.passed) << result.reason;
    EXPECT_NEAR(result.closing_turn_deg, 12.0, updates == 0 ? 0.1 : 0.7) << updates;
    EXPECT_NEAR(result.closing_shift, 0.02, 2e-3) << updates;
  }
}

TEST(FreeSpace, LiftsFromATable) {
  Pinch pinch;
  pinch.profile.test = "lift";
  pinch.profile.acceleration = 10.0;
  pinch.profile.test_time = pinch.profile.check_interval = 0.4;
  pinch.profile.surfaces.friction = 0.8;  // 1.6 N above a weight of 1 N
  double height = 0.01;
  const auto run = [&] {
    return RunFreeSpace(pinch.MakeScene(MakePose(Vector3d(0.0, 0.0, height))), pinch.profile);
  };
  const FreeSpaceResult held = run();
  EXPECT_TRUE(held.passed) << held.reason;
  EXPECT_LT(held.worst_shift, 0.01);
  // Closed beyond the last stage, it stays closed while it rises.
  const Pinch stated = pinch;
  for (HandJoint& joint : pinch.hand.joints) {
    joint.lower = 0.0;
    joint.upper = pinch.stages.back().q[0];
  }
  pinch.hand.digits = {{"TH", "thumb", true, {1}, 1}, {"FF", "index", false, {2}, 2}};
  pinch.stages.resize(1);
  pinch.profile.closing.to = "limits";
  const FreeSpaceResult closed = run();
  EXPECT_TRUE(closed.passed) << closed.reason;
  pinch = stated;
  pinch.profile.surfaces.friction = 0.3;  // 0.6 N
  const FreeSpaceResult lost = run();
  EXPECT_EQ(lost.failed_stage, "lift") << lost.reason;
  EXPECT_NEAR(lost.worst_shift, pinch.profile.lift_height, 0.01) << "it stayed where it was";
  height = -0.005;
  const FreeSpaceResult sunk = run();
  EXPECT_EQ(sunk.failed_stage, "start") << "the table would throw it out";
  EXPECT_NE(sunk.reason.find("15.0 mm deep in the table"), std::string::npos) << sunk.reason;
}

TEST(FreeSpace, RefusesBeyondLimitsOnlyWhereTheProfileSaysSo) {
  Pinch pinch;
  pinch.hand.joints[0].upper = 0.001;
  pinch.profile.drives.beyond_limits = "refuse";
  const FreeSpaceResult result = pinch.Run();
  EXPECT_EQ(result.failed_stage, "limits");
  EXPECT_EQ(result.num_beyond_limits, 1);
  EXPECT_NE(result.reason.find(pinch.hand.joints[0].name), std::string::npos) << result.reason;
  for (const char* rule : {"clip", "ignore"}) {
    pinch.profile.drives.beyond_limits = rule;
    const FreeSpaceResult other = pinch.Run();
    EXPECT_NE(other.failed_stage, "limits");
    EXPECT_EQ(other.num_beyond_limits, 1) << "counted, whatever the rule";
  }
}

// Friction alone holds across the fingers, and two contacts stand 2 mu N.
TEST(FreeSpace, TheBreakingLoadIsWhatTwoContactsCanHold) {
  Pinch pinch;
  pinch.profile.finds_breaking_load = true;
  pinch.profile.surfaces.friction = 0.4;
  const double most = 2.0 * 0.4 * kForce;  // [N]
  for (const double over : {0.5, 3.0}) {   // whether or not it stands the profile's own push
    pinch.profile.acceleration = over * most / kMass;
    const FreeSpaceResult result = pinch.Run();
    EXPECT_EQ(result.passed, over < 1.0) << result.reason;
    EXPECT_GT(result.breaking_load, 0.9 * most) << over;
    EXPECT_LT(result.breaking_load, 1.02 * most) << over;
    EXPECT_TRUE(result.breaks_along.find_first_of("yz") != std::string::npos)
        << result.breaks_along;
  }
  pinch.profile.acceleration = most / kMass / 100.0;
  const FreeSpaceResult light = pinch.Run();
  EXPECT_EQ(light.breaks_along, "") << "16 times so little breaks nothing";
  EXPECT_NEAR(light.breaking_load, 0.16 * most, 1e-12);
}

TEST(FreeSpace, AFallIsOnePushOutOfThePalm) {
  Pinch pinch;
  pinch.profile.test = "fall";
  pinch.profile.surfaces.friction = 0.4;
  const double most = 2.0 * 0.4 * kForce / kMass;
  for (const Vector3d& normal : {Vector3d(0.0, -1.0, 0.0), Vector3d(0.0, 0.0, -1.0)}) {
    pinch.hand.palm_normal = normal;
    pinch.profile.acceleration = 0.95 * most;
    const FreeSpaceResult below = pinch.Run();
    EXPECT_TRUE(below.passed) << below.reason;
    EXPECT_EQ(below.num_stood, 1);
    pinch.profile.acceleration = 1.05 * most;
    EXPECT_EQ(pinch.Run().failed_stage, "fall");
  }
  pinch.hand.palm_normal = Vector3d::UnitX();  // against a finger
  EXPECT_TRUE(pinch.Run().passed);
}

TEST(FreeSpace, AnObjectThatNothingTouchesFails) {
  Pinch pinch;
  pinch.hand = MakeBareHand();
  pinch.stages = {{"grasp", MakePose(Vector3d(0.0, 0.0, 10.0)), VectorXd()}};
  pinch.profile.acceleration = 2.0;
  pinch.profile.test_time = pinch.profile.check_interval = 0.2;
  const FreeSpaceResult alone = pinch.Run();
  EXPECT_FALSE(alone.passed) << "40 mm are within the limits, but of a free object";
  EXPECT_EQ(alone.failed_stage, "grasp");
  EXPECT_EQ(alone.num_stood, 6);
  EXPECT_NEAR(alone.worst_shift, 0.5 * 2.0 * 0.2 * 0.2, 1e-3) << "it flies with the push";
  EXPECT_EQ(alone.closing_shift, 0.0) << "without a push it rests";
  pinch.profile.must_touch = true;
  const FreeSpaceResult result = pinch.Run();
  EXPECT_EQ(result.failed_stage, "push -x");
  EXPECT_NE(result.reason.find("nothing touches"), std::string::npos) << result.reason;
  EXPECT_TRUE([] {
    Pinch held;
    held.profile.must_touch = true;
    return held.Run().passed;
  }());
}

// One finger is nearer: free, it pushes the object; held, the object waits for the other.
TEST(FreeSpace, AHeldObjectWaitsForTheSecondFinger) {
  Pinch pinch;
  for (ScriptedStage& stage : pinch.stages) stage.X_OH.translation().x() = 0.004;
  pinch.stages[0].q.setConstant(-0.1);  // 10 mm off
  pinch.stages.resize(1);
  pinch.stages.push_back(pinch.stages.front());
  pinch.profile.closing.to = "limits";
  for (HandJoint& joint : pinch.hand.joints) {
    joint.lower = -0.1;
    joint.upper = 0.5;
  }
  pinch.hand.digits = {{"TH", "thumb", true, {1}, 1}, {"FF", "index", false, {2}, 2}};
  pinch.profile.closing.object_is_held = true;
  pinch.profile.acceleration = 1.0;
  const FreeSpaceResult held = pinch.Run();
  EXPECT_TRUE(held.passed) << held.reason;
  EXPECT_LT(held.closing_shift, 1e-9);
  EXPECT_EQ(held.touching, "TH FF");
  pinch.profile.closing.object_is_held = false;
  EXPECT_GT(pinch.Run().closing_shift, 0.002);
  pinch.profile.closing.object_is_held = true;
  for (ScriptedStage& stage : pinch.stages) stage.X_OH.translation().x() = 0.2;
  const FreeSpaceResult missed = pinch.Run();
  EXPECT_FALSE(missed.passed);
  EXPECT_NE(missed.reason.find("where two of"), std::string::npos) << missed.reason;
}

// A table says how far joints close, which way the object falls, and what must touch before.
TEST(FreeSpace, ATableOfTheGripperDecidesHowItClosesAndWhereTheObjectFalls) {
  Pinch pinch;
  const double squeeze = pinch.stages.back().q[0];
  for (HandJoint& joint : pinch.hand.joints) {
    joint.lower = -0.1;
    joint.upper = squeeze;  // presses with kForce
  }
  pinch.stages.resize(1);
  pinch.profile.closing.to = "limits";
  pinch.profile.closing.object_is_held = true;
  pinch.profile.test = "fall";
  pinch.profile.surfaces.friction = 0.4;
  pinch.profile.acceleration = 1.1 * 2.0 * 0.4 * kForce / kMass;  // more than friction stands
  ProfiledScene scene = pinch.MakeScene();
  scene.table = ClosingTable{Eigen::Vector2d(0.5, -1.0), Vector3d::UnitY(), {false, true, true}, 2};
  EXPECT_TRUE(
      CalcClosingCommand(scene, pinch.profile).isApprox(Eigen::Vector2d(squeeze / 2, -0.1)));
  scene.table->shares.setOnes();
  const FreeSpaceResult across = RunFreeSpace(scene, pinch.profile);
  EXPECT_FALSE(across.passed);
  EXPECT_EQ(across.failed_stage, "fall") << across.reason;
  scene.table->down_H = Vector3d::UnitX();  // against a finger
  const FreeSpaceResult along = RunFreeSpace(scene, pinch.profile);
  EXPECT_TRUE(along.passed) << along.reason;
  scene.table->counts[1] = false;  // the other finger alone is not enough
  const FreeSpaceResult missed = RunFreeSpace(scene, pinch.profile);
  EXPECT_NE(missed.reason.find("where 2 links must"), std::string::npos) << missed.reason;
}

// A hand with a longer chain than the solver holds is a result.
TEST(FreeSpace, AChainOfTooManyJointsIsAResult) {
  Pinch pinch;
  constexpr int kNumJoints = ContactPoint::kMaxChain + 1;
  pinch.hand = MakeBareHand();
  for (int i = 0; i < kNumJoints; ++i) {
    AddRodLink(pinch.hand, i, Pose::Identity(), Vector3d::UnitX(), 0.01, 0.02);
  }
  pinch.stages = {{"grasp", Pose::Identity(), VectorXd::Zero(kNumJoints)}};
  const FreeSpaceResult result = pinch.Run();
  EXPECT_TRUE(result.is_numerical);
  EXPECT_NE(result.reason.find("at most"), std::string::npos) << result.reason;
}

TEST(FreeSpace, TheTraceHasTheStartAndEveryPhase) {
  const Pinch pinch;
  const TracedFreeSpace traced = TraceFreeSpace(pinch.MakeScene(), pinch.profile, 0.02);
  EXPECT_EQ(FormatJson(RecordToJson(traced.result)), FormatJson(RecordToJson(pinch.Run())));
  const std::vector<const TraceInstant*> ends = ListPhaseEnds(traced.trace);
  ASSERT_EQ(ends.size(), 3u);
  EXPECT_EQ(traced.trace.front().time, 0.0);
  EXPECT_EQ(ends[0]->phase, Phase::kPlacing);
  EXPECT_EQ(ends[0]->next_phase, Phase::kClosure);
  EXPECT_EQ(ends[1]->next_phase, Phase::kHold);
  EXPECT_EQ(ends[2]->phase, Phase::kHold);
  for (size_t i = 1; i < traced.trace.size(); ++i) {
    EXPECT_GT(traced.trace[i].time, traced.trace[i - 1].time);
    EXPECT_LT(traced.trace[i].time, traced.trace[i - 1].time + 0.0205);
  }
}

TEST(FreeSpace, GivesTheSameBytesAgain) {
  const Pinch pinch;
  EXPECT_EQ(FormatJson(RecordToJson(pinch.Run())), FormatJson(RecordToJson(pinch.Run())));
}

}  // namespace
}  // namespace graspbench
