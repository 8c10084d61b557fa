#pragma once
/** @file
ImportHand behind the fence (core/fence/fence.h), since a foreign description may be damaged or
malicious. Its meshes are read by readers that graspbench-reader starts. */

#include <string>

#include "core/fence/serve_fence.h"
#include "core/hand/import/import_hand.h"

namespace graspbench {

inline constexpr int kHandImportSeconds = 300;  // processor time: shapes are fitted to meshes

/** As ImportHand, for the file `source.file`; `source.load_mesh` is ignored.
@throws Error(kNotFound, kIo, kFormat, kEnvironment) as Fence::Read. */
ImportedFiles ImportHandFile(const HandSource& source, const std::string& palm,
                             Diagnostics& problems);

/** The reader of hands in graspbench-reader. @param load_mesh  loads the description's meshes. */
FencedReader MakeHandReader(MeshLoader load_mesh);

}  // namespace graspbench
