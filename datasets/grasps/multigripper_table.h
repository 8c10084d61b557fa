#pragma once
/** @file
The grippers of MultiGripperGrasp (Casas et al. 2024), as its repository tabulates them. Source:
grippers/controller_info.json (close_dir) and grippers/gripper_isaac_info.json (EF_axis,
contact_names, contact_th, opened_dofs) of IRVLUTD/isaac_sim_grasping, commit 7ccd3d7. Joints are in
the order of its simulator; the tables do not name them. */

#include <string>
#include <string_view>
#include <vector>

namespace graspbench {

struct MultigripperGripper {
  const char* id;
  int axis;  ///< 1, 2, 3: gravity acts along x, y, z of the root; negative: against
  std::vector<double> closing;  ///< by joint, as ClosingTable::shares
  std::vector<double> open;     ///< by joint [rad]; prismatic joints [m]
  std::vector<const char*> contact_links;
  int num_touching;
};

/** Returns nullptr if the tables do not have the gripper. */
const MultigripperGripper* FindMultigripperGripper(std::string_view id);

}  // namespace graspbench
