#pragma once
/** @file
Why a grasp passes under one profile and fails under another: from the first to the second one value
at a time, in the order of profile.yaml, each change kept. */

#include <string>
#include <vector>

#include "workbench/experiments/grasp_inputs.h"

namespace graspbench {

struct ExplainStep {
  std::string key;         ///< of profile.yaml; empty: the first profile as it is
  std::string from, to;    ///< its values
  FreeSpaceResult result;  ///< with this value and all before it
  bool turns = false;      ///< the verdict is another one than before
};

/** The last step is the second profile. */
std::vector<ExplainStep> ExplainGrasp(const GraspInputs& inputs, const GraspInput& input,
                                      const FreeSpaceProfile& from, const FreeSpaceProfile& to);

}  // namespace graspbench
