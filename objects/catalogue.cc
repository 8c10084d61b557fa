#include "objects/catalogue.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/hash.h"
#include "core/base/units.h"
#include "core/base/yaml.h"
#include "core/shape/mesh_repair.h"
#include "objects/load_mesh.h"
#include "objects/object_file.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

constexpr double kSizeTolerance = 1e-4;  // [m]

fs::path FindCatalogue() { return FindDataRoot() / "objects" / "catalogue"; }

Eigen::AlignedBox3d FindBox(const TriMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  return box;
}

std::string FormatSize(const Eigen::Vector3d& size) {
  char text[96];
  std::snprintf(text, sizeof text, "%.2f x %.2f x %.2f mm", MmFromM(size.x()), MmFromM(size.y()),
                MmFromM(size.z()));
  return text;
}

// Of everything that the simulation depends on; names and colours may change.
std::string CalcContentHash(const GraspObject& object) {
  std::string bytes;
  const auto append = [&](const double* values, size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(double));
  };
  for (const Eigen::Vector3d& p : object.mesh.vertices) append(p.data(), 3);
  for (const Eigen::Vector3i& t : object.mesh.triangles) {
    bytes.append(reinterpret_cast<const char*>(t.data()), 3 * sizeof(int));
  }
  append(&object.mass_properties.mass, 1);
  append(object.mass_properties.p_OOcm.data(), 3);
  append(object.mass_properties.I_OOcm.data(), 9);
  append(&object.friction_static, 1);
  append(&object.friction_dynamic, 1);
  return CalcHashHex(bytes);
}

std::shared_ptr<const GraspObject> LoadFolder(const fs::path& folder, const std::string& id) {
  const fs::path path = folder / "object.yaml";
  const ObjectFile file = LoadObjectFile(path);
  auto object = std::make_shared<GraspObject>();
  object->id = id;
  object->name = file.name;
  UsableMesh usable = MakeUsable(LoadMesh(folder / file.mesh, file.mesh_unit));
  if (!usable.report.problems.empty()) {
    throw Error(ErrorKind::kFormat, "the mesh \"" + (folder / file.mesh).string() + "\" (unit " +
                                        NameOf(file.mesh_unit) + ") cannot be used:\n" +
                                        FormatProblems(usable.report));
  }
  object->mesh = std::move(usable.mesh);
  const Overlap& overlap = usable.report.overlap;

  const Eigen::AlignedBox3d box = FindBox(object->mesh);
  for (Eigen::Vector3d& p : object->mesh.vertices) p -= box.center();
  object->size = box.sizes();
  if (file.size.allFinite() && (object->size - file.size).cwiseAbs().maxCoeff() > kSizeTolerance) {
    throw Error(ErrorKind::kFormat, path.string() + ": size_m says " + FormatSize(file.size) +
                                        ", but \"" + file.mesh + "\" measures " +
                                        FormatSize(object->size) + " if its unit is " +
                                        NameOf(file.mesh_unit) + "; correct size_m or mesh_unit");
  }
  object->size_of_sight = file.size_of_sight.allFinite() ? file.size_of_sight : object->size;

  const double mass = std::isfinite(file.mass)
                          ? file.mass
                          : file.density * (CalcVolume(object->mesh) - overlap.volume);
  object->mass_properties = CalcSolidMassProperties(object->mesh, mass, overlap);
  if (file.p_OOcm.allFinite()) {
    if ((file.p_OOcm.cwiseAbs() - 0.5 * object->size).maxCoeff() > 0.0) {
      throw Error(ErrorKind::kRange,
                  path.string() + ": centre_of_mass_m lies outside the object, which measures " +
                      FormatSize(object->size) + "; it counts from the middle of the object");
    }
    object->mass_properties.p_OOcm = file.p_OOcm;
  }
  object->friction_static = file.friction_static;
  object->friction_dynamic = file.friction_dynamic;
  object->best_grasp = file.best_grasp;
  if (!file.grasp_order.empty()) object->grasp_order = file.grasp_order;
  object->colour = file.colour.cast<float>();
  object->content_hash = CalcContentHash(*object);
  object->field = SignedDistanceField::LoadOrBuild(object->mesh, FindCacheRoot() / "sdf");
  return object;
}

}  // namespace

std::vector<std::string> ListObjects() {
  const fs::path path = FindCatalogue() / "catalogue.yaml";
  Diagnostics problems;
  std::vector<std::string> ids;
  YamlMap map(LoadYaml(path, problems), path.string(), "catalogue", problems);
  map.Read("objects", ids);
  map.FinishKnownKeys();
  problems.ThrowIfErrors(ErrorKind::kFormat, "the catalogue cannot be used");
  return ids;
}

std::shared_ptr<const GraspObject> LoadObject(const std::string& id_or_path) {
  const std::vector<std::string> ids = ListObjects();
  if (std::find(ids.begin(), ids.end(), id_or_path) != ids.end()) {
    return LoadFolder(FindCatalogue() / id_or_path, id_or_path);
  }
  std::error_code status;
  fs::path path = fs::absolute(id_or_path, status).lexically_normal();
  if (path.filename() == "object.yaml" || !path.has_filename()) path = path.parent_path();
  if (fs::is_directory(path, status)) return LoadFolder(path, path.filename().string());
  if (fs::exists(path, status)) {
    throw Error(ErrorKind::kUsage,
                "\"" + id_or_path +
                    "\" is a file; a mesh alone tells neither unit, mass nor friction. Put it into "
                    "a folder with an object.yaml (keys: name, mesh, mesh_unit, mass_kg, "
                    "friction_static, friction_dynamic) and give the folder");
  }
  throw Error(ErrorKind::kNotFound,
              "no object and no folder \"" + id_or_path + "\"" + SuggestNames(id_or_path, ids));
}

}  // namespace graspbench
