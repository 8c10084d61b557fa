#pragma once
/** @file
Progress of a session, a campaign, an optimisation or a development, as text. Read through the same
integrity checks as every reader (sealed_store.h), so that no count comes from damaged data. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/text/json.h"

namespace graspbench {

struct FolderStatus {
  std::string text;  ///< lines; the first line of each store counts its finished items
  std::vector<std::string> steps;  ///< the counting lines of `text`, without elapsed times
  std::string notes;               ///< notes for the reader; empty: none
  std::string damage;              ///< what is damaged, and where; empty: nothing
  bool is_checked = false;         ///< every byte was checked, as `verify` does
  Json json;
  int num_done = 0, num_all = 0;  ///< trials, scenes or held grasps of the current stage
  bool is_finished = false;
};

enum class StatusLook {
  kVerified,  ///< as `verify` does
  kQuick,     ///< as kVerified up to kMostChecked bytes, above as kCounted
  kCounted    ///< counts journal lines by indices or seals; checks only file lengths
};
/** Size up to which kQuick checks every byte, which takes one processor about 0.5 s [bytes]. */
inline constexpr uintmax_t kMostChecked = 30'000'000;

/** Reads the status of a folder; of a developed hand that of its development. Apparent damage is
checked again after 0.1 s, because another process may be writing the store.
@param stale_after  as in ReadProgress. @throws Error(kNotFound, kFormat, kIo) when the folder holds
no such store or cannot be read. */
FolderStatus ReadFolderStatus(const std::filesystem::path& folder, double stale_after,
                              StatusLook look = StatusLook::kQuick);

/** Message for the user about an unchecked status. */
std::string DescribeUncheckedStatus(const std::filesystem::path& folder);

}  // namespace graspbench
