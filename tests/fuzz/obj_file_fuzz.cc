// Any bytes as an OBJ file: a problem, or a mesh whose triangles name vertices.

#include <string>

#include "core/shape/obj_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  Diagnostics problems;
  const TriMesh mesh = ParseObj(bytes, "fuzz", problems);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    GRASPBENCH_DEMAND(t.minCoeff() >= 0 && t.maxCoeff() < mesh.num_vertices(),
                      std::to_string(t.maxCoeff()));
  }
}

}  // namespace graspbench
