#include "objects/check_mesh_file.h"

#include "core/base/files.h"
#include "core/shape/mesh_repair.h"
#include "core/shape/obj_file.h"
#include "objects/load_mesh.h"

namespace graspbench {
namespace {

Json VectorOrNull(const Eigen::Vector3d& v) {
  return v.allFinite() ? JsonVector(v) : Json(nullptr);
}

}  // namespace

MeshReport CheckMeshFile(const std::filesystem::path& path, LengthUnit unit) {
  return CheckMesh(LoadMesh(path, unit));
}

MeshFileRepair RepairMeshFile(const std::filesystem::path& path, LengthUnit unit,
                              const std::filesystem::path& repaired_path) {
  const MeshRepair repair = RepairMesh(LoadMesh(path, unit));
  if (!repair.actions.empty()) {
    WriteFileAtomically(repaired_path, FormatObj(repair.mesh, UnitsPerMetre(unit)));
  }
  return {repair.actions, CheckMesh(repair.mesh)};
}

Json FormatMeshReport(const MeshReport& report) {
  Json problems = Json::array();
  for (const MeshProblem& problem : report.problems) problems.push_back(problem.text);
  return Json{{"closed", report.is_closed},
              {"triangles", report.num_triangles},
              {"open_edges", report.num_open_edges},
              {"volume_m3", JsonNumber(report.volume)},
              {"centroid_m", VectorOrNull(report.centroid)},
              {"extent_m", VectorOrNull(report.extent)},
              {"problems", problems}};
}

}  // namespace graspbench
