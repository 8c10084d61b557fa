// What the good files hold, format by format; their numbers are written in the files, or were given
// to numpy.
#include <gtest/gtest.h>

#include "core/hand/load_hand.h"
#include "datasets/grasps/map_to_hand.h"
#include "tests/datasets/grasps/grasp_cases.h"
#include "tests/support/shared_data.h"

namespace graspbench {
namespace {

GraspReadOptions MakeFrames() {
  GraspReadOptions options;
  options.hand_frame = "hand";
  options.object_frame = "mesh";
  return options;
}

TEST(GraspFormats, SpellingsOfDexgraspbench) {
  // The same grasp in pickle protocols 2, 4 and 5, as lists, in other types of number.
  const ForeignGrasp grasp = ReadGraspCase("dexgraspbench", "good_protocol_2.npy")[0];
  EXPECT_EQ(grasp.stages[1].X_OR.translation(), Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(grasp.stages[1].joints[21], 0.01 * 21);
  EXPECT_EQ(grasp.scale, 0.1);
  for (const char* name : {"good_protocol_4.npy", "good_protocol_5.npy", "good_lists.npy"}) {
    const ForeignGrasp other = ReadGraspCase("dexgraspbench", name)[0];
    for (size_t s = 0; s < 3; ++s) {
      EXPECT_EQ(other.stages[s].joints, grasp.stages[s].joints) << name;
      EXPECT_EQ(other.stages[s].X_OR.matrix(), grasp.stages[s].X_OR.matrix()) << name;
    }
  }
  const ForeignGrasp types = ReadGraspCase("dexgraspbench", "good_types.npy")[0];
  EXPECT_EQ(types.object, "assets/mug \xc3\xa9");
  EXPECT_EQ(types.stages[0].joints, grasp.stages[0].joints);          // Fortran order
  EXPECT_EQ(types.stages[1].joints[21], static_cast<double>(0.21f));  // big endian
  EXPECT_NEAR(types.stages[2].joints[21], 0.01 * 21, 0.01 * 21 * std::ldexp(1, -11));  // half
}

TEST(GraspFormats, RowsOfAnArrayInFortranOrder) {
  const std::vector<ForeignGrasp> grasps = ReadGraspCase("dexgraspbench", "good_fortran.npy");
  ASSERT_EQ(grasps.size(), 2u);
  for (size_t s = 0; s < 3; ++s) {
    EXPECT_EQ(grasps[1].stages[s].X_OR.translation(), Eigen::Vector3d(0.9, 0.2, 0.3));
  }
  EXPECT_EQ(grasps[0].scale, 0.1);
  EXPECT_EQ(grasps[1].scale, 0.2);
}

TEST(GraspFormats, TheWayToOneGraspOfDexonomy) {
  const std::vector<ForeignGrasp> grasps = ReadGraspCase("dexgraspbench", "good_way.npy");
  ASSERT_EQ(grasps.size(), 1u);
  ASSERT_EQ(grasps[0].stages.size(), 5u);
  EXPECT_EQ(grasps[0].stages[2].name, "pregrasp");
  EXPECT_EQ(grasps[0].stages[3].name, "grasp");
}

TEST(GraspFormats, IsaacInBothSpellings) {
  for (const char* name : {"good_sim.yaml", "good_ros.yaml"}) {
    const std::vector<ForeignGrasp> grasps = ReadGraspCase("isaac", name, MakeFrames());
    ASSERT_EQ(grasps.size(), 2u);
    const ForeignGrasp& grasp = grasps[0];
    EXPECT_EQ(grasp.object, "/World/mug");
    EXPECT_EQ(grasp.root_link, "hand");
    EXPECT_EQ(grasp.joint_names, (std::vector<std::string>{"finger_joint1", "finger_joint2"}));
    ASSERT_EQ(grasp.stages.size(), 2u);
    EXPECT_EQ(grasp.stages[0].name, "pregrasp");
    EXPECT_EQ(grasp.stages[0].joints,
              (std::vector<double>{0.03, 0.04}));  // sorted like the grasp's
    EXPECT_EQ(grasp.stages[1].joints, (std::vector<double>{0.00943, 0.01}));
    EXPECT_EQ(grasp.stages[1].X_OR.translation(), Eigen::Vector3d(-0.04346, 0.06759, 0.19895));
    // Nearly half a turn about x: y and z of the hand point against those of the object.
    EXPECT_NEAR(grasp.stages[1].X_OR.linear()(0, 0), 2 * 0.98453 * 0.98453 - 1, 1e-4);
    EXPECT_EQ(grasps[1].stages.size(), 1u);
    EXPECT_EQ(grasps[1].stages[0].joints, (std::vector<double>{0, 0.001}));
    EXPECT_EQ(grasp.assumptions.size(), 2u);
  }
}

TEST(GraspFormats, IsaacWithoutJointsIsAnOpenHand) {
  GraspReadOptions options = MakeFrames();
  options.open_joints = {{"finger_joint1", 0.05}};
  const std::vector<ForeignGrasp> grasps = ReadGraspCase("isaac", "good_2025.yaml", options);
  ASSERT_EQ(grasps.size(), 2u);
  EXPECT_EQ(grasps[0].object, "meshes/can.obj");
  EXPECT_EQ(grasps[0].scale, 0.5);
  ASSERT_EQ(grasps[0].stages.size(), 1u);
  EXPECT_EQ(grasps[0].stages[0].name, "pregrasp");
  EXPECT_EQ(grasps[0].joint_names, std::vector<std::string>{"finger_joint1"});
  EXPECT_EQ(grasps[0].stages[0].joints, std::vector<double>{0.05});
  ASSERT_EQ(grasps[1].stages.size(), 1u);
  EXPECT_EQ(grasps[1].joint_names, (std::vector<std::string>{"finger_joint2", "finger_joint1"}));
  EXPECT_EQ(grasps[1].stages[0].joints, (std::vector<double>{0.04, 0.03}));
}

// What a writer of 2025 leaves beside joints: the object's file and where jaws would meet.
TEST(GraspFormats, IsaacOfAStrangerWithBothJointsAndABitePoint) {
  const std::filesystem::path file = FindSharedData() / "strangers" / "hands" / "writer_2025.yaml";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not on this machine";
  GraspReadOptions options = MakeFrames();
  options.hand_frame = "palm";
  const std::vector<ForeignGrasp> grasps = ReadGrasps(file.string(), "auto", options);
  ASSERT_EQ(grasps.size(), 1u);
  EXPECT_EQ(grasps[0].object, "can.obj");
  ASSERT_EQ(grasps[0].stages.size(), 1u);
  EXPECT_EQ(grasps[0].joint_names.size(), 9u);
  EXPECT_EQ(grasps[0].stages[0].X_OR.translation(), Eigen::Vector3d(0, 0, 0.15));
}

TEST(GraspFormats, Multigripper) {
  GraspReadOptions options = MakeFrames();
  options.joint_names = {"left", "right"};
  const std::vector<ForeignGrasp> grasps = ReadGraspCase("multigripper", "good_dofs.json", options);
  ASSERT_EQ(grasps.size(), 2u);
  EXPECT_EQ(grasps[0].hand, "franka_panda");
  EXPECT_EQ(grasps[0].object, "Mug");
  EXPECT_EQ(grasps[0].label, true);
  EXPECT_EQ(grasps[1].label, false);
  EXPECT_EQ(grasps[0].stages[0].joints, (std::vector<double>{0.04, 0.04}));
  EXPECT_EQ(grasps[0].stages[1].joints, (std::vector<double>{0.01, 0.01}));
  // w x y z = 0.5 0.5 -0.5 0.5 lays the hand's x along the object's z, worked out by hand.
  EXPECT_TRUE(grasps[0].stages[0].X_OR.linear().col(0).isApprox(Eigen::Vector3d(0, 0, 1)));
  const std::vector<ForeignGrasp> poses = ReadGraspCase("multigripper", "good_poses.json", options);
  EXPECT_FALSE(poses[0].label);
  EXPECT_EQ(poses[0].joint_names, options.joint_names);
  EXPECT_EQ(poses[0].stages[0].joints, (std::vector<double>{0.04, 0.04})) << "open, by the table";
  options.joint_names.clear();
  EXPECT_TRUE(ReadGraspCase("multigripper", "good_poses.json", options)[0].joint_names.empty());
  options.joint_names = {"left"};
  EXPECT_TRUE(Has(FindError([&] { ReadGraspCase("multigripper", "good_poses.json", options); }),
                  "franka_panda has 2 joints, 1 names by --joint-names"));
}

TEST(GraspFormats, GraspgenHasPosesAndVerdictsOnly) {
  GraspReadOptions options = MakeFrames();
  options.open_joints = {{"left", 0.04}, {"right", 0.03}};
  const std::vector<ForeignGrasp> grasps = ReadGraspCase("graspgen", "good_poses.json", options);
  ASSERT_EQ(grasps.size(), 2u);
  EXPECT_EQ(grasps[0].object, "a/mug.obj");
  EXPECT_EQ(grasps[0].scale, 0.5);
  EXPECT_EQ(grasps[0].label, true);
  EXPECT_EQ(grasps[1].label, false);
  Eigen::Matrix3d R;
  R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  EXPECT_EQ(grasps[0].stages[0].X_OR.linear(), R);
  EXPECT_EQ(grasps[0].stages[0].X_OR.translation(), Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(grasps[0].joint_names, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(grasps[0].stages[0].joints, (std::vector<double>{0.04, 0.03}));
}

// Fingertips of DexGraspNet's hand, calculated apart from this program from the numbers of
// shadow_hand_wrist_free.xml. A mapping by the numbers in the names would put FFJ3's position, a
// sideways angle, on the knuckle that bends.
TEST(GraspFormats, DexgraspnetCountsJointsFromZero) {
  const Hand hand = LoadHand("shadow");
  const std::vector<ForeignGrasp> grasps = ReadGraspCase("dexgraspnet", "good_core-mug-8570d9.npy");
  ASSERT_EQ(grasps.size(), 2u);
  EXPECT_EQ(grasps[1].scale, 0.1);
  EXPECT_EQ(grasps[0].object, "good_core-mug-8570d9");
  EXPECT_EQ(grasps[0].joint_names[0], "robot0:FFJ3");
  const HandStage stage = MapToHand(grasps[0], hand).stages[0];
  EXPECT_EQ(stage.q[hand.FindJoint("FFJ4")], -0.1);
  EXPECT_EQ(stage.q[hand.FindJoint("FFJ3")], 0.7);
  EXPECT_EQ(stage.q[hand.FindJoint("FFJ1")], 0.5);
  EXPECT_EQ(stage.q[hand.FindJoint("THJ1")], 0.7);
  const std::vector<Eigen::Vector3d> tips = {{0.1493113, -0.1521902, 0.3072893},
                                             {0.1304954, -0.1590059, 0.2861313},
                                             {0.1145115, -0.1699107, 0.2834092},
                                             {0.1192805, -0.1760277, 0.2604970},
                                             {0.1425547, -0.1287240, 0.2866665}};
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    const Digit& digit = hand.digits[d];
    const Eigen::Vector3d tip =
        stage.X_OH * CalcLinkPose(hand, stage.q, digit.distal_link) * digit.p_LTip;
    // The thumb's base is 0.4 mm elsewhere and turned by 0.03 degrees, the little finger 1.8 mm.
    EXPECT_LT((tip - tips[d]).norm(), digit.id == "LF" ? 2.5e-3 : 6e-4) << digit.id;
  }
}

}  // namespace
}  // namespace graspbench
