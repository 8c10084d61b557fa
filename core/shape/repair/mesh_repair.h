#pragma once
/** @file
Repairs that cannot change what a mesh represents: they fix obvious oversights of its author. Large
holes and self-intersecting surfaces need a modelling program. */

#include <string>
#include <vector>

#include "core/shape/repair/mesh_check.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

struct MeshRepair {
  TriMesh mesh;
  std::vector<std::string> actions;  ///< what was done, one sentence each; empty: nothing
};

/** Holes above this share of the surface stay open, while loading and in an explicit repair.
Closing a hole at the first limit changes a ball's volume by less than 0.1 %. */
inline constexpr double kMaxMendedHole = 0.01;
inline constexpr double kMaxRepairedHole = 0.05;
/** Maximum gap of a seam, as a share of the mesh's largest extent. */
inline constexpr double kMaxMendedSeam = 1e-3;
inline constexpr double kMaxRepairedSeam = 5e-3;

/** Mends a mesh as is always done while loading. Removes coincident faces with opposite
orientations, duplicates, sheets attached to the surface, walls across its inside and loose sheets
(DropFins and others below). Closes seams and small holes (FillHoles).
@pre valid indices; a mesh with non-finite vertices is returned unchanged. */
MeshRepair MendMesh(const TriMesh& mesh);

/** Repairs a mesh on request: as MendMesh, but with larger holes and seams, and after merging
vertices closer than a millionth of the extent. Then orients neighbours consistently and turns every
shell that is inside no other one outwards, together with the shells inside it: a cavity stays a
cavity. Check the result, because problems that cannot be repaired remain.
@pre valid indices; a mesh with non-finite vertices is returned unchanged. */
MeshRepair RepairMesh(const TriMesh& mesh);

/** A larger mesh whose triangles hardly share edges is not mended: a million triangles would take a
minute. */
inline constexpr int kMaxMendedSoup = 200000;

/** Orients neighbours consistently and, in a closed mesh, the shells as RepairMesh does. Changes
nothing else; without actions the mesh is returned as given. Among neighbours the majority is
assumed to be right, and an open mesh keeps its orientation.
@pre valid indices. */
MeshRepair FaceOutwards(const TriMesh& mesh);

/** A mesh that is ready for simulation. */
struct UsableMesh {
  TriMesh mesh;  ///< as given if it has no problems or if mending cannot remove all of them
  std::vector<std::string> actions;  ///< of MendMesh
  MeshReport report;                 ///< of `mesh`
};
/** Checks the mesh and mends it if it has problems; the mended mesh is used only if it has none.
@pre valid indices. */
UsableMesh MakeUsable(const TriMesh& mesh, PartsApart parts_apart = PartsApart::kRefused);

/** Closes seams: merges vertices of open edges that lie within `tolerance` [m] of each other.
@returns the number of merged vertices. */
int SewSeams(double tolerance, TriMesh& mesh);

/** Closes each hole with a fan about its centre if the fan's area is at most `max_share` of the
whole surface and at most kMaxOwnShare of the shell around the hole. The second limit exists because
a loose sheet is all rim, and a slit of any length has no area. A rim that touches itself is split
into several holes. @returns the number of closed holes. */
inline constexpr double kMaxOwnShare = 0.2;
int FillHoles(double max_share, TriMesh& mesh);

/** Drops coincident faces, which enclose nothing; the enclosed volume is unchanged.

Triangles on the same three corners cancel in pairs of opposite orientation. Of those that are left
one is kept, or all if only then the surface is closed, as for bodies that share a face. If less
than half of the faces would be left, the file contains every face twice for rendering, and the
first of each is kept. @returns the number of dropped triangles. */
int DropDoubledFaces(TriMesh& mesh);

/** Drops fins: patches that are bounded by edges of more than two triangles and either have an open
rim or are walls. A wall is a patch whose removal leaves every edge of its rim balanced. The
smallest patch is dropped first, because that may complete another one. A patch of half the surface
or more is never dropped; a wall across a body is smaller than either side.
@returns the number of dropped triangles. */
int DropFins(TriMesh& mesh);

/** Drops open shells of at most this share of the surface. @returns the number of dropped
triangles. */
int DropLooseSheets(double max_share, TriMesh& mesh);

/** Drops vertices that no triangle uses, because they would count towards the size. Keeps the
order. */
void DropUnusedVertices(TriMesh& mesh);

}  // namespace graspbench
