#pragma once
/** @file
A cache of results that are expensive to compute, in files below FindCacheRoot(). A file contains
its kind, a hash of everything that the result was computed from (its key) and a hash of its
content. A file that is damaged or has another kind or key counts as missing. The folder is readable
by its owner only; a folder that is not private or not writable is not used. Processes that write
the same result concurrently write the same bytes.

A change of a rule must change the kind, unless the key includes program_sources() (version.h). */

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace graspbench {

inline constexpr size_t kKeptKindSize = 8;

/** Returns what Keep() wrote for this kind and key; nullopt if the result must be computed.
@param kind  exactly kKeptKindSize characters. */
std::optional<std::string> ReadKept(const std::filesystem::path& path, std::string_view kind,
                                    uint64_t key);

/** Creates the folder and replaces the file. If that fails (folder read-only, full, or owned by
another user), nothing is stored, and the next run computes the result again. */
void Keep(const std::filesystem::path& path, std::string_view kind, uint64_t key,
          std::string_view content);

}  // namespace graspbench
