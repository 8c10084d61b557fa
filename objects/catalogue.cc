#include "objects/catalogue.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <regex>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/files/kept.h"
#include "core/base/hash.h"
#include "core/base/text/yaml.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "core/base/whole_number.h"
#include "core/shape/repair/mesh_repair.h"
#include "core/shape/resting_pose.h"
#include "core/shape/synthetic_shapes.h"
#include "objects/load_mesh.h"
#include "objects/object_file.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

constexpr double kSizeTolerance = 1e-4;  // [m]

fs::path FindCatalogue() { return FindDataRoot() / "objects" / "catalogue"; }

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
  // Most objects say nothing of their surface but the friction.
  std::vector<double> surface;
  SurfaceMaterial copy = object.surface;
  copy.Visit([&](const char*, double& value, const KeyInfo&) { surface.push_back(value); });
  const bool is_friction_all =
      std::all_of(surface.begin() + 2, surface.end(), [](double v) { return std::isnan(v); });
  append(surface.data(), is_friction_all ? 2 : surface.size());
  if (object.approach != Approach::kAutomatic) bytes += RowOf(kApproaches, object.approach).name;
  if (object.compressible) {
    append(&object.compressible->force, 1);
    append(object.compressible->yield.data(), 9);
  }
  return CalcHashHex(bytes);
}

std::shared_ptr<const SignedDistanceField> LoadField(const TriMesh& mesh) {
  return SignedDistanceField::LoadOrBuild(mesh, FindCacheRoot() / "sdf");
}

/** @throws Error(kFormat) where the mesh does not have the size that is stated. */
void CheckSize(const GraspObject& object, const ObjectFile& file, const fs::path& path) {
  if ((object.size - file.size).cwiseAbs().maxCoeff() <= kSizeTolerance) return;
  const std::string key = file.compression ? "compressible.sight_m" : "size_m";
  throw Error(ErrorKind::kFormat, path.string() + ": " + key + " says " +
                                      FormatSizeInMm(file.size, 2) + " mm, but \"" + file.mesh +
                                      "\" measures " + FormatSizeInMm(object.size, 2) +
                                      " mm if its unit is " + NameOf(file.mesh_unit) +
                                      "; correct " + key + " or mesh_unit");
}

struct SyntheticId {
  int seed = 0;
  std::string grasp;
  int number = 0;
};

std::string Format(const SyntheticId& id) {
  return fmt::format("synthetic_{}_{}_{}", id.seed, id.grasp, id.number);
}

/** One id for each object: no leading zeros. */
std::optional<SyntheticId> ParseSynthetic(const std::string& text) {
  static const std::regex pattern("synthetic_([0-9]{1,10})_(g[1-6])_([0-9]{1,2})");
  std::smatch match;
  if (!std::regex_match(text, match, pattern)) return std::nullopt;
  const SyntheticId id = {ToWhole<int>(std::stod(match[1])), match[2], std::stoi(match[3])};
  return Format(id) == text ? std::optional(id) : std::nullopt;
}

std::shared_ptr<const GraspObject> MakeSynthetic(const SyntheticId& id, FieldUse field_use) {
  constexpr double kNoLimit = 1.0;  // of the width [m]: no hand decides it
  auto object = std::make_shared<GraspObject>(
      *MakeShapes(id.grasp, ShapeUse::kBenchmark, id.seed, id.number + 1, kNoLimit, {}).back());
  object->id = Format(id);
  object->name =
      fmt::format("{} {}-{}", object->name.substr(0, object->name.find(',')), id.grasp, id.number);
  object->content_hash = CalcContentHash(*object);
  if (field_use == FieldUse::kNow) object->field = LoadField(object->mesh);
  return object;
}

struct Solid {
  TriMesh mesh;  ///< as drawn, or mended
  Overlap overlap;
};

using PackedOverlap = std::array<double, 15>;

PackedOverlap Pack(const Overlap& overlap) {
  PackedOverlap packed = {overlap.volume, overlap.absolute_volume, overlap.inverted_volume};
  Eigen::Map<Eigen::Vector3d>(packed.data() + 3) = overlap.first;
  Eigen::Map<Eigen::Matrix3d>(packed.data() + 6) = overlap.second;
  return packed;
}

Overlap Unpack(const PackedOverlap& packed) {
  Overlap overlap = {packed[0], packed[1], packed[2]};
  overlap.first = Eigen::Map<const Eigen::Vector3d>(packed.data() + 3);
  overlap.second = Eigen::Map<const Eigen::Matrix3d>(packed.data() + 6);
  return overlap;
}

/** The mesh as simulation can use it. That one is usable as it is drawn is kept between runs.
@param name  of the mesh, as it begins the message.  @throws Error(kFormat) listing its problems. */
Solid MakeSolid(TriMesh drawn, PartsApart parts_apart, const std::string& name) {
  constexpr char kKind[] = "gbmesh01";
  const uint64_t key = CalcHash64(
      fmt::format("{} {}", program_sources(), static_cast<int>(parts_apart)), CalcMeshHash(drawn));
  const fs::path path = FindCacheRoot() / "meshes" / fmt::format("{:016x}", key);
  PackedOverlap packed;
  if (const auto kept = ReadKept(path, kKind, key); kept && kept->size() == sizeof packed) {
    std::memcpy(packed.data(), kept->data(), sizeof packed);
    return {std::move(drawn), Unpack(packed)};
  }
  UsableMesh usable = MakeUsable(drawn, parts_apart);
  if (!usable.report.problems.empty()) {
    throw Error(ErrorKind::kFormat,
                "the mesh " + name + " cannot be used:\n" + FormatProblems(usable.report));
  }
  if (usable.actions.empty()) {
    packed = Pack(usable.report.overlap);
    Keep(path, kKind, key, {reinterpret_cast<const char*>(packed.data()), sizeof packed});
  }
  return {std::move(usable.mesh), usable.report.overlap};
}

std::shared_ptr<const GraspObject> LoadFolder(const fs::path& folder, const std::string& id,
                                              FieldUse field_use) {
  const fs::path path = folder / "object.yaml";
  const ObjectFile file = LoadObjectFile(path);
  auto object = std::make_shared<GraspObject>();
  object->id = id;
  object->name = file.name;
  const fs::path mesh = folder / file.mesh;
  Solid solid = MakeSolid(LoadMesh(mesh, file.mesh_unit), PartsApartOf(file),
                          fmt::format("\"{}\" (unit {})", mesh.string(), NameOf(file.mesh_unit)));
  object->mesh = std::move(solid.mesh);
  const Overlap& overlap = solid.overlap;

  const Eigen::AlignedBox3d box = CalcBounds(object->mesh);
  for (Eigen::Vector3d& p : object->mesh.vertices) p -= box.center();
  object->size = box.sizes();
  if (file.size.allFinite()) CheckSize(*object, file, path);
  if (file.compression) {
    Compressibility& compressible = object->compressible.emplace();
    compressible.force = file.compression->force;
    compressible.yield = (0.5 * (file.size - file.compression->size_of_grasp)).asDiagonal();
    compressible.is_sight_guessed = file.compression->is_sight_guessed;
  }

  const double mass = std::isfinite(file.mass)
                          ? file.mass
                          : file.density * (CalcVolume(object->mesh) - overlap.volume);
  object->mass_properties = CalcSolidMassProperties(object->mesh, mass, overlap);
  if (file.p_OOcm.allFinite()) {
    if ((file.p_OOcm.cwiseAbs() - 0.5 * object->size).maxCoeff() > 0.0) {
      throw Error(ErrorKind::kRange,
                  path.string() + ": centre_of_mass_m lies outside the object, which measures " +
                      FormatSizeInMm(object->size, 2) +
                      " mm; it counts from the middle of the object");
    }
    object->mass_properties.p_OOcm = file.p_OOcm;
  }
  LayDown(*object);
  object->surface = file.surface;
  object->best_grasp = file.best_grasp;
  if (!file.grasp_order.empty()) object->grasp_order = file.grasp_order;
  object->approach = file.approach;
  object->colour = file.colour.cast<float>();
  object->content_hash = CalcContentHash(*object);
  if (field_use == FieldUse::kNow) object->field = LoadField(object->mesh);
  return object;
}

}  // namespace

std::string FormatSizeInMm(const Eigen::Vector3d& size, int decimals) {
  return fmt::format("{0:.{3}f} x {1:.{3}f} x {2:.{3}f}", MmFromM(size.x()), MmFromM(size.y()),
                     MmFromM(size.z()), decimals);
}

std::string DescribeCompression(const GraspObject& object) {
  if (!object.compressible) return "";
  return FormatSizeInMm(CalcSizeOfGrasp(object), 1) +
         fmt::format(" mm under {:g} N of each fingertip", object.compressible->force) +
         (object.compressible->is_sight_guessed ? "; the size at rest is a guess" : "");
}

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

bool ComesWithProgram(const std::string& object) {
  const std::vector<std::string> ids = ListObjects();
  return std::find(ids.begin(), ids.end(), object) != ids.end() || ParseSynthetic(object);
}

std::string ChangeSyntheticSeed(const std::string& id, int seed) {
  std::optional<SyntheticId> synthetic = ParseSynthetic(id);
  if (!synthetic) return id;
  synthetic->seed = seed;
  return Format(*synthetic);
}

std::shared_ptr<const GraspObject> LoadObject(const std::string& id_or_path, FieldUse field_use) {
  if (const auto id = ParseSynthetic(id_or_path)) return MakeSynthetic(*id, field_use);
  const std::vector<std::string> ids = ListObjects();
  if (std::find(ids.begin(), ids.end(), id_or_path) != ids.end()) {
    return LoadFolder(FindCatalogue() / id_or_path, id_or_path, field_use);
  }
  std::error_code status;
  fs::path path = fs::absolute(id_or_path, status).lexically_normal();
  if (path.filename() == "object.yaml" || !path.has_filename()) path = path.parent_path();
  if (fs::is_directory(path, status)) {
    return LoadFolder(path, path.filename().string(), field_use);
  }
  if (fs::exists(path, status)) {
    throw Error(ErrorKind::kUsage,
                "\"" + id_or_path +
                    "\" is a file; a mesh alone gives neither unit, mass nor friction. Put it into "
                    "a folder with an object.yaml (keys: name, mesh, mesh_unit, mass_kg, "
                    "friction_static, friction_dynamic) and give the folder");
  }
  throw Error(ErrorKind::kNotFound,
              "no object and no folder \"" + id_or_path + "\"" + SuggestNames(id_or_path, ids));
}

std::shared_ptr<const GraspObject> LoadMeshObject(const fs::path& path, double scale) {
  constexpr double kDensity = 1000.0;  // [kg/m^3]
  TriMesh drawn = LoadMesh(path, LengthUnit::kM);
  for (Eigen::Vector3d& p : drawn.vertices) p *= scale;
  Solid solid = MakeSolid(std::move(drawn), PartsApart::kMeant,
                          fmt::format("\"{}\" (in m, times {:g})", path.string(), scale));
  auto object = std::make_shared<GraspObject>();
  object->id = object->name = path.stem().string();
  object->mesh = std::move(solid.mesh);
  const Overlap& overlap = solid.overlap;
  object->mass_properties = CalcSolidMassProperties(
      object->mesh, kDensity * (CalcVolume(object->mesh) - overlap.volume), overlap);
  object->size = CalcBounds(object->mesh).sizes();
  object->surface.friction_static = object->surface.friction_dynamic = 0.0;
  object->content_hash = CalcContentHash(*object);
  object->field = LoadField(object->mesh);
  return object;
}

std::shared_ptr<const GraspObject> CompleteObject(
    const std::shared_ptr<const GraspObject>& object) {
  if (object->field) return object;
  auto complete = std::make_shared<GraspObject>(*object);
  complete->field = LoadField(complete->mesh);
  return complete;
}

}  // namespace graspbench
