#pragma once
/** @file
A hand as described by a third party: read (read_foreign_urdf.h) but not yet checked. SI units. */

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
  bool also_touches = false;  ///< for a visual: it is a collision shape as well
  /** Mass of the shape (MJCF); nullopt: it has none. */
  struct Weight {
    std::optional<double> mass;  ///< [kg]
    double density = 0.0;        ///< used if there is no mass [kg/m^3]
  };
  std::optional<Weight> weight = {};
  /** A mesh given in the description itself (MJCF), before scaling; `mesh` is its name. */
  std::shared_ptr<const TriMesh> inline_mesh = {};
};

struct ForeignInertia : UrdfInertia {
  bool is_of_geoms = false;  ///< computed from its shapes, as the format specifies
};

struct ForeignLink {
  std::string name;
  int line = 0;
  std::optional<ForeignInertia> inertia;
  std::vector<ForeignShape> visuals, collisions;
  bool is_decoration = false;         ///< visual only (FindDecoration)
  std::vector<ForeignShape> weights;  ///< shapes that give the inertia; may also be listed above
  Pose X_LF = Pose::Identity();       ///< the named frame, if the link's joint is not at its origin
  std::vector<size_t> told;           ///< indices of the link's problems in those of its reader
};

struct ForeignMimic {
  int joint = -1;  ///< index into ForeignHand::joints
  double ratio = 1.0;
  double offset = 0.0;  ///< [rad], [m]
  /** One drive acts on the sum of this joint, the last of a finger, and the joint before it. A
  coupling rule (core/hand/hand.h) distributes the motion between them. */
  bool is_distal = false;
};

/** Published values of a joint's drive; 0: unknown. Units of a prismatic joint as in JointDrive. */
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
  /** Why the range is unknown, such as "has no <limit>"; empty: the limits are stated. */
  std::string no_limits;
  ForeignDrive drive;
  double spring_stiffness = 0.0;  ///< [N m/rad], [N/m]; 0: none
  double spring_rest = 0.0;       ///< rest position of the spring [rad], [m]
  double reference = 0.0;         ///< the description's value of our zero position [rad], [m]
  std::vector<size_t> told;       ///< as for a link
  std::optional<ForeignMimic> mimic;
  bool bears_jaw = false;  ///< fixed joint of a jaw on which the only other digit closes
};

struct ForeignHand {
  std::string name;
  std::vector<ForeignLink> links;
  std::vector<ForeignJoint> joints;
  std::vector<std::string> included;  ///< paths of further files that were read
  double least_mass = 0.0;            ///< bound of MJCF's compiler (boundmass) [kg]
  double least_moment = 0.0;          ///< likewise for principal moments [kg m^2]
  int world = -1;  ///< link that represents the world of a scene; -1: the format has none
};

/** Fixes a joint at position q [rad], [m], and with it the joints that follow it. */
void FixJoint(ForeignHand& hand, int index, double q);

/** Raises mass and principal moments of a link with inertia to the bounds of the hand's format, as
MuJoCo's compiler does. The world's are left alone. */
void RaiseToBounds(const ForeignHand& hand, ForeignLink& link);

/** Whether every error belongs to a link or joint (ForeignLink::told), so that a part without these
can be used. @param problems  those of the hand's reader. */
bool AreErrorsLocal(const ForeignHand& hand, const Diagnostics& problems);

/** A coupling q = offset + ratio q_other to a joint given by name, used by all readers of foreign
descriptions. */
struct NamedMimic {
  int joint = -1;  ///< index into ForeignHand::joints
  int line = 0;
  std::string follows;
  double ratio = 1.0;
  double offset = 0.0;
};

/** Resolves each coupling to a joint that follows no other. A coupling to the joint itself, in a
ring, to an unknown joint or to a fixed one is dropped with a warning, and the joint gets its own
drive. @param what  name of the coupling in messages, "<mimic>". */
void ResolveMimics(const std::vector<NamedMimic>& mimics, const std::string& what,
                   const std::string& file, Diagnostics& problems, ForeignHand& hand);

/** Finds links that are visual only: drawn axes, a mount, a cover.

A link with visuals but no collision shape is decoration if a link to which it is fixed, directly or
through others, has collision shapes. The description then says which parts of that body touch. A
body without any collision shape touches with its visuals (load_shapes.h).

Marks these links (ForeignLink::is_decoration) and reports each. */
void FindDecoration(const std::string& file, Diagnostics& problems, ForeignHand& hand);

}  // namespace graspbench
