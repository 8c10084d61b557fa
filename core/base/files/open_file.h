#pragma once
/** @file
Opens a file as a descriptor that can be passed to another process. */

#include <filesystem>

namespace graspbench {

/** Opens a regular file for reading; accepts and retries as ReadFile (files.h). The caller closes
the descriptor. @throws Error(kNotFound, kIo). */
int OpenRegularFile(const std::filesystem::path& path);

}  // namespace graspbench
