#pragma once
/** @file
Things to grasp and checked meshes for a person and for a program. */

#include <string>

#include "core/base/text/json.h"
#include "core/shape/grasp_object.h"
#include "objects/check_mesh_file.h"

namespace graspbench {

struct DescribedObjects {
  Json json;          ///< {objects: [..]}
  std::string table;  ///< one row each
};
/** The catalogue. */
DescribedObjects DescribeObjects();

/** Sizes, mass, friction and best grasps. */
Json MakeObjectJson(const GraspObject& object);
std::string FormatObject(const GraspObject& object);

/** The warnings, the problems, then what the mesh is and whether it can be used. */
std::string FormatMeshSummary(const std::string& path, const MeshReport& report);

/** What a repair did, and the summary of what it has written to `path`. */
std::string FormatRepair(const std::string& path, const MeshFileRepair& repair);

}  // namespace graspbench
