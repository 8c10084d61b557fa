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

std::optional<LengthUnit> InferLengthUnit(double largest_extent) {
  for (const LengthUnit unit : {LengthUnit::kM, LengthUnit::kMm}) {
    const double extent = largest_extent * MetresPer(unit);
    if (extent >= kMinMeshExtent && extent <= kMaxMeshExtent) return unit;
  }
  return std::nullopt;
}

CheckedMeshFile CheckMeshFile(const std::filesystem::path& path, std::optional<LengthUnit> unit) {
  CheckedMeshFile file;
  file.mesh = LoadMesh(path, unit.value_or(LengthUnit::kM));
  file.report = CheckMesh(file.mesh);
  const std::optional<LengthUnit> inferred =
      unit ? unit : InferLengthUnit(file.report.extent.maxCoeff());
  file.is_unit_inferred = !unit && inferred;
  file.unit = inferred.value_or(LengthUnit::kM);
  if (file.is_unit_inferred && file.unit != LengthUnit::kM) {
    for (Eigen::Vector3d& p : file.mesh.vertices) p *= MetresPer(file.unit);
    file.report = CheckMesh(file.mesh);
  }
  return file;
}

MeshFileRepair RepairMeshFile(const CheckedMeshFile& file,
                              const std::filesystem::path& repaired_path) {
  const MeshRepair repair = RepairMesh(file.mesh);
  if (!repair.actions.empty()) {
    WriteFileAtomically(repaired_path, FormatObj(repair.mesh, UnitsPerMetre(file.unit)));
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
