#pragma once
/** @file
Is a mesh the surface of one or more solids? Everything that simulation and mass properties rely on
is checked, and each problem is reported: how many, where the first ones are, what to do.

A point belongs to the solid where the surface winds around it at least once. So parts that overlap
or touch are one body, a shell that faces inwards within one that faces outwards is a cavity, parts
apart from the rest are told, and refused unless they are small or meant, and small folds of a
surface through itself are tolerated: warnings, not problems.

Positions in the messages are millimetres in the mesh's own frame. */

#include <limits>
#include <string>
#include <vector>

#include "core/shape/mass_properties.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

enum class MeshFault {
  kEmpty,         ///< no triangle at all
  kNotFinite,     ///< a coordinate is NaN or infinite
  kSize,          ///< larger or smaller than anything a hand can grasp: a wrong unit
  kDuplicate,     ///< the same triangle twice
  kOpen,          ///< edges with a triangle on one side only
  kNotManifold,   ///< edges with more triangles in one direction than in the other
  kInconsistent,  ///< neighbours that face opposite ways
  kInverted,      ///< inside out, or without volume
  kSelfCrossing,  ///< a part that cuts through itself, changing the volume by 0.1 % or more
  kApart,         ///< parts that do not touch the rest, of 1 % of the volume or more
  kNested,        ///< parts inside others that are no cavities, of 1 % of the volume or more
  kTooMany,       ///< more triangles than kMaxUsableTriangles, or too many in one place
};

struct MeshProblem {
  MeshFault fault = MeshFault::kEmpty;
  std::string text;  ///< what, where and what to do
};

struct MeshReport {
  bool is_closed = false;  ///< every edge has as many triangles in one direction as in the other
  int num_triangles = 0;
  int num_open_edges = 0;
  /** Of the solid, overlaps counted once [m^3]; negative when inside out; NaN unless closed with
  all neighbours facing alike. */
  double volume = std::numeric_limits<double>::quiet_NaN();
  /** Of the solid [m]; NaN like the volume. */
  Eigen::Vector3d centroid = Eigen::Vector3d::Constant(volume);
  /** Of the bounding box [m]; NaN without finite vertices. */
  Eigen::Vector3d extent = Eigen::Vector3d::Constant(volume);
  std::vector<MeshProblem> problems;  ///< empty: fit for use
  std::vector<std::string> warnings;  ///< what was tolerated, and why
  Overlap overlap;                    ///< what mass properties must count once
};

/** Extents of things to grasp [m]. */
inline constexpr double kMinMeshExtent = 0.002;
inline constexpr double kMaxMeshExtent = 1.0;
/** What is thinner is doubted [m]. */
inline constexpr double kThinnestMesh = 5e-5;

/** Of a million its check took 20 s of processor time, its distance field four minutes; the largest
scans of things to grasp that are published (YCB) have 524,288. */
inline constexpr int kMaxUsableTriangles = 600'000;

/** A part that cuts through itself is tolerated when less than this share of its volume is counted
wrongly. */
inline constexpr double kMaxFoldedShare = 1e-3;

/** Parts that lie apart, or inside others without being cavities, are tolerated up to this share of
the volume. */
inline constexpr double kMaxStrayShare = 0.01;
/** Parts that are nearer to each other touch: a share of the mesh's largest extent, at most so far
[m]. */
inline constexpr double kTouchingShare = 1e-3;
inline constexpr double kMaxTouchingGap = 5e-5;

enum class PartsApart {
  kRefused,
  kMeant  ///< somebody has said that the object is of several bodies, which move as one
};

/** @pre valid indices. Costs about 20 ms for 5,000 triangles, half a second more for each part that
crosses others or itself. */
MeshReport CheckMesh(const TriMesh& mesh, PartsApart parts_apart = PartsApart::kRefused);

/** The problems one per line; empty when there are none. */
std::string FormatProblems(const MeshReport& report);

}  // namespace graspbench
