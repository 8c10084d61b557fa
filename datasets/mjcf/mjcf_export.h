#pragma once
/** @file
Trials as scenes for MuJoCo: a folder a trial with

    scene.xml     hand, object, table and drives (mjcf_scene.h)
    motion.csv    the commanded motion (commanded_motion.h)

Whoever opens scene.xml in MuJoCo starts from its key "start" and gives the actuators row after
row of motion.csv; tests/peer does so and compares. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/trial/trial_setup.h"
#include "datasets/mjcf/convex_parts.h"

namespace graspbench {

class MjcfExporter {
 public:
  /** Carries out the trial and writes its folder; files of these names are replaced.
  @throws Error(kIo). */
  void Export(const TrialSetup& setup, const std::filesystem::path& folder);

 private:
  std::map<std::string, std::vector<ConvexPart>> parts_;  // by the object's content hash
};

}  // namespace graspbench
