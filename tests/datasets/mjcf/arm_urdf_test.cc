#include "datasets/mjcf/arm_urdf.h"

#include <gtest/gtest.h>

#include <map>

#include "core/arm/load_arm.h"
#include "core/base/files/files.h"
#include "core/base/random.h"
#include "core/hand/load_hand.h"
#include "core/hand/read_urdf.h"
#include "tests/core/arm/draw_posture.h"

namespace graspbench {
namespace {

using Eigen::VectorXd;

struct WrittenRobot {
  MountedArm mounted;
  Hand hand;
  Urdf urdf;
};

WrittenRobot Write(Arm arm, const char* hand, const std::string& mount = "z") {
  WrittenRobot made;
  made.hand = LoadHand(hand);
  ArmConfig config;
  config.y = 0.2;
  config.yaw = 0.7;
  config.mount = mount;
  made.mounted = MountArm(config, std::make_shared<const Arm>(std::move(arm)), made.hand);
  Diagnostics problems;
  made.urdf =
      ReadUrdf(FormatArmUrdf(made.mounted, made.hand, ReadFile(made.hand.folder + "/hand.urdf")),
               "robot.urdf", made.hand.folder, problems);
  EXPECT_EQ(problems.num_errors(), 0) << problems.Format();
  return made;
}

/** X_WL of every link, by name; the joints that `q` does not name are at 0. */
std::map<std::string, Pose> CalcPoses(const Urdf& urdf, const std::map<std::string, double>& q) {
  std::map<std::string, Pose> poses = {{"world", Pose::Identity()}};
  for (size_t placed = 0; placed != poses.size();) {
    placed = poses.size();
    for (const UrdfJoint& joint : urdf.joints) {
      const auto parent = poses.find(urdf.links[joint.parent].name);
      if (parent == poses.end()) continue;
      Pose X_PL = joint.X_PJ;
      const auto angle = q.find(joint.name);
      if (angle != q.end()) X_PL.rotate(Eigen::AngleAxisd(angle->second, joint.axis));
      poses.emplace(urdf.links[joint.child].name, parent->second * X_PL);
    }
  }
  return poses;
}

TEST(ArmUrdf, PosesAreThoseOfArmAndHand) {
  Arm turned = LoadArm("puma560");
  turned.joints[2].offset = 0.4;
  for (const auto& [arm, hand, mount] : {std::tuple(LoadArm("puma560"), "tum", "z"),
                                         {LoadArm("pa10"), "shadow", "z"},
                                         {turned, "tum", "-y"}}) {
    const WrittenRobot made = Write(arm, hand, mount);
    RandomStream random(hand, mount);
    const std::vector<Pose> X_HL = CalcLinkPoses(made.hand, VectorXd::Zero(made.hand.num_joints()));
    for (int n = 0; n < 100; ++n) {
      const VectorXd angles = DrawPosture(arm, random);
      std::map<std::string, double> q;
      for (int i = 0; i < arm.num_joints(); ++i) q["arm/" + arm.joints[i].name] = angles[i];
      const std::map<std::string, Pose> poses = CalcPoses(made.urdf, q);
      ASSERT_EQ(poses.size(), made.urdf.links.size());
      const Pose X_WH = made.mounted.X_WB * CalcFlangePose(arm, angles) * made.mounted.X_FH;
      for (size_t link = 0; link < X_HL.size(); ++link) {
        const Pose& found = poses.at(made.hand.links[link].name);
        EXPECT_LT((found.matrix() - (X_WH * X_HL[link]).matrix()).cwiseAbs().maxCoeff(), 1e-9);
      }
    }
  }
}

TEST(ArmUrdf, MassesAndLimitsAreThoseOfTheArm) {
  const Arm arm = LoadArm("pa10");
  const WrittenRobot made = Write(arm, "tum");
  const VectorXd zero = VectorXd::Zero(arm.num_joints());
  const std::vector<Pose> X_BL = CalcArmPoses(arm, zero);
  const std::map<std::string, Pose> poses = CalcPoses(made.urdf, {});
  int num_links = 0, num_joints = 0;
  for (int i = 0; i < arm.num_joints(); ++i) {
    const ArmJoint& joint = arm.joints[i];
    const std::string name = "arm/" + joint.name;
    for (const UrdfLink& link : made.urdf.links) {
      if (link.name != name) continue;
      ++num_links;
      ASSERT_TRUE(link.inertia) << name;
      EXPECT_DOUBLE_EQ(link.inertia->mass, joint.mass);
      const Pose X_WI = poses.at(name) * link.inertia->X_LI;
      const Pose X_WL = made.mounted.X_WB * X_BL[i + 1];
      EXPECT_LT((X_WI.translation() - X_WL * joint.p_com).norm(), 1e-12);
      const Eigen::Matrix3d I_W = X_WI.linear() * link.inertia->I_I * X_WI.linear().transpose();
      const Eigen::Matrix3d expected =
          X_WL.linear() * joint.inertia.asDiagonal() * X_WL.linear().transpose();
      EXPECT_LT((I_W - expected).cwiseAbs().maxCoeff(), 1e-9) << name;
    }
    for (const UrdfJoint& written : made.urdf.joints) {
      if (written.name != name) continue;
      ++num_joints;
      ASSERT_TRUE(written.limit) << name;
      EXPECT_DOUBLE_EQ(written.limit->lower, joint.lower);
      EXPECT_DOUBLE_EQ(written.limit->upper, joint.upper);
      EXPECT_DOUBLE_EQ(*written.limit->effort, joint.torque);
    }
  }
  EXPECT_EQ(num_links, arm.num_joints());
  EXPECT_EQ(num_joints, arm.num_joints());
}

TEST(ArmUrdf, ANameOfBothIsRefused) {
  const Hand hand = LoadHand("tum");
  const MountedArm mounted =
      MountArm(ArmConfig(), std::make_shared<const Arm>(LoadArm("pa10")), hand);
  try {
    FormatArmUrdf(mounted, hand, "<robot name='r'><link name='arm/S1'/></robot>");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUnsupported);
    EXPECT_NE(std::string(error.what()).find("the hand has a <link> named \"arm/S1\""),
              std::string::npos)
        << error.what();
  }
  EXPECT_THROW(FormatArmUrdf(mounted, hand, "<robot"), Error);
}

}  // namespace
}  // namespace graspbench
