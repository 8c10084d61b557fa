#pragma once
/** @file
How a source of grasps closes its own gripper, for sources that publish this as a table. */

#include <Eigen/Core>
#include <vector>

namespace graspbench {

struct ClosingTable {
  /** By joint: 0 if it stays as stated, otherwise the share of its upper (> 0) or lower (< 0)
  limit. */
  Eigen::VectorXd shares;
  Eigen::Vector3d down_H = Eigen::Vector3d::UnitZ();  ///< unit direction of the open hand
  std::vector<bool> counts;                           ///< by link: its contact counts
  int num_touching = 2;                               ///< links in contact with a held object
};

}  // namespace graspbench
