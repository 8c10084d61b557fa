#pragma once
/** @file
The lock of an open file against other programs (flock), which ends when the file is closed. */

#include <filesystem>
#include <string>

namespace graspbench {

enum class FileLock {
  kHeld,    ///< by this program
  kTaken,   ///< by another one
  kMissing  ///< the file system has no locks, as some of clusters: nobody notices a second program
};

/** Does not wait. Where locks are missing, the function of WarnOfMissingLocks is called.
@param file  open for writing.
@param path  what is locked, for messages. @throws Error(kIo) with the system's reason. */
FileLock LockFile(int file, const std::filesystem::path& path);

/** From now on `warn` is called with a sentence for the user, once a process. */
void WarnOfMissingLocks(void (*warn)(const std::string& text));

}  // namespace graspbench
