#pragma once
/** @file
Repairs that cannot change what a mesh means: what its maker obviously forgot. Large holes and
surfaces that cut through each other need a modelling program. */

#include <string>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

struct MeshRepair {
  TriMesh mesh;
  std::vector<std::string> actions;  ///< what was done, one sentence each; empty: nothing
};

/** Holes with more edges than this, or longer around than the mesh's largest extent, stay open. */
inline constexpr int kMaxHoleEdges = 64;

/** In this order: merges vertices closer than a millionth of the extent, drops triangles without
area and copies, turns neighbours to face the same way, closes small holes with a fan about their
middle, turns every shell so that it encloses its solid (shells inside another one become cavities).
Check the result again: what could not be repaired is still there.
@pre valid indices; a mesh with non-finite vertices comes back as it is. */
MeshRepair RepairMesh(const TriMesh& mesh);

}  // namespace graspbench
