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

/** The unit of a mesh's numbers from the largest extent of its bounding box in these numbers.
Things to grasp measure 2 mm to 1 m, so 0.002 to 1 are metres and 2 to 1000 are millimetres; nothing
otherwise. A mesh in centimetres or inches looks like a small one in millimetres: say what was
inferred. */
std::optional<LengthUnit> InferLengthUnit(double largest_extent);

/** A mesh file in metres, and how its unit is known. */
struct CheckedMeshFile {
  TriMesh mesh;                      ///< mended where that makes it usable (mesh_repair.h)
  std::vector<std::string> actions;  ///< how it was mended
  MeshReport report;                 ///< of `mesh`
  LengthUnit unit = LengthUnit::kM;
  bool is_unit_inferred = false;  ///< not given, but shown by the size
};
/** Without a unit it is inferred; where the size shows none, a problem of the report asks for it,
and `unit` means nothing.
@throws as LoadMesh() when the file cannot be read at all. */
CheckedMeshFile CheckMeshFile(const std::filesystem::path& path, std::optional<LengthUnit> unit,
                              PartsApart parts_apart = PartsApart::kRefused);

struct MeshFileRepair {
  std::vector<std::string> actions;  ///< what was done; empty: nothing could be
  MeshReport report;                 ///< of the repaired mesh
  bool is_written = false;           ///< it can be used
};
/** Repairs a mesh that cannot be used (mesh_repair.h) and writes the result as OBJ in the same
unit, but only if it can be used: no file is ever worse than the one it was made from.
@throws Error(kIo). */
MeshFileRepair RepairMeshFile(const CheckedMeshFile& file,
                              const std::filesystem::path& repaired_path);

/** {"usable", "closed", "triangles", "open_edges", "volume_m3", "centroid_m", "extent_m",
"problems", "warnings"}; volume, centroid and extent are null where they mean nothing. */
Json FormatMeshReport(const MeshReport& report);

}  // namespace graspbench
