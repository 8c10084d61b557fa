#pragma once
/** @file
Checks whether a mesh is the surface of one or more solids. Everything that simulation and mass
properties rely on is checked. Each problem is reported with its count, its first locations and the
remedy.

A point belongs to the solid if the winding number of the surface around it is at least one. So
parts that overlap or touch are one body, and a shell that faces inwards inside one that faces
outwards is a cavity. Separate parts are reported; they are rejected unless they are small or
intended. Small self-intersections are tolerated: they are warnings, not problems.

Positions in the messages are in millimetres in the mesh's own frame. */

#include <limits>
#include <string>
#include <vector>

#include "core/shape/mass_properties.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

enum class MeshFault {
  kEmpty,         ///< no triangles
  kNotFinite,     ///< a coordinate is NaN or infinite
  kSize,          ///< too large or too small to be grasped: a wrong unit
  kDuplicate,     ///< duplicate triangles
  kOpen,          ///< edges with a triangle on only one side
  kNotManifold,   ///< edges with more triangles in one direction than in the other
  kInconsistent,  ///< neighbours with opposite orientations
  kInverted,      ///< inside out, or without volume
  kSelfCrossing,  ///< a part that intersects itself and so changes the volume by 0.1 % or more
  kApart,         ///< separate parts of 1 % of the volume or more
  kNested,        ///< parts inside others that are not cavities, of 1 % of the volume or more
  kTooMany,       ///< more triangles than kMaxUsableTriangles, or too many at one location
};

struct MeshProblem {
  MeshFault fault = MeshFault::kEmpty;
  std::string text;  ///< problem, location and remedy
};

struct MeshReport {
  bool is_closed = false;  ///< every edge has as many triangles in one direction as in the other
  int num_triangles = 0;
  int num_open_edges = 0;
  /** Volume of the solid, overlaps counted once [m^3]; negative if inside out; NaN unless the mesh
  is closed and consistently oriented. */
  double volume = std::numeric_limits<double>::quiet_NaN();
  /** Centroid of the solid [m]; NaN if the volume is NaN. */
  Eigen::Vector3d centroid = Eigen::Vector3d::Constant(volume);
  /** Size of the bounding box [m]; NaN without finite vertices. */
  Eigen::Vector3d extent = Eigen::Vector3d::Constant(volume);
  std::vector<MeshProblem> problems;  ///< empty: fit for use
  std::vector<std::string> warnings;  ///< tolerated defects, with the reason
  Overlap overlap;                    ///< overlaps that mass properties must count once
};

/** Limits of an object's largest extent [m]. */
inline constexpr double kMinMeshExtent = 0.002;
inline constexpr double kMaxMeshExtent = 1.0;
/** A warning is given below this thickness [m]. */
inline constexpr double kThinnestMesh = 5e-5;

/** Maximum number of triangles. For a million, the check took 20 s of processor time and the
distance field four minutes. The largest published scans of objects to grasp (YCB) have 524,288
triangles. */
inline constexpr int kMaxUsableTriangles = 600'000;

/** A self-intersecting part is tolerated if less than this share of its volume is counted
wrongly. */
inline constexpr double kMaxFoldedShare = 1e-3;

/** Separate parts, and parts inside others that are not cavities, are tolerated up to this share of
the volume. */
inline constexpr double kMaxStrayShare = 0.01;
/** Parts closer than this share of the mesh's largest extent, but at most kMaxTouchingGap [m],
count as touching. */
inline constexpr double kTouchingShare = 1e-3;
inline constexpr double kMaxTouchingGap = 5e-5;

enum class PartsApart {
  kRefused,
  kMeant  ///< the user stated that the object has several bodies, which move as one
};

/** Checks a mesh. Takes about 20 ms for 5,000 triangles, and half a second more for each part that
intersects itself or others. @pre valid indices. */
MeshReport CheckMesh(const TriMesh& mesh, PartsApart parts_apart = PartsApart::kRefused);

/** Returns the problems, one per line; empty if there are none. */
std::string FormatProblems(const MeshReport& report);

}  // namespace graspbench
