#pragma once
/** @file
A URDF as it stands, with all its faults at once and their lines. Two kinds of description are read:

    a hand of our own form  any fault is an error: what CheckHand reports; unused elements get a
                            warning; meshes are OBJ files in the hand's folder
    a foreign one           what is missing or odd is left out, a name that is taken is changed,
                            with a warning each (core/hand/import judges the rest); an error is only
                            what leaves no hand

Elements that describe no hand (`<gazebo>`, `<transmission>`, `<dynamics>`, ...) are passed over. */

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/pose.h"
#include "core/base/units.h"

namespace graspbench {

/** An angle beyond it is a mistake of units [rad]. */
inline constexpr double kWholeTurn = 2.0 * kPi * (1.0 + 1e-4);

/** A description with as many is not that of a hand. */
inline constexpr size_t kMostLinks = 1000;

struct UrdfShape {
  enum class Kind { kSphere, kCylinder, kCapsule, kBox, kEllipsoid, kMesh };  // ellipsoid: of MJCF
  Kind kind = Kind::kSphere;
  Pose X_LS = Pose::Identity();  ///< the shape's frame S in the link
  /** Extent along the axes of S [m]: of a ball thrice its diameter, of a cylinder and a capsule
  diameter, diameter, whole length, of an ellipsoid its axes. Unused for a mesh. */
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  std::string mesh;                                 ///< address as it stands in the file
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< of the mesh; negative: mirrored
  std::optional<Eigen::Vector3d> colour;            ///< sRGB, 0 to 1
  std::string name;                                 ///< mostly empty
  int line = 0;
};

struct UrdfInertia {
  double mass = 0.0;  ///< [kg]
  Pose X_LI = Pose::Identity();
  Eigen::Matrix3d I_I = Eigen::Matrix3d::Zero();  ///< about I's origin, axes of I [kg m^2]
  int line = 0;
};

struct UrdfLink {
  std::string name;
  int line = 0;
  std::optional<UrdfInertia> inertia;
  std::vector<UrdfShape> visuals, collisions;
  std::vector<size_t> told;  ///< indices into the problems: those of this link
};

struct UrdfLimit {
  double lower = 0.0, upper = 0.0;  ///< [rad], [m]; not a number: it cannot be read
  std::optional<double> effort;     ///< [N m], [N]
  int line = 0;
};

struct UrdfMimic {
  std::string joint;
  double multiplier = 1.0;
  double offset = 0.0;
  int line = 0;
};

struct UrdfJoint {
  enum class Kind { kFixed, kRevolute, kContinuous, kPrismatic };
  std::string name;
  int line = 0;
  Kind kind = Kind::kFixed;
  int parent = -1, child = -1;  ///< indices into Urdf::links; -1 where that is an error
  Pose X_PJ = Pose::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit, in J
  std::optional<UrdfLimit> limit;
  std::optional<UrdfMimic> mimic;  ///< foreign descriptions only
  std::vector<size_t> told;        ///< as of a link; not that an end of it is missing
};

/** Links and joints in the file's order; a tree when there are no errors. */
struct Urdf {
  std::string name;
  int line = 0;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;

  std::vector<std::string> ListLinks() const;
  /** Each name once, also where that is an error. */
  std::vector<std::string> ListMovingJoints() const;
};

/** @param file  name of the text in messages.
@param own_folder  of a hand of our own form, its meshes are relative to it; nothing: the
description is foreign. @returns what could be read, also with errors. */
Urdf ReadUrdf(const std::string& text, const std::string& file,
              const std::optional<std::filesystem::path>& own_folder, Diagnostics& problems);

}  // namespace graspbench
