#pragma once
/** @file
Is a mesh the surface of one or more solids? Everything that simulation and mass properties rely on
is checked, and each problem is told to a person: how many, where the first ones are, what to do.

Positions in the messages are millimetres in the mesh's own frame. Not checked: surfaces that touch
without crossing, and solids that lie inside each other. */

#include <limits>
#include <string>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

enum class MeshFault {
  kEmpty,         ///< no triangle at all
  kNotFinite,     ///< a coordinate is NaN or infinite
  kSize,          ///< larger or smaller than anything a hand can grasp: a wrong unit
  kDegenerate,    ///< triangles without area
  kDuplicate,     ///< the same triangle twice
  kOpen,          ///< edges with a triangle on one side only
  kNotManifold,   ///< edges shared by more than two triangles
  kInconsistent,  ///< neighbours that face opposite ways
  kInverted,      ///< inside out, or without volume
  kSelfCrossing,  ///< triangles that cut through each other
};

struct MeshProblem {
  MeshFault fault = MeshFault::kEmpty;
  std::string text;  ///< what, where and what to do
};

struct MeshReport {
  bool is_closed = false;  ///< every edge has exactly one triangle on either side
  int num_triangles = 0;
  int num_open_edges = 0;
  /** [m^3], negative when inside out; NaN unless closed with all neighbours facing alike. */
  double volume = std::numeric_limits<double>::quiet_NaN();
  /** Of the solid [m]; NaN like the volume. */
  Eigen::Vector3d centroid = Eigen::Vector3d::Constant(volume);
  /** Of the bounding box [m]; NaN without finite vertices. */
  Eigen::Vector3d extent = Eigen::Vector3d::Constant(volume);
  std::vector<MeshProblem> problems;  ///< empty: fit for use
};

/** Extents of things to grasp [m]. */
inline constexpr double kMinMeshExtent = 0.002;
inline constexpr double kMaxMeshExtent = 1.0;

/** @pre valid indices. Costs about 20 ms for 5,000 triangles. */
MeshReport CheckMesh(const TriMesh& mesh);

/** The problems one per line; empty when there are none. */
std::string FormatProblems(const MeshReport& report);

}  // namespace graspbench
