#pragma once
/** @file What `graspbench object check` does with a mesh file. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "core/shape/mesh_check.h"
#include "objects/length_unit.h"

namespace graspbench {

/** @throws as LoadMesh() when the file cannot be read at all. */
MeshReport CheckMeshFile(const std::filesystem::path& path, LengthUnit unit);

struct MeshFileRepair {
  std::vector<std::string> actions;  ///< what was done; empty: nothing could be
  MeshReport report;                 ///< of the repaired mesh
};
/** Writes the repaired mesh (mesh_repair.h) as OBJ in the same unit, unless nothing could be
repaired.
@throws also Error(kIo). */
MeshFileRepair RepairMeshFile(const std::filesystem::path& path, LengthUnit unit,
                              const std::filesystem::path& repaired_path);

/** {"closed", "triangles", "open_edges", "volume_m3", "centroid_m", "extent_m", "problems"};
volume, centroid and extent are null where they mean nothing. */
Json FormatMeshReport(const MeshReport& report);

}  // namespace graspbench
