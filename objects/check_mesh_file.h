#pragma once
/** @file
What `graspbench object check` does with a mesh file. */

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/shape/repair/mesh_check.h"
#include "objects/mesh_limits.h"

namespace graspbench {

/** Infers the unit of a mesh's numbers from the largest extent of its bounding box. Objects to
grasp measure 2 mm to 1 m: 0.002 to 1 are taken as metres, 2 to 1000 as millimetres, other values
give nothing. A mesh in centimetres or inches looks like a small one in millimetres, so report the
inferred unit to the user. */
std::optional<LengthUnit> InferLengthUnit(double largest_extent);

/** A mesh file in metres, and how its unit is known. */
struct CheckedMeshFile {
  TriMesh mesh;                      ///< repaired where that makes it usable (mesh_repair.h)
  std::vector<std::string> actions;  ///< what the repair did
  MeshReport report;                 ///< of `mesh`
  LengthUnit unit = LengthUnit::kM;
  bool is_unit_inferred = false;  ///< inferred from the size
};
/** Reads and checks a mesh file. Infers the unit if none is given; where the size does not show it,
a problem in the report asks for it, and `unit` is meaningless.
@throws as LoadMesh() when the file cannot be read at all. */
CheckedMeshFile CheckMeshFile(const std::filesystem::path& path, std::optional<LengthUnit> unit,
                              PartsApart parts_apart = PartsApart::kRefused);

struct MeshFileRepair {
  std::vector<std::string> actions;  ///< what was done; empty: nothing could be repaired
  MeshReport report;                 ///< of the repaired mesh
  bool is_written = false;           ///< true if the repaired mesh is usable
};
/** Repairs an unusable mesh (mesh_repair.h). Writes the result as OBJ in the same unit, but only if
it is usable.
@throws Error(kIo). */
MeshFileRepair RepairMeshFile(const CheckedMeshFile& file,
                              const std::filesystem::path& repaired_path);

/** {"usable", "closed", "triangles", "open_edges", "volume_m3", "centroid_m", "extent_m",
"problems", "warnings"}; volume, centroid and extent are null where they mean nothing. */
Json FormatMeshReport(const MeshReport& report);

}  // namespace graspbench
