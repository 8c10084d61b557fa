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
$HOME/.cache/graspbench, else a folder of this user's own in the system's temporary folder, which is
made; where that is somebody else's or a link, a place in which nothing can be made. */
std::filesystem::path FindCacheRoot();

/** Regular files only: a device or a pipe is refused, not waited for.
@throws Error(kNotFound, kIo) naming the file and the system's reason. */
std::string ReadFile(const std::filesystem::path& path);

/** Creates a folder and those above it; one that is there is fine.
@throws Error(kIo) with the system's reason. */
void MakeFolder(const std::filesystem::path& folder);

/** Creates a folder that only its owner can enter, and those above it; one that is there is made
so.
@throws Error(kIo) when it belongs to somebody else, is no folder, or with the system's reason. */
void MakePrivateFolder(const std::filesystem::path& folder);

/** A folder, not a link to one, that belongs to this user and that nobody else can write into. */
bool IsPrivateFolder(const std::filesystem::path& folder);

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
