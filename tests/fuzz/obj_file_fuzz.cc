// Any bytes as an OBJ file: a problem, or a mesh whose triangles name vertices.

#include <cstdint>
#include <string>

#include "core/base/error.h"
#include "core/shape/obj_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  Diagnostics problems;
  const TriMesh mesh =
      ParseObj(std::string(reinterpret_cast<const char*>(data), size), "fuzz", problems);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    GRASPBENCH_DEMAND(t.minCoeff() >= 0 && t.maxCoeff() < mesh.num_vertices(),
                      std::to_string(t.maxCoeff()));
  }
  return 0;
}
