#pragma once
/** @file
The options by which a command names grasps that others made, and what their files do not say. */

#include <optional>
#include <string>
#include <vector>

#include "datasets/grasps/grasp_files.h"
#include "workbench/experiments/grasp_inputs.h"

namespace graspbench {

class Command;

class ForeignGraspOptions {
 public:
  void AddTo(Command& command);
  /** @throws as ReadGraspCollection. */
  GraspCollection Read() const;

 private:
  std::vector<std::string> paths_;
  std::string format_ = "auto";
  GraspReadOptions read_;
  std::optional<double> scale_;
  std::vector<std::string> open_joints_;  ///< "NAME=POSITION"
};

/** Also the hand that does them, and where their objects' meshes are. */
class GraspInputOptions {
 public:
  void AddTo(Command& command);
  /** @throws as ReadGraspCollection, LoadGraspInputs. */
  GraspInputs Load(const std::vector<FreeSpaceProfile>& profiles) const;

 private:
  ForeignGraspOptions grasps_;
  std::string hand_ = "shadow";
  std::filesystem::path objects_;
};

}  // namespace graspbench
