#pragma once
/** @file
Repairs that cannot change what a mesh means: what its maker obviously forgot. Large holes and
surfaces that fold through themselves need a modelling program. */

#include <string>
#include <vector>

#include "core/shape/repair/mesh_check.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

struct MeshRepair {
  TriMesh mesh;
  std::vector<std::string> actions;  ///< what was done, one sentence each; empty: nothing
};

/** Holes of a larger share of the surface stay open: while loading, and when a repair is asked for.
Closing the first sort changes a ball's volume by less than 0.1 %. */
inline constexpr double kMaxMendedHole = 0.01;
inline constexpr double kMaxRepairedHole = 0.05;
/** Seams gape less than this share of the mesh's largest extent. */
inline constexpr double kMaxMendedSeam = 1e-3;
inline constexpr double kMaxRepairedSeam = 5e-3;

/** What every user of a mesh gets without asking: faces that lie on each other in opposite
directions, copies, sheets that hang on the surface, walls across its inside and loose sheets
removed (DropFins and others below), seams and small holes closed (FillHoles).
@pre valid indices; a mesh with non-finite vertices comes back as it is. */
MeshRepair MendMesh(const TriMesh& mesh);

/** The same after merging vertices closer than a millionth of the extent, with larger holes; then
turns neighbours to face the same way, and every shell that lies in no other one to face outwards,
with all that lies in it: a cavity stays a cavity. Check the result: what could not be repaired is
still there.
@pre valid indices; a mesh with non-finite vertices comes back as it is. */
MeshRepair RepairMesh(const TriMesh& mesh);

/** More triangles that hardly share an edge are not mended: a million would take a minute. */
inline constexpr int kMaxMendedSoup = 200000;

/** Turns neighbours to face the same way, and in a closed mesh the shells as RepairMesh does;
changes nothing else. Without actions the mesh is as given. Of neighbours the majority is taken to
be right; an open mesh keeps the side that it has.
@pre valid indices. */
MeshRepair FaceOutwards(const TriMesh& mesh);

/** A mesh as simulation can use it. */
struct UsableMesh {
  TriMesh mesh;  ///< as given when it has no problem, or when mending leaves some
  std::vector<std::string> actions;  ///< of MendMesh
  MeshReport report;                 ///< of `mesh`
};
/** Checks the mesh, mends it if it has problems, and keeps what was mended if then it has none.
@pre valid indices. */
UsableMesh MakeUsable(const TriMesh& mesh, PartsApart parts_apart = PartsApart::kRefused);

/** Closes what a surface is open at, where there is no doubt how. Joins vertices of open edges that
lie within `tolerance` [m] of each other: the two sides of a seam. @returns how many were joined. */
int SewSeams(double tolerance, TriMesh& mesh);

/** Closes each hole with a fan about its middle, if its area is at most this share of the whole
surface, and kMaxOwnShare of the shell around the hole: a loose sheet is all rim, a slit of any
length has no area. A rim that touches itself is taken as several holes. @returns how many holes. */
inline constexpr double kMaxOwnShare = 0.2;
int FillHoles(double max_share, TriMesh& mesh);

/** Takes off a mesh what encloses nothing: faces on each other, sheets that hang on the surface or
stand across its inside, loose sheets. What it encloses stays as it is.

Of the triangles on the same three corners, as many as face opposite ways cancel each other; of
those that are left one stays, or all where only then the surface is whole: bodies that share a
face. Where little would be left, the file has every face twice for the sake of pictures, and the
first of each stays. @returns how many were dropped. */
int DropDoubledFaces(TriMesh& mesh);

/** Drops patches between edges of more than two triangles: those with an open rim, and walls whose
removal leaves every edge of their rim whole; the smallest first, for that may make another one
whole, and none of half the surface or more. A wall across a body is smaller than either side.
@returns how many triangles were dropped. */
int DropFins(TriMesh& mesh);

/** Drops open shells of at most this share of the surface. @returns how many triangles. */
int DropLooseSheets(double max_share, TriMesh& mesh);

/** Drops vertices that no triangle uses: they would count for the size. The order is kept. */
void DropUnusedVertices(TriMesh& mesh);

}  // namespace graspbench
