#pragma once
/** @file
Visual meshes of the project's hands, generated from a few numbers so that they can be changed and
regenerated. They do not affect contact, which uses the `<collision>` shapes of hand.urdf. */

#include <map>
#include <string>

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** All meshes by their path below core/hand/models, e.g. "shadow/meshes/palm.obj", each in its
link's frame [m]. */
std::map<std::string, TriMesh> MakeHandVisuals();

}  // namespace graspbench
