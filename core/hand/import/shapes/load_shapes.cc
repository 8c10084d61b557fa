#include "core/hand/import/shapes/load_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/shapes/find_mesh.h"
#include "core/hand/import/shapes/fit_capsules.h"
#include "core/hand/import/shapes/shape_distance.h"
#include "core/shape/primitives.h"
#include "core/shape/repair/mesh_repair.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kSmallestPart = 0.0003;  // [m]; a part of a hand is larger
constexpr double kSmallestShape = 1e-5;   // [m]; smaller shapes mean that the hand is in another
                                          // unit
constexpr double kMostElongated = 25.0;   // of a shape; the loader refuses 30
constexpr double kLeastTolerance = 0.0005, kRelativeTolerance = 0.02;
constexpr int kMostCapsules = 16;

/** Formats in which a mesh may also exist. */
const std::vector<std::string> kMeshEndings = {".obj", ".stl", ".glb", ".dae", ".ply"};

/** A scale beyond this is not a conversion of lengths to metres. */
constexpr double kMostScale = 10.0;

double CalcLargestExtent(const TriMesh& mesh) {
  return mesh.vertices.empty() ? 0.0 : CalcBounds(mesh).sizes().maxCoeff();
}

/** Removes a factor that makes the part larger than any of a hand, as some programs export it. */
Vector3d FindUsefulScale(const Vector3d& scale, const TriMesh& mesh) {
  const double largest = scale.cwiseAbs().maxCoeff();
  const bool is_absurd = largest > kMostScale && largest * CalcLargestExtent(mesh) > kLargestPart;
  return is_absurd ? Vector3d(scale / largest) : scale;
}

/** Formats "Tried: a; b; c and 9 more". */
std::string ListTried(const FoundMesh& found) {
  constexpr size_t kMost = 3;
  std::string text = "Tried: ";
  for (size_t i = 0; i < std::min(kMost, found.tried.size()); ++i) {
    text += (i > 0 ? "; " : "") + found.tried[i];
  }
  if (found.tried.size() > kMost) {
    text += " and " + std::to_string(found.tried.size() - kMost) + " more";
  }
  return text;
}

/** Surface of the shape in the description. */
TriMesh MakeSolid(ForeignShape::Kind kind, const CollisionShape& solid) {
  const double r = 0.5 * solid.size.x(), h = 0.5 * solid.size.z();
  TriMesh mesh;
  if (kind == ForeignShape::Kind::kBox) {
    mesh = MakeRoundedBox(solid.size, 0.0);
  } else if (kind == ForeignShape::Kind::kCylinder) {
    mesh = MakeRevolution({{0.0, -h}, {r, -h}, {r, h}, {0.0, h}});
  } else {
    const Vector3d end(0.0, 0.0, std::max(0.0, h - r));
    mesh = MakeTaperedCapsule(-end, r, end, r);
  }
  for (Vector3d& p : mesh.vertices) p = solid.X_LS * p;
  return mesh;
}

}  // namespace

void ShapeLoader::Report(Severity severity, int line, const std::string& text) {
  if (severity == Severity::kError) {
    problems_.Fail(source_.file, line, text);
  } else {
    problems_.Warn(source_.file, line, text);
  }
}

TriMesh ShapeLoader::ReadFile(const std::filesystem::path& path, int line, const std::string& where,
                              Severity severity) {
  const auto known = meshes_.find(path);
  if (known != meshes_.end()) return known->second;
  TriMesh mesh;
  try {
    mesh = source_.load_mesh(path);
    const bool is_finite = std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                                       [](const Vector3d& p) { return p.allFinite(); });
    if (mesh.triangles.empty() || !is_finite || CalcLargestExtent(mesh) == 0.0) {
      mesh = {};
      Report(severity, line,
             where + ": mesh \"" + path.string() +
                 (is_finite ? "\" has no triangle" : "\" has infinite coordinates"));
    }
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kEnvironment) throw;  // not a fault of the mesh
    Report(severity, line, where + ": " + error.what());
  }
  meshes_.emplace(path, mesh);
  return mesh;
}

FoundMesh ShapeLoader::Find(const ForeignShape& shape) const {
  if (shape.inline_mesh) return {source_.file, false, {}};
  return FindMesh(shape.mesh, source_.folder, source_.package_path, kMeshEndings);
}

TriMesh ShapeLoader::LoadMesh(const ForeignShape& shape, const std::string& where,
                              Severity severity) {
  const FoundMesh found = Find(shape);
  if (found.path.empty()) {
    if (are_all_missing_) return {};
    Report(severity, shape.line,
           where + ": mesh not found: \"" + shape.mesh +
               "\"; give the folder of its package with --package-path. " + ListTried(found));
    return {};
  }
  if (found.is_other) {
    problems_.Warn(
        source_.file, shape.line,
        where + ": mesh \"" + shape.mesh + "\" not found; taken instead: " + found.path.string());
  }
  const bool was_read = !shape.inline_mesh && meshes_.count(found.path) > 0;
  TriMesh mesh =
      shape.inline_mesh ? *shape.inline_mesh : ReadFile(found.path, shape.line, where, severity);
  if (mesh.triangles.empty()) {
    if (severity == Severity::kError && was_read) {  // reported as a warning, for a visual
      Report(severity, shape.line,
             where + ": mesh \"" + shape.mesh +
                 "\" cannot be used, and nothing else of this link can be touched");
    }
    return {};
  }
  const Vector3d scale = FindUsefulScale(shape.scale, mesh);
  if (scale != shape.scale) {
    const double factor = shape.scale.cwiseAbs().maxCoeff();
    problems_.Warn(source_.file, shape.line,
                   where + ": a scale of " + FormatSignificant(factor, 3) + " makes mesh \"" +
                       shape.mesh + "\" " + FormatSignificant(factor * CalcLargestExtent(mesh), 3) +
                       " m long, which is no part of a hand; taken without it");
  }
  for (Vector3d& p : mesh.vertices) p = p.cwiseProduct(scale);
  const double extent = CalcLargestExtent(mesh);
  double unit = source_.mesh_unit > 0.0 ? source_.mesh_unit : 1.0;
  const double typical_unit = FindTypicalUnit(found.path);
  if (source_.mesh_unit == 0.0 && typical_unit != 1.0) {
    unit = typical_unit;
  } else if (source_.mesh_unit == 0.0) {
    if (extent > kLargestPart && extent <= kLargestPart / large_unit_) unit = large_unit_;
    if (extent < kSmallestPart) unit = MmFromM(1.0);
  }
  const double size = extent * unit;
  if (size > kLargestPart || size < kSmallestPart) {
    Report(severity, shape.line,
           where + ": mesh \"" + shape.mesh + "\" is " + FormatSignificant(size, 3) +
               " m across, which is no part of a hand" +
               (source_.mesh_unit > 0.0 ? "; another --mesh-unit?"
                                        : " in metres, centimetres or millimetres; say its unit "
                                          "with --mesh-unit"));
    return {};
  }
  if (unit != 1.0 && unit != typical_unit && source_.mesh_unit == 0.0) {
    const std::string told = unit > 1.0     ? "scale counts twice"
                             : unit == 0.01 ? "unit is the centimetre"
                             : unit > 0.01  ? "unit is the inch"
                                            : "unit is the millimetre";
    problems_.Warn(source_.file, shape.line,
                   where + ": mesh \"" + shape.mesh + "\" would be " +
                       FormatSignificant(extent, 3) + " m across; taken as " +
                       FormatSignificant(MmFromM(size), 3) + " mm, so its " + told +
                       (unit < 1.0 ? why_ : ""));
  }
  for (Vector3d& p : mesh.vertices) p = shape.X_LS * Vector3d(unit * p);
  if (shape.scale.prod() < 0.0) {  // mirrored, as a left hand from a right one
    for (Eigen::Vector3i& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

/** Largest side of a shape's mesh, with its scale; 0 if it cannot be read, which is reported when
it is loaded. */
double ShapeLoader::CalcMeshExtent(const ForeignShape& shape) {
  if (shape.kind != ForeignShape::Kind::kMesh) return 0.0;
  if (shape.inline_mesh) {
    return shape.scale.cwiseAbs().maxCoeff() * CalcLargestExtent(*shape.inline_mesh);
  }
  const FoundMesh found = Find(shape);
  if (found.path.empty()) return 0.0;
  if (meshes_.count(found.path) == 0) {
    Diagnostics unread;
    ShapeLoader quiet(source_, unread);
    const TriMesh mesh = quiet.ReadFile(found.path, 0, "", Severity::kWarning);
    if (mesh.triangles.empty()) return 0.0;
    meshes_.emplace(found.path, mesh);
  }
  const TriMesh& mesh = meshes_.at(found.path);
  return FindUsefulScale(shape.scale, mesh).cwiseAbs().maxCoeff() * CalcLargestExtent(mesh);
}

bool ShapeLoader::LacksMesh(const ForeignLink& link) const {
  return std::any_of(link.collisions.begin(), link.collisions.end(), [&](const auto& shape) {
    return shape.kind == ForeignShape::Kind::kMesh && Find(shape).path.empty();
  });
}

bool ShapeLoader::CheckMeshes(const ForeignHand& hand) {
  std::set<std::string> addresses;
  bool is_needed = false;  // something would have no contact shape
  const ForeignShape* first = nullptr;
  for (const ForeignLink& link : hand.links) {
    bool touches = link.is_decoration;  // then no contact is needed
    for (const auto* shapes : {&link.collisions, &link.visuals}) {
      for (const ForeignShape& shape : *shapes) {
        const bool is_mesh = shape.kind == ForeignShape::Kind::kMesh;
        touches = touches || (shapes == &link.collisions && !is_mesh);
        if (!is_mesh) continue;
        if (!Find(shape).path.empty()) return true;
        if (!first) first = &shape;
        addresses.insert(shape.mesh);
        is_needed = is_needed || !touches;
      }
    }
  }
  if (addresses.size() < 2) return true;
  are_all_missing_ = true;
  Report(is_needed ? Severity::kError : Severity::kWarning, first->line,
         "none of the " + std::to_string(addresses.size()) + " meshes was found, the first is \"" +
             first->mesh + "\"; give the folder of their package with --package-path. " +
             ListTried(FindMesh(first->mesh, source_.folder, source_.package_path, kMeshEndings)));
  return !is_needed;
}

TriMesh ShapeLoader::TurnOutwards(const TriMesh& mesh, const std::string& name, int line,
                                  const std::string& where) {
  MeshRepair repair = FaceOutwards(mesh);
  for (const std::string& action : repair.actions) {
    const std::string told = where + ": mesh \"" + name + "\": " + action;
    if (turned_.insert(told).second) Report(Severity::kWarning, line, told);
  }
  return std::move(repair.mesh);
}

void ShapeLoader::AddMesh(const TriMesh& mesh, LoadedShapes& loaded) {
  const double tolerance = std::max(kLeastTolerance, kRelativeTolerance * CalcLargestExtent(mesh));
  loaded.solids.push_back(mesh);
  for (const FittedCapsule& capsule : FitCapsules(mesh, tolerance, kMostCapsules).capsules) {
    loaded.collisions.push_back(MakeCapsuleShape(capsule));
    loaded.collisions.back().is_fitted = true;
  }
}

namespace {

/** Thickens a shape to what the loader requires. */
Vector3d Thicken(const Vector3d& size, const std::string& file, int line, const std::string& where,
                 Diagnostics& problems) {
  const double longest = size.maxCoeff();
  if (longest <= kMostElongated * size.minCoeff()) return size;
  problems.Warn(file, line,
                where + ": " + FormatSignificant(longest / size.minCoeff(), 3) +
                    " times as long as thick; made thicker, a 25th of its length");
  return size.cwiseMax(longest / kMostElongated);
}

}  // namespace

void ShapeLoader::AddSolid(const ForeignShape& shape, const std::string& where,
                           LoadedShapes& loaded) {
  CollisionShape& solid = loaded.collisions.emplace_back();
  solid.X_LS = shape.X_LS;
  solid.size = shape.size;
  if (shape.kind == ForeignShape::Kind::kBox) solid.kind = CollisionShape::Kind::kBox;
  if (shape.kind == ForeignShape::Kind::kCylinder || shape.kind == ForeignShape::Kind::kCapsule) {
    solid.kind = CollisionShape::Kind::kCylinder;
  }
  const double longest = solid.size.maxCoeff();
  if (longest > kLargestPart || longest < kSmallestShape) {
    problems_.Warn(
        source_.file, shape.line,
        where + " is " + FormatSignificant(longest, 3) +
            " m across, which is no part of a hand (descriptions are in metres); left out");
    loaded.collisions.pop_back();
    return;
  }
  solid.size = Thicken(solid.size, source_.file, shape.line, where, problems_);
  // Contact treats a disc as a box.
  solid.is_fitted =
      solid.kind == CollisionShape::Kind::kCylinder && solid.size.z() < solid.size.x();
  loaded.solids.push_back(MakeSolid(shape.kind, solid));
}

namespace {

TriMesh MakeEllipsoid(const ForeignShape& shape) {
  TriMesh mesh = MakeSphere(0.5);
  for (Vector3d& p : mesh.vertices) p = shape.X_LS * Vector3d(p.cwiseProduct(shape.size));
  return mesh;
}

}  // namespace

bool ShapeLoader::CheckCount(const ForeignLink& link, size_t count) {
  if (count <= kMostTouchingShapes) return true;
  problems_.Fail(source_.file, link.line,
                 "link \"" + link.name + "\" would touch with " +
                     FormatCount(static_cast<int64_t>(count), "shape") + "; at most " +
                     std::to_string(kMostTouchingShapes) +
                     " can be used; join them into fewer meshes");
  return false;
}

LoadedShapes ShapeLoader::Load(const ForeignLink& link, bool is_palm) {
  LoadedShapes loaded;
  if (!CheckCount(link, link.collisions.size())) return loaded;
  std::vector<TriMesh> seen;  // surfaces of the visuals
  const std::string where = "link \"" + link.name + "\"";
  // A visual may be missing unless the palm uses it for contact.
  const bool must_be_seen = is_palm && link.collisions.empty() && !link.is_decoration;
  for (const ForeignShape& shape : link.visuals) {
    ImportedVisual visual;
    if (shape.colour) visual.colour = *shape.colour;
    if (shape.kind == ForeignShape::Kind::kMesh) {
      visual.mesh =
          LoadMesh(shape, where + ", visual", must_be_seen ? Severity::kError : Severity::kWarning);
      if (visual.mesh.triangles.empty()) continue;
      std::string address = shape.mesh;
      std::replace(address.begin(), address.end(), '\\', '/');
      visual.name = std::filesystem::path(address).stem().string();
    } else if (shape.kind == ForeignShape::Kind::kEllipsoid) {
      visual.mesh = MakeEllipsoid(shape);
      visual.name = "ellipsoid";
    } else {
      LoadedShapes one;
      AddSolid(shape, where + ", visual", one);
      if (one.collisions.empty()) continue;
      visual.solid = one.collisions.front();
      seen.resize(loaded.visuals.size());
      seen.push_back(one.solids.front());
    }
    loaded.visuals.push_back(visual);
  }
  // Visuals may be missing; collision shapes may not, unless visuals replace them.
  const Severity severity = loaded.visuals.empty() ? Severity::kError : Severity::kWarning;
  for (const ForeignShape& shape : link.collisions) {
    if (shape.kind == ForeignShape::Kind::kEllipsoid) {
      ForeignShape solid = shape;
      solid.size = Thicken(shape.size, source_.file, shape.line, where + ", collision", problems_);
      AddMesh(MakeEllipsoid(solid), loaded);
      continue;
    }
    if (shape.kind != ForeignShape::Kind::kMesh) {
      AddSolid(shape, where + ", collision", loaded);
      continue;
    }
    const TriMesh mesh = LoadMesh(shape, where + ", collision", severity);
    if (!mesh.triangles.empty()) AddMesh(TurnOutwards(mesh, shape.mesh, shape.line, where), loaded);
  }
  if (!loaded.collisions.empty() || loaded.visuals.empty() || link.is_decoration) return loaded;
  if (!CheckCount(link, loaded.visuals.size())) return loaded;
  loaded.notes.push_back("guess: it touches with its picture");
  problems_.Warn(source_.file, link.line,
                 where + " has no collision shape that can be used; it touches with its picture");
  for (size_t k = 0; k < loaded.visuals.size(); ++k) {
    const ImportedVisual& visual = loaded.visuals[k];
    if (visual.mesh.triangles.empty()) {
      loaded.collisions.push_back(visual.solid);
      loaded.solids.push_back(seen[k]);
    } else {
      AddMesh(TurnOutwards(visual.mesh, visual.name, link.line, where), loaded);
    }
  }
  return loaded;
}

std::set<std::filesystem::path> ShapeLoader::ListFiles() const {
  std::set<std::filesystem::path> paths;
  for (const auto& [path, mesh] : meshes_) paths.insert(path);
  return paths;
}

void ShapeLoader::Weigh(ForeignLink& link) {
  if (link.inertia || link.weights.empty()) return;
  Diagnostics told;  // reported when the shapes were loaded
  ShapeLoader quiet(source_, told);
  quiet.large_unit_ = large_unit_;
  quiet.typical_units_ = typical_units_;
  quiet.meshes_.swap(meshes_);
  MassProperties sum;
  for (const ForeignShape& shape : link.weights) {
    const bool is_mesh = shape.kind == ForeignShape::Kind::kMesh;
    TriMesh mesh = is_mesh ? quiet.LoadMesh(shape, "", Severity::kWarning) : TriMesh();
    if (!mesh.triangles.empty())
      mesh = TurnOutwards(mesh, shape.mesh, shape.line, "link \"" + link.name + "\"");
    sum = AddMass(sum, CalcGeomMass(shape, mesh));
  }
  meshes_.swap(quiet.meshes_);
  if (sum.mass <= 0.0) return;
  ForeignInertia& inertia = link.inertia.emplace();
  inertia.mass = sum.mass;
  inertia.X_LI = MakePose(sum.p_OOcm);
  inertia.I_I = sum.I_OOcm;
  inertia.line = link.line;
  inertia.is_of_geoms = true;
}

}  // namespace graspbench
