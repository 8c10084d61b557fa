#pragma once
/** @file
Triangle meshes for glTF in few bytes: coarse enough to be looked at, vertices as integers
(KHR_mesh_quantization): positions in 16 bits over the mesh's largest side, normals in 8.

A vertex lies within half of 1/65534 of that side of where it was, about 2 um on a hand. */

#include <Eigen/Core>

#include "core/shape/tri_mesh.h"
#include "datasets/gltf/glb_file.h"

namespace graspbench {

/** Adds accessors, material and mesh of a colour to the file.
@param share  of the triangles that are wanted, at least some 64; 1 or more: all.
@returns a node without name that holds the mesh where it was; null when nothing of it is left. */
Json AddGltfMesh(const TriMesh& mesh, const Eigen::Vector3f& colour, double share, GlbFile& file);

}  // namespace graspbench
