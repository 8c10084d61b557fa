#include "datasets/mjcf/mjcf_export.h"

#include "core/base/files/files.h"
#include "datasets/mjcf/commanded_motion.h"
#include "datasets/mjcf/mjcf_scene.h"

namespace graspbench {

void MjcfExporter::Export(const TrialSetup& setup, const std::filesystem::path& folder) {
  const GraspObject& object = *setup.object;
  const auto [parts, is_new] = parts_.try_emplace(object.content_hash);
  if (is_new) parts->second = CutIntoConvexParts(object.mesh, *object.field);
  const CommandedMotion motion = RecordMotion(setup);
  MakeFolder(folder);
  WriteFileAtomically(folder / "scene.xml", FormatMjcf(setup, motion.start, parts->second));
  WriteFileAtomically(folder / "motion.csv", FormatMotionCsv(*setup.hand, motion));
}

}  // namespace graspbench
