#pragma once
/** @file
The shapes of a foreign link as the project has them: balls, cylinders and boxes to touch with,
closed or open meshes to look at. */

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/hand/contact_shape.h"
#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/shapes/find_mesh.h"
#include "core/hand/import/shapes/pack_balls.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

/** A part of a hand is smaller [m]. */
inline constexpr double kLargestPart = 2.0;
/** Shapes that a link touches with; the time to measure it grows with them. */
inline constexpr size_t kMostTouchingShapes = 100;

/** Reads a mesh file as it stands, one unit of it a metre. @throws Error. */
using MeshLoader = std::function<TriMesh(const std::filesystem::path&)>;

struct HandSource {
  std::string file;              ///< the description, for messages
  std::filesystem::path folder;  ///< where it lies
  std::vector<std::filesystem::path> package_path;
  MeshLoader load_mesh;
  std::optional<Eigen::Vector3d> palm_normal;  ///< in the palm's frame; nothing: guessed
  double unit = 0.0;                           ///< of the description's lengths [m]; 0: inferred
  double mesh_unit = 0.0;                      ///< of its mesh files [m]; 0: inferred
  bool accepts_coarse_contact = false;  ///< also where contact is 5 mm off at the palm or a tip
  std::optional<bool> in_degrees;       ///< limits of a URDF, angles of a MuJoCo model
  /** Points on a link that balls are to cover; fewer cover it coarser and sooner. 0: contact stays
  as the checks have it (fit_capsules.h), unmeasured. */
  int num_cover_points = kNumCoverPoints;
};

struct ImportedVisual {
  CollisionShape solid;  ///< of a visual without mesh
  TriMesh mesh;          ///< in the link's frame [m]; empty: `solid`
  std::string name;      ///< of the mesh's file, without folder and ending
  Eigen::Vector3d colour = Eigen::Vector3d::Constant(0.6);  ///< sRGB
};

struct LoadedShapes {
  std::vector<CollisionShape> collisions;  ///< of link -1, in the foreign link's frame
  std::vector<TriMesh> solids;             ///< that these stand for, likewise
  std::vector<ImportedVisual> visuals;
  std::vector<std::string> notes;  ///< what was assumed
};

/** Keeps the meshes it has read. */
class ShapeLoader {
 public:
  ShapeLoader(const HandSource& source, Diagnostics& problems)
      : source_(source), problems_(problems) {}

  /** The file of a mesh that the link touches with is not there. */
  bool LacksMesh(const ForeignLink& link) const;
  /** False, with one error, when no mesh of the description is there. */
  bool CheckMeshes(const ForeignHand& hand);
  /** Of each format apart where two differ by more than five times. Compares the meshes with the
  distances of the joints (typical ratio: median over the links).
  From five times too long on they are taken in the unit that fits, when one does within a factor
  of 1.6; any other ratio outside 0.55 to 2.2 is reported with the factor that would fit, and so is
  a link whose ratio is three times another than the typical one (a palm: six), or 1.5 times as
  large where its mass by the mesh's size says so, too. An error where all are too long,
  some longer than 2 m, and no unit fits. Call before Load. */
  void InferMeshUnit(const ForeignHand& hand);
  /** A collision mesh gets capsules for the checks (fit_capsules.h); a link that has only pictures
  gets them from those, unless it is decoration. More than kMostTouchingShapes are an error.
  @param is_palm  it must have something to touch with. */
  LoadedShapes Load(const ForeignLink& link, bool is_palm = false);
  /** The inertia of a link that has none, of its shapes that weigh. */
  void Weigh(ForeignLink& link);
  /** Paths of the meshes it has read. */
  std::set<std::filesystem::path> ListFiles() const;

 private:
  /** In the link's frame and metres, facing outwards as in its file; empty, with `error_kind`
  reported, when it cannot be had. */
  TriMesh LoadMesh(const ForeignShape& shape, const std::string& where, Severity severity);
  /** Its file; the description itself where the mesh stands there. */
  FoundMesh Find(const ForeignShape& shape) const;
  TriMesh ReadFile(const std::filesystem::path& path, int line, const std::string& where,
                   Severity severity);
  /** What touches or weighs faces outwards; a turned one is reported once. */
  TriMesh TurnOutwards(const TriMesh& mesh, const std::string& name, int line,
                       const std::string& where);
  void AddMesh(const TriMesh& mesh, LoadedShapes& loaded);
  void AddSolid(const ForeignShape& shape, const std::string& where, LoadedShapes& loaded);
  void Report(Severity severity, int line, const std::string& text);
  /** @returns false, with an error: it would touch with too many. */
  bool CheckCount(const ForeignLink& link, size_t count);

  struct LinkRatio {
    const ForeignLink* link = nullptr;
    double extent = 0.0, ratio = 0.0;  // of its meshes [m]; to the distance of its joints
    double density = 0.0;              // mass by the cube of the extent [kg/m^3]; 0: it has none
    double outlier = 0.0;              // ratio to the typical one from which it is reported
  };
  /** @param format  ending of the files; empty: of all. */
  void InferUnitOf(const std::vector<LinkRatio>& rows, const std::string& format);
  double FindTypicalUnit(const std::filesystem::path& path) const;

  const HandSource& source_;
  Diagnostics& problems_;
  std::map<std::filesystem::path, TriMesh> meshes_;
  double CalcMeshExtent(const ForeignShape& shape);
  double large_unit_ = 0.001;  // [m] of meshes that cannot be in metres
  /** [m] by the ending of a mesh's file, empty: of all, inferred from the joints; else the metre. */
  std::map<std::string, double> typical_units_;
  bool are_all_missing_ = false;
  std::set<std::string> turned_;  // messages
  std::string why_;               // the large unit is that
};

}  // namespace graspbench
