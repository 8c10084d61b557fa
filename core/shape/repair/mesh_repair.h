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
removed (useless_faces.h), seams and small holes closed (fill_holes.h).
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

/** A mesh as simulation can use it. */
struct UsableMesh {
  TriMesh mesh;  ///< as given when it has no problem, or when mending leaves some
  std::vector<std::string> actions;  ///< of MendMesh
  MeshReport report;                 ///< of `mesh`
};
/** Checks the mesh, mends it if it has problems, and keeps what was mended if then it has none.
@pre valid indices. */
UsableMesh MakeUsable(const TriMesh& mesh, PartsApart parts_apart = PartsApart::kRefused);

}  // namespace graspbench
