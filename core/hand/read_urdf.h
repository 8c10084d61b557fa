#pragma once
/** @file
A parsed URDF. All of its faults are reported at once, with their lines. There are two kinds of
description:

    a hand of our own form  any fault is an error, reported by CheckHand; unused elements give a
                            warning; meshes are OBJ files in the hand's folder
    a foreign one           missing or odd parts are left out and duplicate names are changed, with
                            a warning each (core/hand/import judges the rest); only faults that
                            leave no hand are errors

Elements that do not describe a hand (`<gazebo>`, `<transmission>`, `<dynamics>`, ...) are
skipped. */

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/pose.h"
#include "core/base/units.h"

namespace graspbench {

/** An angle larger than this is taken for an error of units [rad]. */
inline constexpr double kWholeTurn = 2.0 * kPi * (1.0 + 1e-4);

/** A description with this many links or more is not that of a hand. */
inline constexpr size_t kMostLinks = 1000;

struct UrdfShape {
  enum class Kind { kSphere, kCylinder, kCapsule, kBox, kEllipsoid, kMesh };  // ellipsoid: of MJCF
  Kind kind = Kind::kSphere;
  Pose X_LS = Pose::Identity();  ///< the shape's frame S, in the link's frame
  /** Extent along the axes of S [m]: for a ball three times its diameter; for a cylinder or capsule
  diameter, diameter, total length; for an ellipsoid its axes. Unused for a mesh. */
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  std::string mesh;                                 ///< address as given in the file
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< scale of the mesh; negative: mirrored
  std::optional<Eigen::Vector3d> colour;            ///< sRGB, 0 to 1
  std::string name;                                 ///< empty if the file gives none
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
  std::vector<size_t> told;  ///< indices of the link's problems in the Diagnostics
};

struct UrdfLimit {
  double lower = 0.0, upper = 0.0;  ///< [rad], [m]; NaN: unreadable
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
  int parent = -1, child = -1;  ///< indices into Urdf::links; -1 if invalid
  Pose X_PJ = Pose::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit, in J
  std::optional<UrdfLimit> limit;
  std::optional<UrdfMimic> mimic;  ///< foreign descriptions only
  std::vector<size_t> told;        ///< as for a link, without problems of missing ends
};

/** Links and joints in the file's order; they form a tree if there are no errors. */
struct Urdf {
  std::string name;
  int line = 0;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;

  std::vector<std::string> ListLinks() const;
  /** Each name once, even if duplicate names are an error. */
  std::vector<std::string> ListMovingJoints() const;
};

/** @param file  name of the text in messages.
@param own_folder  folder to which the meshes of a hand of our own form are relative; nullopt: the
description is foreign. @returns all that could be read, even if there are errors. */
Urdf ReadUrdf(const std::string& text, const std::string& file,
              const std::optional<std::filesystem::path>& own_folder, Diagnostics& problems);

}  // namespace graspbench
