// Any bytes as a mesh file, read as each of three formats: refused with an Error, or checked,
// repaired and checked again. A mesh without problems has a volume.
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/error.h"
#include "core/shape/mesh_check.h"
#include "core/shape/mesh_repair.h"
#include "objects/load_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  for (const char* name : {"mesh.obj", "mesh.stl", "mesh.ply"}) {
    try {
      const TriMesh mesh = ParseMesh(bytes, name, LengthUnit::kMm);
      for (const MeshReport& report : {CheckMesh(mesh), CheckMesh(RepairMesh(mesh).mesh)}) {
        GRASPBENCH_DEMAND(!report.problems.empty() || report.volume > 0.0,
                          std::to_string(report.volume));
      }
    } catch (const Error& e) {
      GRASPBENCH_DEMAND(e.kind() == ErrorKind::kFormat, e.what());
    }
  }
  return 0;
}
