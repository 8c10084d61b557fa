/** @file
Target for one format of foreign grasps, named by GRASPBENCH_FUZZ_GRASPS at compile time:
refused with an Error, or grasps of finite numbers that are written and read again the same. */

#include <string>

#include "datasets/grasps/grasp_files.h"
#include "datasets/grasps/write_grasps.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {
namespace {

GraspReadOptions MakeOptions() {
  GraspReadOptions options;
  options.hand_frame = "palm";
  options.object_frame = "mesh";
  options.joint_names = {"a", "b"};
  return options;
}

void CheckReadAgain(const std::vector<ForeignGrasp>& grasps, const std::string& format) {
  WrittenGrasps written;
  try {
    written = WriteGrasps(grasps, format);
  } catch (const Error&) {
    return;  // of another hand, or of several objects
  }
  GraspReadOptions options = MakeOptions();
  options.scale = grasps.front().scale;
  const std::vector<ForeignGrasp> again = ParseGrasps(written.bytes, "again", format, options);
  GRASPBENCH_DEMAND(again.size() == grasps.size(), std::to_string(again.size()));
  const GraspStage& before = grasps.back().stages.back();
  const GraspStage& after = again.back().stages.back();
  if (before.name != after.name) return;
  GRASPBENCH_DEMAND(before.X_OR.matrix() == after.X_OR.matrix(), "another pose");
  GRASPBENCH_DEMAND(before.joints == after.joints, "other joints");
}

}  // namespace

void FuzzInput(const std::string& bytes) {
  try {
    const std::vector<ForeignGrasp> grasps =
        ParseGrasps(bytes, "fuzz", GRASPBENCH_FUZZ_GRASPS, MakeOptions());
    for (const ForeignGrasp& grasp : grasps) {
      GRASPBENCH_DEMAND(!grasp.stages.empty() && grasp.scale > 0.0, grasp.object);
      for (const GraspStage& stage : grasp.stages) {
        GRASPBENCH_DEMAND(stage.joints.size() == grasp.joint_names.size(), stage.name);
        GRASPBENCH_DEMAND(stage.X_OR.matrix().allFinite(), stage.name);
      }
    }
    CheckReadAgain(grasps, "dexgraspbench");
    CheckReadAgain(grasps, "isaac");
  } catch (const Error&) {
  }
}

}  // namespace graspbench
