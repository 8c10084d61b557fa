#include "core/hand/import/shapes/load_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/shapes/find_mesh.h"
#include "core/hand/import/shapes/fit_capsules.h"
#include "core/hand/import/shapes/geom_mass.h"
#include "core/hand/import/shapes/length_unit_guess.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** A part of a hand is larger than the one and smaller than the other [m]. */
constexpr double kSmallestPart = 0.0003, kLargestPart = 2.0;
constexpr double kSmallestShape = 1e-5;  // [m]; a hand of such shapes is one in another unit
constexpr double kMostElongated = 25.0;  // of a shape; the loader refuses 30
constexpr double kLeastTolerance = 0.0005, kRelativeTolerance = 0.02;
constexpr int kMostCapsules = 16;

/** Of formats in which a mesh may lie there as well. */
const std::vector<std::string> kMeshEndings = {".obj", ".stl", ".glb", ".dae", ".ply"};
constexpr double kShortestLink = 0.002;  // [m] that tells a scale
constexpr double kMillimetreRatio =
    300.0;  // of a mesh to its link, from which it is in millimetres

/** A scale beyond is no conversion of a length to metres. */
constexpr double kMostScale = 10.0;

/** Of a mesh to its link: below it, both are of one length when it is in inches. */
constexpr double kMostInches = 70.0;

double CalcLargestExtent(const TriMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : mesh.vertices) box.extend(p);
  return mesh.vertices.empty() ? 0.0 : box.sizes().maxCoeff();
}

/** Without a factor that makes the part larger than any of a hand: programs export one. */
Vector3d FindUsefulScale(const Vector3d& scale, const TriMesh& mesh) {
  const double largest = scale.cwiseAbs().maxCoeff();
  const bool is_absurd = largest > kMostScale && largest * CalcLargestExtent(mesh) > kLargestPart;
  return is_absurd ? Vector3d(scale / largest) : scale;
}

CollisionShape MakeCapsuleShape(const FittedCapsule& capsule) {
  CollisionShape shape;
  const Vector3d axis = capsule.p_B - capsule.p_A;
  shape.X_LS.translation() = 0.5 * (capsule.p_A + capsule.p_B);
  shape.size.setConstant(2.0 * capsule.radius);
  if (axis.norm() == 0.0) return shape;
  shape.kind = CollisionShape::Kind::kCylinder;
  shape.size.z() += axis.norm();
  shape.X_LS.linear() =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix();
  return shape;
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
    Report(severity, line, where + ": " + error.what());
  }
  meshes_.emplace(path, mesh);
  return mesh;
}

TriMesh ShapeLoader::LoadMesh(const ForeignShape& shape, const std::string& where,
                              Severity severity) {
  const FoundMesh found = FindMesh(shape.mesh, source_.folder, source_.package_path, kMeshEndings);
  if (found.path.empty()) {
    std::string tried;
    for (const std::string& path : found.tried) tried += "\n    " + path;
    Report(severity, shape.line,
           where + ": mesh not found: \"" + shape.mesh +
               "\"; give the folder of its package with --package-path. Tried:" + tried);
    return {};
  }
  if (found.is_other) {
    problems_.Warn(
        source_.file, shape.line,
        where + ": mesh \"" + shape.mesh + "\" not found; taken instead: " + found.path.string());
  }
  TriMesh mesh = ReadFile(found.path, shape.line, where, severity);
  if (mesh.triangles.empty()) return {};
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
  if (source_.mesh_unit == 0.0) {
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
  if (unit != 1.0 && source_.mesh_unit == 0.0) {
    const std::string told = unit > 1.0     ? "scale counts twice"
                             : unit == 0.01 ? "unit is the centimetre"
                                            : "unit is the millimetre";
    problems_.Warn(source_.file, shape.line,
                   where + ": mesh \"" + shape.mesh + "\" would be " +
                       FormatSignificant(extent, 3) + " m across; taken as " +
                       FormatSignificant(MmFromM(size), 3) + " mm, so its " + told +
                       (unit < 1.0 ? why_ : ""));
  }
  for (Vector3d& p : mesh.vertices) p = shape.X_LS * Vector3d(unit * p);
  if (shape.scale.prod() < 0.0) {  // mirrored: a left hand from a right one
    for (Eigen::Vector3i& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  return mesh;
}

void ShapeLoader::InferMeshUnit(const ForeignHand& hand) {
  if (source_.mesh_unit > 0.0) return;
  const std::vector<double> lengths = CalcLinkLengths(hand);
  std::vector<double> ratios;
  for (size_t i = 0; i < hand.links.size(); ++i) {
    double largest = 0.0;
    for (const auto* shapes : {&hand.links[i].visuals, &hand.links[i].collisions}) {
      for (const ForeignShape& shape : *shapes) {
        if (shape.kind != ForeignShape::Kind::kMesh) continue;
        const FoundMesh found =
            FindMesh(shape.mesh, source_.folder, source_.package_path, kMeshEndings);
        if (found.path.empty()) continue;
        Diagnostics unread;  // told when the mesh is loaded
        ShapeLoader quiet(source_, unread);
        const TriMesh mesh = meshes_.count(found.path) != 0
                                 ? meshes_.at(found.path)
                                 : quiet.ReadFile(found.path, 0, "", Severity::kWarning);
        if (mesh.triangles.empty()) continue;
        meshes_.emplace(found.path, mesh);
        const Vector3d scale = FindUsefulScale(shape.scale, mesh);
        largest = std::max(largest, scale.cwiseAbs().maxCoeff() * CalcLargestExtent(mesh));
      }
    }
    if (largest > kLargestPart && lengths[i] > kShortestLink) {
      ratios.push_back(largest / lengths[i]);
    }
  }
  if (ratios.empty()) return;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  if (*middle < kMillimetreRatio) large_unit_ = 0.01;
  why_ = ": meshes are " + FormatSignificant(*middle, 2) + " times as long as their links; " +
         (*middle < kMostInches ? "inches, whose meshes are 39 times as long, need --mesh-unit in"
                                : "--mesh-unit says otherwise");
}

void ShapeLoader::AddMesh(const TriMesh& mesh, const std::string& where, int line,
                          LoadedShapes& loaded) {
  const double extent = CalcLargestExtent(mesh);
  const double tolerance = std::max(kLeastTolerance, kRelativeTolerance * extent);
  const CapsuleFit fit = FitCapsules(mesh, tolerance, kMostCapsules);
  for (const FittedCapsule& capsule : fit.capsules) {
    loaded.collisions.push_back(MakeCapsuleShape(capsule));
  }
  loaded.notes.push_back(FormatCount(static_cast<int64_t>(fit.capsules.size()), "ball or capsule",
                                     "balls and capsules") +
                         " for a mesh of " + FormatFixed(MmFromM(extent), 1) +
                         " mm: " + FormatFixed(MmFromM(fit.rms_error), 2) +
                         " mm root mean square from its surface, 95 % within " +
                         FormatFixed(MmFromM(fit.largest_error), 2) + " mm");
  if (fit.largest_error > 2.0 * tolerance) {
    problems_.Warn(source_.file, line,
                   where + ": " + loaded.notes.back() + "; not near: look at it");
  }
}

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
  if (longest <= kMostElongated * solid.size.minCoeff()) return;
  problems_.Warn(source_.file, shape.line,
                 where + ": " + FormatSignificant(longest / solid.size.minCoeff(), 3) +
                     " times as long as thick; made thicker, a 25th of its length");
  solid.size = solid.size.cwiseMax(longest / kMostElongated);
}

namespace {

TriMesh MakeEllipsoid(const ForeignShape& shape) {
  TriMesh mesh = MakeSphere(0.5);
  for (Vector3d& p : mesh.vertices) p = shape.X_LS * Vector3d(p.cwiseProduct(shape.size));
  return mesh;
}

}  // namespace

LoadedShapes ShapeLoader::Load(const ForeignLink& link) {
  LoadedShapes loaded;
  const std::string where = "link \"" + link.name + "\"";
  for (const ForeignShape& shape : link.visuals) {
    ImportedVisual visual;
    if (shape.colour) visual.colour = *shape.colour;
    if (shape.kind == ForeignShape::Kind::kMesh) {
      visual.mesh = LoadMesh(shape, where + ", visual", Severity::kWarning);
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
    }
    loaded.visuals.push_back(visual);
  }
  // What cannot be seen may be missing; what touches may not, unless the pictures tell its shape.
  const Severity severity = loaded.visuals.empty() ? Severity::kError : Severity::kWarning;
  for (const ForeignShape& shape : link.collisions) {
    if (shape.kind == ForeignShape::Kind::kEllipsoid) {
      AddMesh(MakeEllipsoid(shape), where + ", collision", shape.line, loaded);
      continue;
    }
    if (shape.kind != ForeignShape::Kind::kMesh) {
      AddSolid(shape, where + ", collision", loaded);
      continue;
    }
    const TriMesh mesh = LoadMesh(shape, where + ", collision", severity);
    if (!mesh.triangles.empty()) AddMesh(mesh, where + ", collision", shape.line, loaded);
  }
  if (!loaded.collisions.empty() || loaded.visuals.empty()) return loaded;
  loaded.notes.push_back("guess: it touches with its picture");
  problems_.Warn(source_.file, link.line,
                 where + " has no collision shape that can be used; it touches with its picture");
  for (const ImportedVisual& visual : loaded.visuals) {
    if (visual.mesh.triangles.empty()) {
      loaded.collisions.push_back(visual.solid);
    } else {
      AddMesh(visual.mesh, where + ", visual", link.line, loaded);
    }
  }
  return loaded;
}

void ShapeLoader::Weigh(ForeignLink& link) {
  if (link.inertia || link.weights.empty()) return;
  Diagnostics told;  // when the shapes were loaded
  ShapeLoader quiet(source_, told);
  quiet.large_unit_ = large_unit_;
  quiet.meshes_.swap(meshes_);
  MassProperties sum;
  for (const ForeignShape& shape : link.weights) {
    const bool is_mesh = shape.kind == ForeignShape::Kind::kMesh;
    const TriMesh mesh = is_mesh ? quiet.LoadMesh(shape, "", Severity::kWarning) : TriMesh();
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
