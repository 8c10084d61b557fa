#include "core/arm/load_arm.h"

#include <gtest/gtest.h>

#include <string>

#include "core/arm/mounted_arm.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

/** Six joints alike. */
std::string MakeText(int num_joints) {
  std::string text = "name: Alike\nready_deg: [";
  for (int i = 0; i < num_joints; ++i) text += i > 0 ? ", 0" : "0";
  text += "]\njoints:\n";
  for (int i = 0; i < num_joints; ++i) {
    text += "  - {name: j" + std::to_string(i + 1) +
            R"(, a_m: 0.5, d_m: 0, alpha_deg: 0, lower_deg: -90, upper_deg: 90,
     speed_deg_per_s: 90, torque_nm: 10, stiffness_nm_per_rad: 2000, armature_kg_m2: 0.1,
     mass_kg: 1, com_m: [0, 0, 0], inertia_kg_m2: [0.01, 0.01, 0.01]}
)";
  }
  return text + "capsules:\n  - {link: 1, from_m: [-0.5, 0, 0], to_m: [0, 0, 0], radius_m: 0.05}\n";
}

std::string Replace(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string ReplaceAll(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

TEST(LoadArm, ArmsOfTheProgram) {
  EXPECT_EQ(ListArms(), (std::vector<std::string>{"pa10", "puma560"}));
  EXPECT_EQ(LoadArm("puma560").num_joints(), 6);
  EXPECT_EQ(LoadArm("pa10").num_joints(), 7);
}

TEST(LoadArm, WrongFilesAreRefusedByName) {
  struct Case {
    std::string text, expected;
  };
  const std::string text = MakeText(6);
  const Case cases[] = {
      {Replace(text, "lower_deg: -90, upper_deg: 90,", ""), "lower_deg"},
      {Replace(text, "upper_deg: 90", "upper_deg: -95"), "expected more than its lower_deg"},
      {Replace(text, "lower_deg: -90, upper_deg: 90", "lower_deg: -3.14, upper_deg: 3.14"),
       "joint \"j1\": turns by 6.28 deg only; expected degrees, these look like radians"},
      {Replace(text, "a_m: 0.5, ", ""), "a_m"},
      {Replace(text, "stiffness_nm_per_rad: 2000", "stiffness_nm_per_rad: 0"),
       "stiffness_nm_per_rad"},
      {Replace(text, "stiffness_nm_per_rad: 2000", "stiffness_nm_per_rad: 2"),
       "joint \"j1\": turns by more than 1 rad at its torque; expected at least"},
      {Replace(text, "armature_kg_m2: 0.1,", ""), "armature_kg_m2"},
      {Replace(text, "ready_deg: [0,", "ready_deg: [0, 1,"), "expected one angle for each of"},
      {Replace(text, "ready_deg: [0", "ready_deg: [91"), "outside its limits"},
      {Replace(text, "link: 1", "link: 7"), "no link 7; expected 0 (the base) to 6"},
      {Replace(text, "radius_m: 0.05", "radius_m: 0"), "radius_m"},
      {Replace(text, "mass_kg: 1,", "mass_kg: 1, colour: red,"), "colour"},
      {Replace(text, "a_m: 0.5", "a_m: .nan"), "joint, a_m: expected a finite number"},
      {Replace(text, "a_m: 0.5", "a_m: 431.8"), "a_m: 431.8 is out of range; expected -3 to 3"},
      {Replace(text, "mass_kg: 1,", "mass_kg: -1,"), "mass_kg: -1 is out of range; expected 0 to"},
      {Replace(text, "inertia_kg_m2: [0.01", "inertia_kg_m2: [-0.01"),
       "inertia_kg_m2: -0.01 is out of range"},
      {Replace(text, "alpha_deg: 0", "alpha_deg: -1.5708"),
       "alpha_deg: -1.5708 deg; expected degrees, this looks like radians"},
      {Replace(text, "alpha_deg: 0", "offset_deg: 3.1416, alpha_deg: 0"),
       "offset_deg: 3.1416 deg; expected degrees, this looks like radians"},
      {Replace(text, "name: j2", "name: j1"), "two joints are named \"j1\""},
      {ReplaceAll(text, "a_m: 0.5", "a_m: 0"),
       "every a_m and d_m behind joint 1 is 0; expected the lengths of the links"},
      {ReplaceAll(text, "speed_deg_per_s: 90", "speed_deg_per_s: 1.57"),
       "no joint is faster than 6.3 deg/s; expected degrees per second"},
      {MakeText(5), "found 5 joints; expected 6 to 10, for the hand to take any pose"},
      {MakeText(11), "found 11 joints; expected 6 to 10"},
  };
  for (const Case& one : cases) {
    Diagnostics problems;
    ParseArm(one.text, "arms/one", problems);
    EXPECT_GE(problems.num_errors(), 1);
    EXPECT_NE(problems.Format().find(one.expected), std::string::npos) << problems.Format();
  }
  Diagnostics without_limits;
  ParseArm(Replace(text, "lower_deg: -90, upper_deg: 90,", ""), "arms/one", without_limits);
  EXPECT_EQ(without_limits.num_errors(), 2) << without_limits.Format();  // and no more
  Diagnostics none;
  EXPECT_EQ(ParseArm(MakeText(6), "arms/one", none).id, "one");
  EXPECT_EQ(none.num_errors(), 0) << none.Format();
  try {
    LoadArm("pa-10");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"pa10\""), std::string::npos)
        << error.what();
  }
}

/** The palm of the TUM hand is a box whose back is 90 mm or so behind H. */
TEST(MountArm, HindmostSurfaceTouchesFlange) {
  const auto arm = std::make_shared<const Arm>(LoadArm("puma560"));
  const Hand hand = LoadHand("tum");
  ArmConfig config;
  config.x = -0.6;
  config.yaw = 0.5;
  const MountedArm mounted = MountArm(config, arm, hand);
  double hindmost = 1.0;
  for (const LinkVisual& visual : hand.visuals) {
    if (visual.link != 0) continue;
    for (const Eigen::Vector3d& p : visual.mesh.vertices) {
      hindmost = std::min(hindmost, (mounted.X_FH * hand.links[0].X_PJ * p).z());
    }
  }
  EXPECT_NEAR(hindmost, 0.0, 1e-12);
  EXPECT_LT((mounted.X_FH.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_LT((mounted.X_WB.translation() - Eigen::Vector3d(-0.6, 0.0, 0.0)).norm(), 1e-12);
  config.mount = "-y";
  const Eigen::Vector3d axis_F =
      MountArm(config, arm, hand).X_FH.linear() * -Eigen::Vector3d::UnitY();
  EXPECT_LT((axis_F - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

}  // namespace
}  // namespace graspbench
