#pragma once
/** @file
How far a session, a campaign, an optimisation or a development is, in words: through the door of
every reader (sealed_store.h), so that no number comes from a store that is damaged. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/text/json.h"

namespace graspbench {

struct FolderStatus {
  std::string text;                ///< lines; the first one of each store counts what is finished
  std::vector<std::string> steps;  ///< those that count, without how long ago
  std::string notes;               ///< what a reader should know besides; empty: nothing
  std::string damage;              ///< what cannot be relied on, and where; empty: nothing
  bool is_checked = false;         ///< as by `verify`: every byte
  Json json;
  int num_done = 0, num_all = 0;  ///< trials, scenes or held grasps of what runs now
  bool is_finished = false;
};

enum class StatusLook {
  kVerified,  ///< as `verify` does
  kQuick,     ///< the same up to kMostChecked; above that it counts
  kCounted    ///< lines of journals, by their indices or by what is sealed; files by their lengths
};
/** A processor takes some half a second for it [bytes]. */
inline constexpr uintmax_t kMostChecked = 30'000'000;

/** What is being written while it is looked at is looked at again, so that it is no damage.
@param stale_after  as in ReadProgress. @throws Error(kNotFound, kFormat, kIo) when the folder holds
none of these or cannot be read. */
FolderStatus ReadFolderStatus(const std::filesystem::path& folder, double stale_after,
                              StatusLook look = StatusLook::kQuick);

/** What a person is told of a status that is not checked. */
std::string DescribeUncheckedStatus(const std::filesystem::path& folder);

}  // namespace graspbench
