#pragma once
/** @file
Whole files, and where the project's own data lie. */

#include <filesystem>
#include <string>
#include <string_view>

namespace graspbench {

/** Folder that holds `core/hand/models` and `objects/catalogue`: the environment variable
GRASPBENCH_HOME, else the source folder this program was built from. */
std::filesystem::path FindDataRoot();

/** Folder for things that can be rebuilt at any time: $XDG_CACHE_HOME/graspbench, else
$HOME/.cache/graspbench, else the system's temporary folder. */
std::filesystem::path FindCacheRoot();

/** @throws Error(kNotFound, kIo) naming the file and the system's reason; pipes and devices are
refused, because they may never end. */
std::string ReadFile(const std::filesystem::path& path);

/** Creates a folder and those above it; one that is there is fine.
@throws Error(kIo) with the system's reason. */
void MakeFolder(const std::filesystem::path& folder);

/** Makes the names of new and renamed files in a folder survive a power failure.
@throws Error(kIo) with the system's reason. */
void SyncFolder(const std::filesystem::path& folder);

/** Writes beside the target, syncs, renames: the file is the old or the new one, never half.
Removes what killed processes of this host left beside it.
@throws Error(kIo) with the system's reason (disk full, read-only, ...). */
void WriteFileAtomically(const std::filesystem::path& path, std::string_view content);

/** Creates or replaces a file without waiting for the disk: for one of many, which nobody may trust
before SyncFileSystem and a last file that says they are complete.
@throws Error(kIo) with the system's reason. */
void WriteFile(const std::filesystem::path& path, std::string_view content);

/** Waits until everything written to the disk of this folder is there.
@throws Error(kIo) with the system's reason. */
void SyncFileSystem(const std::filesystem::path& folder);

}  // namespace graspbench
