#pragma once
/** @file
The options by which a command names grasps that others made, and what their files do not say. */

#include <string>
#include <vector>

#include "datasets/grasps/grasp_files.h"

namespace CLI {
class App;
}

namespace graspbench {

class ForeignGraspOptions {
 public:
  void AddTo(CLI::App& command);
  /** @throws as ReadGraspCollection. */
  GraspCollection Read() const;

 private:
  std::vector<std::string> paths_;
  std::string format_ = "auto";
  GraspReadOptions read_;
  double scale_ = 0.0;                    ///< 0: not given
  std::vector<std::string> open_joints_;  ///< "NAME=POSITION"
};

}  // namespace graspbench
