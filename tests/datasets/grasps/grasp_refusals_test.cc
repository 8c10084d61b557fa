// Every file that must be refused, with the words that say why and where. Those of .npy were
// written by numpy 1.24 or by Python's pickle and then damaged.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "tests/datasets/grasps/grasp_cases.h"

namespace graspbench {
namespace {

using Refusals = std::map<std::string, std::string>;

GraspReadOptions MakeOptions() {
  GraspReadOptions options;
  options.hand_frame = "hand";
  options.object_frame = "mesh";
  options.joint_names = {"finger_joint1", "finger_joint2"};
  return options;
}

/** All bad files of the folder are in the table, and refused so; all good ones are read. */
void ExpectRefusals(const std::string& format, const Refusals& refusals) {
  namespace fs = std::filesystem;
  size_t num_bad = 0;
  for (const auto& entry : fs::directory_iterator(FindGraspCase(format, ""))) {
    const std::string name = entry.path().filename().string();
    const std::string error =
        FindError([&] { ReadGrasps(entry.path().string(), format, MakeOptions()); });
    if (name.rfind("bad_", 0) != 0) {
      EXPECT_EQ(error, "") << name;
      continue;
    }
    ++num_bad;
    const auto found = refusals.find(name);
    ASSERT_NE(found, refusals.end()) << name << ": " << error;
    EXPECT_TRUE(Has(error, found->second)) << name << ": " << error;
    EXPECT_TRUE(Has(error, name));
  }
  EXPECT_EQ(num_bad, refusals.size());
}

TEST(GraspRefusals, Dexgraspbench) {
  const std::filesystem::path trace = "/tmp/graspbench_was_executed";
  std::filesystem::remove(trace);
  ExpectRefusals(
      "dexgraspbench",
      {{"bad_norm.npy",
        "grasp_qpos, row 0: the quaternion has the length 1.0015, expected 1 to "
        "within 0.001"},
       {"bad_nan.npy", "squeeze_qpos: number 10 is not finite"},
       {"bad_length.npy", "grasp_qpos has 1 row(s) of 28 number(s), expected rows of 29"},
       {"bad_count.npy", "squeeze_qpos is of 1 grasp(s), grasp_qpos of 2"},
       {"bad_no_scale.npy", "has no obj_scale"},
       {"bad_zero_scale.npy", "obj_scale is 0, expected above 0"},
       {"bad_no_squeeze.npy", "has no squeeze_qpos"},
       {"bad_text.npy", "grasp_qpos is a text, expected numbers"},
       {"bad_scene_path.npy", "scene_path: the object's scale stands in that file"},
       {"bad_uneven_scale.npy", "scene_cfg.scene.o.scale differs between the axes"},
       {"bad_executes.npy", "the pickle names posix.system, which is neither"},
       {"bad_object.npy", "the pickle names __main__.Plain, which is neither"},
       {"bad_deep.npy", "more than 32 values inside each other"},
       {"bad_truncated.npy", "the file is truncated or damaged"},
       {"bad_empty.npy", "is empty"},
       {"bad_plain_array.npy", "an array of plain numbers; expected a dictionary"},
       {"bad_shape_lies.npy", "an array of 30 elements (8 bytes each) has 232 bytes"},
       {"bad_size_lies.npy", "2147483647 bytes announced"},
       {"bad_header_lies.npy", "byte 8: a header of 65535 bytes"},
       {"bad_cycle.npy", "grasp_qpos is a list, expected numbers"},
       {"bad_set.npy", "operation 0x8f, which plain values"},
       {"bad_protocol_0.npy", "byte 0: neither a .npy file nor a pickle"}});
  EXPECT_FALSE(std::filesystem::exists(trace));
}

TEST(GraspRefusals, Dexgraspnet) {
  ExpectRefusals("dexgraspnet",
                 {{"bad_missing_joint.npy", "grasp 0, qpos has no robot0:THJ0"},
                  {"bad_unknown_joint.npy", "no joint \"robot0:FFJ4\"; did you mean"},
                  {"bad_infinite.npy", "qpos.robot0:FFJ3: number 1 is not finite"},
                  {"bad_scale.npy", "grasp 0.scale is -1, expected above 0"},
                  {"bad_dict.npy", "holds a dictionary, expected a list"},
                  {"bad_shared.npy", "5000 grasps in 10796 bytes: the file lies"}});
}

TEST(GraspRefusals, Isaac) {
  ExpectRefusals(
      "isaac",
      {{"bad_version.yaml", ":2: error: isaac_grasp, format_version: is 2.0; 1.0 is read"},
       {"bad_norm.yaml", ":11: error: grasp grasp_0: the quaternion has the length"},
       {"bad_joint.yaml", ":16: error: grasp grasp_0: pregrasp_cspace_position is of other"},
       {"bad_nan.yaml", ":10: error: grasp grasp_0, position: expected"},
       {"bad_null_joints.yaml", "grasp grasp_1, cspace_position: expected a map of joints"},
       {"bad_null_pregrasp.yaml", "grasp_0, pregrasp_cspace_position: expected a map of joints"},
       {"bad_scale.yaml", ":5: error: isaac_grasp, object_scale: expected a number above 0"},
       {"bad_position.yaml", ":20: error: grasp grasp_1, position: expected"},
       {"bad_twice.yaml", ":18: error: grasp grasp_0 is there twice"},
       {"bad_no_grasps.yaml", "the key \"grasps\" is missing"},
       {"bad_list.yaml", ":7: error: isaac_grasp, grasps: expected a map"},
       {"bad_syntax.yaml", "not valid YAML"}});
}

TEST(GraspRefusals, Multigripper) {
  ExpectRefusals("multigripper",
                 {{"bad_result.json", "result: expected a list of 2 verdicts"},
                  {"bad_label.json", "result[1]: expected true, false, 1 or 0"},
                  {"bad_norm.json", "pose[0]: the quaternion has the length 1.41421"},
                  {"bad_pose.json", "pose[0]: expected a list of 7 numbers, there are 6"},
                  {"bad_nan.json", "it is not valid JSON from line 1, column"},
                  {"bad_dofs.json", "dofs: expected a list of 2, one for each pose"},
                  {"bad_row.json", "dofs[0]: 1 positions without names, 2 names"},
                  {"bad_no_gripper.json", "the key \"gripper\" is missing"},
                  {"bad_text.json", "pose: expected a list of poses"},
                  {"bad_truncated.json", "it is not valid JSON from line 1, column"},
                  {"bad_deep.json", "it is not valid JSON from line 1, column"}});
}

TEST(GraspRefusals, Graspgen) {
  ExpectRefusals("graspgen", {{"bad_stretched.json", "grasps.transforms[0] is not a pose"},
                              {"bad_mirror.json", "grasps.transforms[0] is not a pose"},
                              {"bad_last_row.json", "grasps.transforms[0] is not a pose"},
                              {"bad_size.json", "grasps.transforms[1]: expected 4 rows"},
                              {"bad_scale.json", "object.scale: expected a number above 0"},
                              {"bad_labels.json", "grasps.object_in_gripper: expected a list of 2"},
                              {"bad_no_object.json", "object: the key \"file\" is missing"}});
}

TEST(GraspRefusals, WhatAFileDoesNotSayMustBeGiven) {
  const auto error_of = [](const std::string& format, const std::string& name,
                           const GraspReadOptions& options) {
    return FindError([&] { ReadGraspCase(format, name, options); });
  };
  GraspReadOptions options;
  EXPECT_TRUE(Has(error_of("isaac", "good_sim.yaml", options), "--hand-frame"));
  EXPECT_TRUE(Has(error_of("graspgen", "good_poses.json", options), "--hand-frame"));
  EXPECT_TRUE(Has(error_of("multigripper", "good_dofs.json", options), "--hand-frame"));
  options.hand_frame = "hand";
  EXPECT_TRUE(Has(error_of("isaac", "good_ros.yaml", options), "--object-frame mesh"));
  EXPECT_TRUE(Has(error_of("multigripper", "good_dofs.json", options), "--joint-names"));
}

}  // namespace
}  // namespace graspbench
