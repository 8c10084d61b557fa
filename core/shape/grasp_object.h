#pragma once
/** @file
A thing to grasp, as the simulation and the pictures need it. Made by objects/ from the catalogue or
from a user's mesh; shared read-only between threads. */

#include <Eigen/Core>
#include <map>
#include <memory>
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

struct GraspObject {
  std::string id;    ///< "adhesive_tape"
  std::string name;  ///< "adhesive tape"
  /** In frame O: centre of the bounding box as the object rests on the table; x along length, y
  along width, z up. These are the sizes of grasp (what three fingers compress a soft object to). */
  TriMesh mesh;
  std::shared_ptr<const SignedDistanceField> field;         ///< of `mesh`
  Eigen::Vector3d size = Eigen::Vector3d::Zero();           ///< of grasp: length, width, height [m]
  Eigen::Vector3d size_of_sight = Eigen::Vector3d::Zero();  ///< what a camera sees [m]
  MassProperties mass_properties;
  SurfaceMaterial surface;  ///< its friction is that against the hand
  /** Best-suited standard grasp, "g1".."g5", by hand id; hands not named here use grasp_order. */
  std::map<std::string, std::string> best_grasp;
  /** Grasps by falling suitability; a hand without an entry in best_grasp takes the first of them
  that it can do. */
  std::vector<std::string> grasp_order = {"g1", "g3", "g2", "g5", "g4"};
  Approach approach = Approach::kAutomatic;  ///< said of the object; else the grasp's
  Eigen::Vector3f colour = Eigen::Vector3f(0.8f, 0.7f, 0.5f);  ///< linear RGB, for pictures
  std::string content_hash;  ///< of everything that the simulation depends on
  /** By how much it was turned from how its mesh lay to how it rests (resting_pose.h) [rad]. */
  double turned_to_rest = 0.0;
};

}  // namespace graspbench
