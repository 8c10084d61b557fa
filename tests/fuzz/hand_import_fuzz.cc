// Any bytes as a foreign URDF: refused with problems, or files that load without error. A mesh
// found anywhere would be a tetrahedron. Links are covered coarsely: as for a user that would be
// most of the work.

#include <unistd.h>

#include <string>

#include "core/base/files/files.h"
#include "core/hand/import/import_hand.h"
#include "core/hand/load_hand.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  HandSource source;
  source.file = "hand.urdf";
  source.folder = "no-such-folder";
  source.num_cover_points = 0;
  source.load_mesh = [](const std::filesystem::path&) {
    TriMesh mesh;
    mesh.vertices = {{0, 0, 0}, {0.02, 0, 0}, {0, 0.02, 0}, {0, 0, 0.02}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
  };
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(bytes, source, "", problems);
  GRASPBENCH_DEMAND(imported.files.empty() == (problems.num_errors() > 0), problems.Format());
  if (imported.files.empty()) return;
  // Pictures lie in files of their own, which the loader reads.
  const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                       ("graspbench_fuzz_hand_" + std::to_string(::getpid()));
  std::filesystem::remove_all(folder);
  for (const auto& [name, content] : imported.files) {
    MakeFolder((folder / name).parent_path());
    WriteFile(folder / name, content);
  }
  Diagnostics of_loading;
  ParseHand(imported.files.at("hand.urdf"), imported.files.at("hand.yaml"), folder, of_loading);
  std::filesystem::remove_all(folder);
  GRASPBENCH_DEMAND(of_loading.num_errors() == 0,
                    of_loading.Format() + "\n" + imported.files.at("hand.yaml"));
}

}  // namespace graspbench
