#pragma once
/** @file
Converts the shapes of a foreign link to the project's: balls, cylinders and boxes for contact,
closed or open meshes for display. */

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

/** Upper bound of the size of a hand's part [m]. */
inline constexpr double kLargestPart = 2.0;
/** Shapes that a link touches with; the time to measure it grows with them. */
inline constexpr size_t kMostTouchingShapes = 100;

/** Reads a mesh file unscaled: one unit of the file is one metre. @throws Error. */
using MeshLoader = std::function<TriMesh(const std::filesystem::path&)>;

struct HandSource {
  std::string file;              ///< file of the description, for messages
  std::filesystem::path folder;  ///< folder of the description
  std::vector<std::filesystem::path> package_path;
  MeshLoader load_mesh;
  std::optional<Eigen::Vector3d> palm_normal;  ///< in the palm's frame; nullopt: guessed
  double unit = 0.0;                           ///< of the description's lengths [m]; 0: inferred
  double mesh_unit = 0.0;                      ///< of its mesh files [m]; 0: inferred
  bool accepts_coarse_contact = false;         ///< accept contact 5 mm off at the palm or a tip
  std::optional<bool> in_degrees;              ///< limits of a URDF, angles of a MuJoCo model
  /** Number of points of a link that balls must cover; fewer are coarser and faster. 0: keep the
  unmeasured contact geometry of the checks (fit_capsules.h). */
  int num_cover_points = kNumCoverPoints;
};

struct ImportedVisual {
  CollisionShape solid;  ///< for a visual without a mesh
  TriMesh mesh;          ///< in the link's frame [m]; empty: see `solid`
  std::string name;      ///< name of the mesh file without folder and ending
  Eigen::Vector3d colour = Eigen::Vector3d::Constant(0.6);  ///< sRGB
};

struct LoadedShapes {
  std::vector<CollisionShape> collisions;  ///< with link -1, in the foreign link's frame
  std::vector<TriMesh> solids;             ///< solids that these represent, likewise
  std::vector<ImportedVisual> visuals;
  std::vector<std::string> notes;  ///< assumptions made
};

/** Loads shapes and caches their meshes. */
class ShapeLoader {
 public:
  ShapeLoader(const HandSource& source, Diagnostics& problems)
      : source_(source), problems_(problems) {}

  /** Whether the file of a collision mesh of the link is missing. */
  bool LacksMesh(const ForeignLink& link) const;
  /** Returns false, with one error, if no mesh of the description is found and one is needed. */
  bool CheckMeshes(const ForeignHand& hand);
  /** Infers the unit of the meshes by comparing their extent with the distances of the joints (the
  typical ratio is the median over the links). Formats whose ratios differ by more than five times
  are judged separately.

  Meshes that are more than five times too long are read in the unit that fits within a factor of
  1.6, if there is one. Any other ratio outside 0.55 to 2.2 is reported with the factor that would
  fit. So is a link whose ratio differs from the typical one by a factor of three (six for a palm),
  or is 1.5 times as large if its mass for the mesh's size agrees. It is an error if all are too
  long, some longer than 2 m, and no unit fits. Call before Load. */
  void InferMeshUnit(const ForeignHand& hand);
  /** Loads the shapes of a link. Collision meshes get capsules for the checks (fit_capsules.h). A
  link with visuals only gets its capsules from these, unless it is decoration. More than
  kMostTouchingShapes are an error. @param is_palm  it must have a shape for contact. */
  LoadedShapes Load(const ForeignLink& link, bool is_palm = false);
  /** Computes the inertia of a link without one from those of its shapes that have mass. */
  void Weigh(ForeignLink& link);
  /** Paths of the meshes that were read. */
  std::set<std::filesystem::path> ListFiles() const;

 private:
  /** Returns a mesh in the link's frame and in metres, with the orientation of its file; empty,
  with a problem of the given severity, if it cannot be read. */
  TriMesh LoadMesh(const ForeignShape& shape, const std::string& where, Severity severity);
  /** Finds the mesh file; it is the description itself if this contains the mesh. */
  FoundMesh Find(const ForeignShape& shape) const;
  TriMesh ReadFile(const std::filesystem::path& path, int line, const std::string& where,
                   Severity severity);
  /** Orients outwards a mesh that touches or has mass; reports once if it was inverted. */
  TriMesh TurnOutwards(const TriMesh& mesh, const std::string& name, int line,
                       const std::string& where);
  void AddMesh(const TriMesh& mesh, LoadedShapes& loaded);
  void AddSolid(const ForeignShape& shape, const std::string& where, LoadedShapes& loaded);
  void Report(Severity severity, int line, const std::string& text);
  /** @returns false, with an error: it would touch with too many. */
  bool CheckCount(const ForeignLink& link, size_t count);

  struct LinkRatio {
    const ForeignLink* link = nullptr;
    double extent = 0.0, ratio = 0.0;  // of its meshes [m]; extent over the distance of its joints
    double density = 0.0;              // mass over the cube of the extent [kg/m^3]; 0: no mass
    double outlier = 0.0;              // ratio to the typical one beyond which it is reported
  };
  /** @param format  ending of the files; empty: all formats. */
  void InferUnitOf(const std::vector<LinkRatio>& rows, const std::string& format);
  double FindTypicalUnit(const std::filesystem::path& path) const;

  const HandSource& source_;
  Diagnostics& problems_;
  std::map<std::filesystem::path, TriMesh> meshes_;
  double CalcMeshExtent(const ForeignShape& shape);
  double large_unit_ = 0.001;  // of meshes that cannot be in metres [m]
  /** Units inferred from the joints, by ending of the mesh file, empty: all [m]; default: metre. */
  std::map<std::string, double> typical_units_;
  bool are_all_missing_ = false;
  std::set<std::string> turned_;  // messages
  std::string why_;               // reason for large_unit_
};

}  // namespace graspbench
