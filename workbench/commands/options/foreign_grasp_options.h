#pragma once
/** @file
Command options that name external grasps and supply what their files do not state. */

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

/** Adds the hand that executes the grasps, and the folder of their objects' meshes. */
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
