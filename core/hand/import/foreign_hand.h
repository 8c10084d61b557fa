#pragma once
/** @file
A hand as somebody else describes it: read (read_foreign_urdf.h), not yet judged. SI units. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/read_urdf.h"

namespace graspbench {

struct ForeignShape : UrdfShape {
  bool also_touches = false;  ///< of a picture: it is a collision shape as well
  /** What of it weighs (MJCF); nothing: it does not. */
  struct Weight {
    std::optional<double> mass;  ///< [kg]
    double density = 0.0;        ///< where there is no mass [kg/m^3]
  };
  std::optional<Weight> weight = {};
};

struct ForeignInertia : UrdfInertia {
  bool is_of_geoms = false;  ///< that of its shapes, as the format says
};

struct ForeignLink {
  std::string name;
  int line = 0;
  std::optional<ForeignInertia> inertia;
  std::vector<ForeignShape> visuals, collisions;
  bool is_decoration = false;         ///< only looked at (decoration.h)
  std::vector<ForeignShape> weights;  ///< make the inertia; shapes of the others among them
  Pose X_LF = Pose::Identity();  ///< the frame that bears the name, where its joint lies elsewhere
};

struct ForeignMimic {
  int joint = -1;  ///< index into ForeignHand::joints
  double ratio = 1.0;
  double offset = 0.0;  ///< [rad], [m]
  /** One drive pulls on the sum of both, the joint before it and this one, the last of a finger: a
  coupling rule (core/hand/coupling.h) says how they share it. */
  bool is_distal = false;
};

/** What is published of a joint's drive; 0: not known. Units of a prismatic joint as in JointDrive.
*/
struct ForeignDrive {
  double effort = 0.0;     ///< [N m], [N]
  double stiffness = 0.0;  ///< [N m/rad]
  double damping = 0.0;    ///< [N m s/rad]
};

struct ForeignJoint {
  enum class Kind { kFixed, kRevolute, kPrismatic };
  std::string name;
  int line = 0;
  Kind kind = Kind::kFixed;
  int parent = -1, child = -1;  ///< indices into ForeignHand::links
  Pose X_PJ = Pose::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit, in J
  double lower = 0.0, upper = 0.0;                  ///< [rad], [m]
  /** Why nobody knows how far it moves, "has no <limit>"; empty: its limits are stated. */
  std::string no_limits;
  ForeignDrive drive;
  double spring_stiffness = 0.0;  ///< [N m/rad], [N/m]; 0: none
  double spring_rest = 0.0;       ///< position where it is slack [rad], [m]
  double reference = 0.0;         ///< what the description calls its zero here [rad], [m]
  std::optional<ForeignMimic> mimic;
};

struct ForeignHand {
  std::string name;
  std::vector<ForeignLink> links;
  std::vector<ForeignJoint> joints;
  std::vector<std::string> included;  ///< paths of further files that it was read from
  int world = -1;  ///< link that stands for the world of a scene; -1: the format has none
};

}  // namespace graspbench
