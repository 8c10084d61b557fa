#pragma once
/** @file
Results that take time to compute, kept between runs in files below FindCacheRoot(). A file carries
its kind, the hash of all that the result was computed from (its key) and a hash of its content: a
damaged file, or one of another kind or key, is as good as absent. The folder is made readable for
its owner alone; one that is not private, or cannot be written, is done without. Processes that keep
one result at a time write the same bytes.

Whoever changes a rule changes the kind, or puts program_sources() (version.h) into the key. */

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace graspbench {

inline constexpr size_t kKeptKindSize = 8;

/** What Keep() wrote for this kind and key; nothing where it has to be computed.
@param kind  of kKeptKindSize characters. */
std::optional<std::string> ReadKept(const std::filesystem::path& path, std::string_view kind,
                                    uint64_t key);

/** Makes the folder, and replaces the file. A folder that is read-only, full or somebody else's
costs the next run the computation, and nothing else. */
void Keep(const std::filesystem::path& path, std::string_view kind, uint64_t key,
          std::string_view content);

}  // namespace graspbench
