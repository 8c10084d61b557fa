#pragma once
/** @file
Files that are larger than what should be held of them. */

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

namespace graspbench {

/** Hands a file over piece by piece until `take` gives false. Regular files only: a device or a
pipe is refused, not waited for. @param start  the first byte that is read.
@throws Error(kNotFound, kIo) naming the file and the system's reason; what `take` throws. */
void ReadPieces(const std::filesystem::path& path,
                const std::function<bool(std::string_view)>& take, uintmax_t start = 0);

}  // namespace graspbench
