#pragma once
/** @file
One mesh file, as a fuzzer or a replayed case gives it. */

#include <string>

#include "core/base/error.h"
#include "core/shape/mesh_check.h"
#include "core/shape/mesh_repair.h"
#include "objects/load_mesh.h"

namespace graspbench {

/** Reads, checks, repairs and checks again; an Error(kFormat) is a fine answer. A mesh without
problems must have a volume. */
inline void FuzzMesh(const std::string& bytes, const std::string& name) {
  try {
    const TriMesh mesh = ParseMesh(bytes, name, LengthUnit::kMm);
    for (const MeshReport& report : {CheckMesh(mesh), CheckMesh(RepairMesh(mesh).mesh)}) {
      GRASPBENCH_DEMAND(!report.problems.empty() || report.volume > 0.0,
                        std::to_string(report.volume));
    }
  } catch (const Error& e) {
    GRASPBENCH_DEMAND(e.kind() == ErrorKind::kFormat, e.what());
  }
}

}  // namespace graspbench
