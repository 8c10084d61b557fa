#pragma once
/** @file
A hand as somebody else describes it: read (read_foreign_urdf.h), not yet judged. SI units. */

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/pose.h"
#include "core/hand/read_urdf.h"
#include "core/hand/xml_text.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

struct ForeignShape : UrdfShape {
  bool also_touches = false;  ///< of a picture: it is a collision shape as well
  /** What of it weighs (MJCF); nothing: it does not. */
  struct Weight {
    std::optional<double> mass;  ///< [kg]
    double density = 0.0;        ///< where there is no mass [kg/m^3]
  };
  std::optional<Weight> weight = {};
  /** A mesh that stands in the description itself (MJCF), before its scale; `mesh` is its name. */
  std::shared_ptr<const TriMesh> inline_mesh = {};
};

struct ForeignInertia : UrdfInertia {
  bool is_of_geoms = false;  ///< that of its shapes, as the format says
};

struct ForeignLink {
  std::string name;
  int line = 0;
  std::optional<ForeignInertia> inertia;
  std::vector<ForeignShape> visuals, collisions;
  bool is_decoration = false;         ///< only looked at (FindDecoration)
  std::vector<ForeignShape> weights;  ///< make the inertia; shapes of the others among them
  Pose X_LF = Pose::Identity();  ///< the frame that bears the name, where its joint lies elsewhere
  std::vector<size_t> told;      ///< of it by its reader: indices into the reader's problems
};

struct ForeignMimic {
  int joint = -1;  ///< index into ForeignHand::joints
  double ratio = 1.0;
  double offset = 0.0;  ///< [rad], [m]
  /** One drive pulls on the sum of both, the joint before it and this one, the last of a finger: a
  coupling rule (core/hand/hand.h) says how they share it. */
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
  std::vector<size_t> told;       ///< as of a link
  std::optional<ForeignMimic> mimic;
  bool bears_jaw = false;  ///< fixed, of a jaw on which the only other digit closes (MarkFixedJaw)
};

struct ForeignHand {
  std::string name;
  std::vector<ForeignLink> links;
  std::vector<ForeignJoint> joints;
  std::vector<std::string> included;  ///< paths of further files that it was read from
  double least_mass = 0.0;            ///< of a body, by the compiler of MJCF (boundmass) [kg]
  double least_moment = 0.0;          ///< of a principal moment, likewise [kg m^2]
  int world = -1;  ///< link that stands for the world of a scene; -1: the format has none
};

/** A foreign joint held for good. Puts a joint at a position [rad], [m] for good; those that follow
it, too. */
void FixJoint(ForeignHand& hand, int index, double q);

/** Raises mass and principal moments of a link that has an inertia to the bounds of the hand's
format, as MuJoCo's compiler does; not those of the world. */
void RaiseToBounds(const ForeignHand& hand, ForeignLink& link);

/** Every error was told of a link or a joint (ForeignLink::told): a part without these can be used.
@param problems  of the hand's reader. */
bool AreErrorsLocal(const ForeignHand& hand, const Diagnostics& problems);

/** What the readers of foreign descriptions have in common. q = offset + ratio q_other, the other
joint by its name. */
struct NamedMimic {
  int joint = -1;  ///< index into ForeignHand::joints
  int line = 0;
  std::string follows;
  double ratio = 1.0;
  double offset = 0.0;
};

/** Ties joints to joints that follow nobody. Of itself, in a ring, of nobody, of what does not
move: the joint gets a drive of its own, with a warning. @param what  in messages, "<mimic>". */
void ResolveMimics(const std::vector<NamedMimic>& mimics, const std::string& what,
                   const std::string& file, Diagnostics& problems, ForeignHand& hand);

/** Links that are only looked at: drawn axes, a mount, a cover.

A link with a picture alone is decoration where a link that it is fixed to, directly or by others,
has collision shapes: then the description says what of that body touches. A body without any
collision shape touches with its pictures (load_shapes.h).

Marks such links (ForeignLink::is_decoration) and reports each. */
void FindDecoration(const std::string& file, Diagnostics& problems, ForeignHand& hand);

}  // namespace graspbench
