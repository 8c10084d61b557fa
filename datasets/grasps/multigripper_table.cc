#include "datasets/grasps/multigripper_table.h"

namespace graspbench {
namespace {

const std::vector<MultigripperGripper>& ListMultigripperGrippers() {
  static const std::vector<MultigripperGripper> grippers = {
      {"fetch_gripper",
       1,
       {1, 1},
       {-0.025, -0.025},
       {"l_gripper_finger_link_joint", "r_gripper_finger_link_joint"},
       2},
      {"franka_panda",
       3,
       {-1, -1},
       {0.04, 0.04},
       {"panda_hand", "panda_leftfinger", "panda_rightfinger"},
       2},
      {"sawyer", 3, {1, 1}, {0, 0}, {"leftfinger", "rightfinger"}, 2},
      {"wsg_50", 3, {1, -1}, {-0.055, 0.055}, {"gripper_left", "gripper_right"}, 2},
      {"Barrett",
       3,
       {0, 0, 1, 1, 1, 0, 0, 0},
       {0.523599, 0.523599, 0, 0, 0, 0, 0, 0},
       {"base_link", "a_link1_joint", "b_link1_joint", "a_link2_joint", "a_link3_joint",
        "b_link2_joint", "b_link3_joint", "c_link2_joint_0", "c_link3_joint"},
       3},
      {"jaco_robot",
       -1,
       {1, 1, 1},
       {0, 0, 0},
       {"jaco_8_finger_index", "jaco_8_finger_thumb", "jaco_8_finger_pinkie"},
       3},
      {"robotiq_3finger",
       2,
       {0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0},
       {0, 0, -0.0872665, -0.0872665, -0.0872665, 0, 0, 0, 0, 0, 0},
       {"RIQ_palm", "RIQ_link_1_joint_a", "RIQ_link_1_joint_b", "RIQ_link_1_joint_c",
        "RIQ_link_2_joint_a", "RIQ_link_2_joint_b", "RIQ_link_2_joint_c", "RIQ_link_3_joint_a",
        "RIQ_link_3_joint_b", "RIQ_link_3_joint_c"},
       4},
      {"Allegro",
       1,
       {0, 0.5, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0},
       {0, 0, -0.09, -0.174533, 0, 1.16937, 0, 0, -0.174533, 0, -0.15708, -0.174533, 0.174533,
        0.174533, 0.174533, 0.174533},
       {"base_link", "link_0_0", "link_2_0", "link_3_0", "link_4_0", "link_5_0", "link_6_0",
        "link_7_0", "link_8_0", "link_9_0", "link_10_0", "link_11_0", "link_12_0", "link_13_0",
        "link_14_0", "link_15_0"},
       3},
      {"HumanHand",
       -2,
       {0, 0, 0, 0, 0, 1, 1, 1, 1, 0.75, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
       {0.174533, 0, -0.523599, -0.174533, -0.174533, 0, 0, 0, 0, -0.872665,
        0,        0, 0,         0,         -0.174533, 0, 0, 0, 0, 0},
       {"base_link", "index1_joint", "index2_joint", "index3_joint", "mid1_joint", "mid2_joint",
        "mid3_joint", "pinky1_joint", "pinky2_joint", "pinky3_joint", "ring1_joint", "ring2_joint",
        "ring3_joint", "thumb1_joint", "thumb2_joint", "thumb3_joint"},
       5},
      {"shadow_hand",
       -2,
       {0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 1, 1, 1, 1, 0, 0, 1, 0, 0, 1, 0, 0},
       {-0.174533, 0, 0, -0.174533, -0.785398, 0, -0.349066, 0, 0, 1.20428,  0,
        0,         0, 0, 0,         0,         0, 0,         0, 0, 0.349066, 0.349066},
       {"index_finger_proximal", "index_finger_middle", "index_finger_distal",
        "little_finger_proximal", "little_finger_middle", "little_finger_distal",
        "middle_finger_proximal", "middle_finger_middle", "middle_finger_distal",
        "ring_finger_proximal", "ring_finger_middle", "ring_finger_distal", "thumb_proximal",
        "thumb_middle", "thumb_distal"},
       5},
      {"h5_hand",
       -3,
       {1, -1, 0, 0},
       {-1.37881, 1.37881, 1.37881, -1.37881},
       {"left_tip_link", "right_tip_link", "base_link", "left_link_link", "right_link_link"},
       2},
      {"ezgripper",
       1,
       {1, 1, 1, 1},
       {0, 0, 0.2, 0.2},
       {"left_ezgripper_finger_L1_1", "left_ezgripper_finger_L1_2", "left_ezgripper_finger_L2_1",
        "left_ezgripper_finger_L2_2"},
       1}};
  return grippers;
}

}  // namespace

const MultigripperGripper* FindMultigripperGripper(std::string_view id) {
  for (const MultigripperGripper& gripper : ListMultigripperGrippers()) {
    if (id == gripper.id) return &gripper;
  }
  return nullptr;
}

}  // namespace graspbench
