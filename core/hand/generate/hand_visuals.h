#pragma once
/** @file
The looks of the project's hands: meshes made from a few numbers, so that they can be changed and
made again. They are seen only; what touches stands in hand.urdf as `<collision>`. */

#include <map>
#include <string>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** All meshes by their path below core/hand/models, e.g. "shadow/meshes/palm.obj"; each in the
frame of its link [m]. */
std::map<std::string, TriMesh> MakeHandVisuals();

}  // namespace graspbench
