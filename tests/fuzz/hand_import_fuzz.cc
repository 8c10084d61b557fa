// Any bytes as a foreign URDF: refused with problems, or files that load without error. A mesh
// found anywhere would be a tetrahedron.

#include <cstdint>
#include <string>

#include "core/base/error.h"
#include "core/hand/import/import_hand.h"
#include "core/hand/load_hand.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  HandSource source;
  source.file = "hand.urdf";
  source.folder = "no-such-folder";
  source.load_mesh = [](const std::filesystem::path&) {
    TriMesh mesh;
    mesh.vertices = {{0, 0, 0}, {0.02, 0, 0}, {0, 0.02, 0}, {0, 0, 0.02}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
  };
  Diagnostics problems;
  const ImportedFiles imported =
      ImportHand(std::string(reinterpret_cast<const char*>(data), size), source, "", problems);
  GRASPBENCH_DEMAND(imported.files.empty() == (problems.num_errors() > 0), problems.Format());
  if (imported.files.empty()) return 0;
  Diagnostics of_loading;
  ParseHand(imported.files.at("hand.urdf"), imported.files.at("hand.yaml"), "no-such-folder",
            of_loading);
  GRASPBENCH_DEMAND(of_loading.num_errors() == 0,
                    of_loading.Format() + "\n" + imported.files.at("hand.yaml"));
  return 0;
}
