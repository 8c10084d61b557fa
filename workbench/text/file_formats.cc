#include "workbench/text/file_formats.h"

#include "core/grasp/grasp_keys.h"
#include "core/hand/hand_yaml.h"
#include "core/hand/tactile_yaml.h"
#include "datasets/judged_grasps/profile_file.h"
#include "datasets/pipeline/pipeline_file.h"
#include "datasets/plan/session_keys.h"
#include "datasets/plan/sweep_design.h"
#include "human_study/study/design/study_keys.h"
#include "objects/object_file.h"

namespace graspbench {

const std::vector<FileFormat>& ListFileFormats() {
  static const std::vector<FileFormat> formats = [] {
    FileKeys hand = ListHandKeys();
    hand.insert(hand.end(), ListHandGraspKeys().begin(), ListHandGraspKeys().end());
    return std::vector<FileFormat>{
        {"object.yaml", "a thing to grasp, beside its mesh", ListObjectKeys()},
        {"hand.yaml", "what hand.urdf beside it cannot say", hand},
        {"tactile.yaml", "what a hand feels with, beside its hand.yaml; not needed",
         ListTactileKeys()},
        {"session.yaml",
         "what graspbench run simulates; its session.json has all that matter and is read, "
         "too",
         ListSessionKeys()},
        {"sweep.yaml", "a session under many conditions, for graspbench sweep", ListSweepKeys()},
        {"study.yaml", "a study of people's grasps, for graspbench study run", ListStudyKeys()},
        {"grasp.yaml", "a grasp of its own file, for graspbench run --grasp FILE",
         ListGraspFileKeys()},
        {"profile.yaml", "how somebody judges grasps, for graspbench grasps judge --profile FILE",
         ListProfileKeys()},
        {"pipeline.yaml", "stages that make results, for graspbench pipeline run",
         ListPipelineKeys()},
    };
  }();
  return formats;
}

}  // namespace graspbench
