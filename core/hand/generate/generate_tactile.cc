// Writes tactile.yaml of the project's hands: generate_tactile core/hand/models

#include <cstdio>
#include <exception>
#include <filesystem>

#include "core/base/files/files.h"
#include "core/hand/generate/tactile_layout.h"
#include "core/hand/load_hand.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: generate_tactile core/hand/models\n");
    return 2;
  }
  try {
    for (const char* id : {"shadow", "shadow-evolved", "tum", "tum-courses", "tum-evolved"}) {
      graspbench::WriteFileAtomically(std::filesystem::path(argv[1]) / id / "tactile.yaml",
                                      graspbench::MakeTactileYaml(graspbench::LoadHand(id)));
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "generate_tactile: %s\n", e.what());
    return 1;
  }
}
