#pragma once
/** @file
A thing to grasp, as the simulation and the pictures need it. Made by objects/ from the catalogue or
from a user's mesh; shared read-only between threads. */

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/yaml.h"
#include "core/shape/mass_properties.h"
#include "core/shape/signed_distance_field.h"
#include "core/shape/surface_material.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

/** From where a hand comes to an object: a grasp, an object and a session may each say so. What a
session says comes before what the object says, and that before the grasp's own word. */
enum class Approach {
  kAutomatic,  ///< by the rule in core/grasp/placement.h
  kAbove,
  kSide
};

struct ApproachRow {
  Approach value;
  const char* name;  ///< in files
};
inline constexpr ApproachRow kApproaches[] = {
    {Approach::kAutomatic, "automatic"}, {Approach::kAbove, "above"}, {Approach::kSide, "side"}};

/** The key `approach`, which may be left out; another word is a problem with a hint. */
void ReadApproach(YamlMap& map, Approach& approach);

/** How a compressible object gives way to fingers (core/physics/soft_surface.h). */
struct Compressibility {
  double force = 0.0;  ///< of one fingertip [N]
  /** By nhat^T yield nhat the surface whose normal in O is nhat gives way to it [m]. */
  Eigen::Matrix3d yield = Eigen::Matrix3d::Zero();
  bool is_sight_guessed = false;  ///< nobody measured the size at rest
};

/** No side of an object may be compressed to less than this share of its size at rest. */
inline constexpr double kLeastSizeOfGrasp = 0.6;

struct GraspObject {
  std::string id;    ///< "adhesive_tape"
  std::string name;  ///< "adhesive tape"
  /** In frame O: centre of the bounding box as the object rests on the table; x along length, y
  along width, z up. At rest: what a camera sees of a compressible object. */
  TriMesh mesh;
  std::shared_ptr<const SignedDistanceField> field;  ///< of `mesh`
  Eigen::Vector3d size = Eigen::Vector3d::Zero();    ///< length, width, height at rest [m]
  std::optional<Compressibility> compressible;       ///< none: it is rigid
  MassProperties mass_properties;
  SurfaceMaterial surface;  ///< its friction is that against the hand
  /** Best-suited standard grasp, "g1".."g6", by hand id; hands not named here use grasp_order. */
  std::map<std::string, std::string> best_grasp;
  /** Grasps by falling suitability; a hand without an entry in best_grasp takes the first of them
  that it can do. */
  std::vector<std::string> grasp_order = {"g1", "g3", "g6", "g2", "g4"};
  Approach approach = Approach::kAutomatic;  ///< said of the object; else the grasp's
  Eigen::Vector3f colour = Eigen::Vector3f(0.8f, 0.7f, 0.5f);  ///< linear RGB, for pictures
  std::string content_hash;  ///< of everything that the simulation depends on
  /** By how much it was turned from how its mesh lay to how it rests (resting_pose.h) [rad]. */
  double turned_to_rest = 0.0;
};

/** Its size where fingertips press with Compressibility::force on both sides of each axis; of a
rigid one its size [m]. */
inline Eigen::Vector3d CalcSizeOfGrasp(const GraspObject& object) {
  if (!object.compressible) return object.size;
  return object.size - 2.0 * object.compressible->yield.diagonal();
}

}  // namespace graspbench
