#pragma once
/** @file
How far a session, a campaign or an optimisation is, by its journals alone, in words. */

#include <filesystem>
#include <string>

#include "core/base/text/json.h"

namespace graspbench {

struct FolderStatus {
  std::string text;    ///< lines; the first one of each store counts what is finished
  std::string notes;   ///< what a reader should know besides; empty: nothing
  std::string damage;  ///< what cannot be relied on, and where; empty: nothing
  Json json;
  int num_done = 0, num_all = 0;  ///< trials, scenes or held grasps of what runs now
  bool is_finished = false;
};

/** @param stale_after  as in ReadProgress. @throws Error(kNotFound, kFormat, kIo) when the folder
holds none of these or cannot be read. */
FolderStatus ReadFolderStatus(const std::filesystem::path& folder, double stale_after);

}  // namespace graspbench
