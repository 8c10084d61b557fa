#include "objects/check_mesh_file.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "core/base/files/files.h"
#include "core/base/units.h"
#include "core/shape/obj_file.h"
#include "core/shape/repair/mesh_repair.h"
#include "objects/load_mesh.h"

namespace graspbench {
namespace {

Json VectorOrNull(const Eigen::Vector3d& v) {
  return v.allFinite() ? JsonVector(v) : Json(nullptr);
}

void AskForUnit(MeshReport& report) {
  for (MeshProblem& problem : report.problems) {
    if (problem.fault != MeshFault::kSize) continue;
    problem.text = fmt::format(
        "the mesh is {:.4g} long in the file's numbers; a thing to grasp measures {:.0f} mm to "
        "{:.0f} m, so they are neither metres nor millimetres. Scale it, or say which (--unit)",
        report.extent.maxCoeff(), MmFromM(kMinMeshExtent), kMaxMeshExtent);
  }
}

}  // namespace

std::optional<LengthUnit> InferLengthUnit(double largest_extent) {
  for (const LengthUnit unit : {LengthUnit::kM, LengthUnit::kMm}) {
    const double extent = largest_extent * MetresPer(unit);
    if (extent >= kMinMeshExtent && extent <= kMaxMeshExtent) return unit;
  }
  return std::nullopt;
}

CheckedMeshFile CheckMeshFile(const std::filesystem::path& path, std::optional<LengthUnit> unit,
                              PartsApart parts_apart) {
  TriMesh mesh = LoadMesh(path, unit.value_or(LengthUnit::kM));
  CheckedMeshFile file;
  if (!unit) {
    unit = InferLengthUnit(CalcBounds(mesh).sizes().maxCoeff());
    file.is_unit_inferred = unit.has_value();
    for (Eigen::Vector3d& p : mesh.vertices) p *= MetresPer(unit.value_or(LengthUnit::kM));
  }
  file.unit = unit.value_or(LengthUnit::kM);
  UsableMesh usable = MakeUsable(mesh, parts_apart);
  file.mesh = std::move(usable.mesh);
  file.actions = std::move(usable.actions);
  file.report = std::move(usable.report);
  if (!unit) AskForUnit(file.report);
  return file;
}

MeshFileRepair RepairMeshFile(const CheckedMeshFile& file,
                              const std::filesystem::path& repaired_path) {
  const MeshRepair repair = RepairMesh(file.mesh);
  MeshFileRepair result = {repair.actions, CheckMesh(repair.mesh)};
  result.is_written = !repair.actions.empty() && result.report.problems.empty();
  if (result.is_written) {
    WriteFileAtomically(repaired_path, FormatObj(repair.mesh, UnitsPerMetre(file.unit)));
  }
  return result;
}

Json FormatMeshReport(const MeshReport& report) {
  Json problems = Json::array();
  for (const MeshProblem& problem : report.problems) problems.push_back(problem.text);
  return Json{{"usable", report.problems.empty()},
              {"closed", report.is_closed},
              {"triangles", report.num_triangles},
              {"open_edges", report.num_open_edges},
              {"volume_m3", JsonNumber(report.volume)},
              {"centroid_m", VectorOrNull(report.centroid)},
              {"extent_m", VectorOrNull(report.extent)},
              {"problems", problems},
              {"warnings", report.warnings}};
}

}  // namespace graspbench
