#pragma once
/** @file
A hand as somebody else describes it: read (read_foreign_urdf.h), not yet judged. SI units. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/pose.h"

namespace graspbench {

struct ForeignShape {
  enum class Kind { kSphere, kCylinder, kCapsule, kBox, kMesh };
  Kind kind = Kind::kSphere;
  Pose X_LS = Pose::Identity();  ///< the shape's frame S in the link
  /** Extent along the axes of S [m]: of a ball thrice its diameter, of a cylinder and a capsule
  diameter, diameter, whole length. Unused for a mesh. */
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  std::string mesh;                                 ///< address as it stands in the file
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< of the mesh; negative: mirrored
  std::optional<Eigen::Vector3d> colour;            ///< sRGB, 0 to 1
  int line = 0;
};

struct ForeignInertia {
  double mass = 0.0;  ///< [kg]
  Pose X_LI = Pose::Identity();
  Eigen::Matrix3d I_I = Eigen::Matrix3d::Zero();  ///< about I's origin, axes of I [kg m^2]
  int line = 0;
};

struct ForeignLink {
  std::string name;
  int line = 0;
  std::optional<ForeignInertia> inertia;
  std::vector<ForeignShape> visuals, collisions;
};

struct ForeignMimic {
  int joint = -1;  ///< index into ForeignHand::joints
  double ratio = 1.0;
  double offset = 0.0;  ///< [rad], [m]
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
  double effort = 0.0;                              ///< [N m], [N]; 0: not known
  std::optional<ForeignMimic> mimic;
};

struct ForeignHand {
  std::string name;
  std::vector<ForeignLink> links;
  std::vector<ForeignJoint> joints;
};

}  // namespace graspbench
