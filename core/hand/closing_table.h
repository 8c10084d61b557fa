#pragma once
/** @file
How a source of grasps has a gripper of its own close, where it publishes that as a table. */

#include <Eigen/Core>
#include <vector>

namespace graspbench {

struct ClosingTable {
  /** By joint: 0, it stays as stated; else this share of its upper (> 0) or lower (< 0) limit. */
  Eigen::VectorXd shares;
  Eigen::Vector3d down_H = Eigen::Vector3d::UnitZ();  ///< unit: what the open hand points along
  std::vector<bool> counts;                           ///< by link: its touch counts
  int num_touching = 2;                               ///< links that must touch a held object
};

}  // namespace graspbench
