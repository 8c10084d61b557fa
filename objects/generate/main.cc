// generate_objects FOLDER: draws the mesh of every catalogue object, fits it to the size in its
// object.yaml and writes FOLDER/<id>/mesh.obj. The same program gives the same bytes every time.

#include <cstdio>
#include <filesystem>

#include "core/base/error.h"
#include "objects/generate/object_shapes.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: generate_objects FOLDER (objects/catalogue)\n");
    return graspbench::kExitUsage;
  }
  try {
    graspbench::GenerateMeshes(argv[1]);
  } catch (const graspbench::Error& e) {
    std::fprintf(stderr, "generate_objects: %s\n", e.what());
    return graspbench::ExitCodeOf(e.kind());
  }
  return graspbench::kExitOk;
}
