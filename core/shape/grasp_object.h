#pragma once
/** @file
An object to grasp, as the simulation and the renderer need it. objects/ creates it from the
catalogue or from a user's mesh. It is shared between threads and read-only. */

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

/** Direction from which a hand approaches an object. A grasp, an object and a session may each
specify it; the session takes precedence over the object, and the object over the grasp. */
enum class Approach {
  kAutomatic,  ///< chosen by the rule in core/grasp/placement.h
  kAbove,
  kSide
};

struct ApproachRow {
  Approach value;
  const char* name;  ///< as in files
};
inline constexpr ApproachRow kApproaches[] = {
    {Approach::kAutomatic, "automatic"}, {Approach::kAbove, "above"}, {Approach::kSide, "side"}};

/** Reads the optional key `approach`; an unknown word is reported with a suggestion. */
void ReadApproach(YamlMap& map, Approach& approach);

/** How a compressible object yields to fingers (core/physics/soft_surface.h). */
struct Compressibility {
  double force = 0.0;  ///< pressing force of one fingertip [N]
  /** Yield tensor in O: a surface with unit normal nhat yields by nhat^T yield nhat [m] to
  `force`. */
  Eigen::Matrix3d yield = Eigen::Matrix3d::Zero();
  bool is_sight_guessed = false;  ///< the size at rest is a guess
};

/** A grasp may compress no side of an object to less than this share of its size at rest. */
inline constexpr double kLeastSizeOfGrasp = 0.6;

struct GraspObject {
  std::string id;    ///< "adhesive_tape"
  std::string name;  ///< "adhesive tape"
  /** In frame O: origin at the centre of the bounding box as the object rests on the table, x along
  its length, y along its width, z up. The mesh of a compressible object is the shape at rest, which
  a camera sees. */
  TriMesh mesh;
  std::shared_ptr<const SignedDistanceField> field;  ///< of `mesh`
  Eigen::Vector3d size = Eigen::Vector3d::Zero();    ///< length, width, height at rest [m]
  std::optional<Compressibility> compressible;       ///< nullopt: rigid
  MassProperties mass_properties;
  SurfaceMaterial surface;  ///< friction: against the hand
  /** Best-suited standard grasp, "g1" to "g6", by hand id; hands without an entry use
  grasp_order. */
  std::map<std::string, std::string> best_grasp;
  /** Grasps in order of decreasing suitability. A hand without an entry in best_grasp takes the
  first one that it can perform. */
  std::vector<std::string> grasp_order = {"g1", "g3", "g6", "g2", "g4"};
  Approach approach = Approach::kAutomatic;                    ///< automatic: the grasp decides
  Eigen::Vector3f colour = Eigen::Vector3f(0.8f, 0.7f, 0.5f);  ///< linear RGB, for rendering
  std::string content_hash;  ///< hash of everything that the simulation depends on
  /** Angle of the rotation from the orientation of the input mesh to the resting pose
  (resting_pose.h) [rad]. */
  double turned_to_rest = 0.0;
};

/** Returns the object's size while fingertips press with Compressibility::force on both sides of
each axis; for a rigid object, its size [m]. */
inline Eigen::Vector3d CalcSizeOfGrasp(const GraspObject& object) {
  if (!object.compressible) return object.size;
  return object.size - 2.0 * object.compressible->yield.diagonal();
}

}  // namespace graspbench
