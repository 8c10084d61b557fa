// Writes the meshes of the project's hands: generate_hand_visuals core/hand/models

#include <cstdio>
#include <exception>
#include <filesystem>

#include "core/base/files/files.h"
#include "core/hand/generate/hand_visuals.h"
#include "core/shape/obj_file.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: generate_hand_visuals core/hand/models\n");
    return 2;
  }
  try {
    for (const auto& [name, mesh] : graspbench::MakeHandVisuals()) {
      const std::filesystem::path path = std::filesystem::path(argv[1]) / name;
      std::filesystem::create_directories(path.parent_path());
      graspbench::WriteFileAtomically(path, graspbench::FormatObj(mesh));
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "generate_hand_visuals: %s\n", e.what());
    return 1;
  }
}
