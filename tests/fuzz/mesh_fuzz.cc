// Any bytes as a mesh file of one format (GRASPBENCH_FUZZ_MESH), or of every one: refused with an
// Error, or checked, repaired and checked again. A mesh without problems has a volume. The time and
// memory of the reader of foreign formats are its own limits.
#include <string>

#include "core/shape/repair/mesh_check.h"
#include "core/shape/repair/mesh_repair.h"
#include "objects/load_mesh.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
#ifdef GRASPBENCH_FUZZ_MESH
  const char* const kNames[] = {"mesh." GRASPBENCH_FUZZ_MESH};
#else
  const char* const kNames[] = {"mesh.obj", "mesh.stl", "mesh.ply", "mesh.glb", "mesh.gltf"};
#endif
  for (const char* name : kNames) {
    try {
      const TriMesh mesh = ParseMesh(bytes, name, LengthUnit::kMm);
      for (const MeshReport& report : {MakeUsable(mesh).report, CheckMesh(RepairMesh(mesh).mesh)}) {
        GRASPBENCH_DEMAND(!report.problems.empty() || report.volume > 0.0,
                          std::to_string(report.volume));
      }
    } catch (const Error& e) {
      GRASPBENCH_DEMAND(e.kind() == ErrorKind::kFormat, e.what());
    }
  }
}

}  // namespace graspbench
