#pragma once
/** @file
A file as the system's number, for who hands it to another process. */

#include <filesystem>

namespace graspbench {

/** Opens a regular file for reading, with the patience and the refusals of ReadFile (files.h); who
calls closes it. @throws Error(kNotFound, kIo). */
int OpenRegularFile(const std::filesystem::path& path);

}  // namespace graspbench
