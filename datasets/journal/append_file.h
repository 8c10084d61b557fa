#pragma once
/** @file
A file of lines that only grows: locked against a second writer, each Append on the disk when it
returns. A line that a crash has torn stays where it is; the next one starts on a line of its own.
*/

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace graspbench {

/** False when there is no such file. */
bool EndsInTornLine(const std::filesystem::path& path);

/** Whether a process of this machine holds it open to append, now. False where there is no such
file and on a file system without locks. */
bool IsBeingWritten(const std::filesystem::path& path);

class AppendFile {
 public:
  /** A file system without locks is written without one, after a warning (WarnOfMissingLocks).
  @throws Error(kIo) when it cannot be written or another process writes it. */
  explicit AppendFile(const std::filesystem::path& path);
  /** @param in_use  what to say when another process writes it. */
  AppendFile(const std::filesystem::path& path, const std::string& in_use);
  ~AppendFile();
  /** @param lines  each with its line break.
  @throws Error(kIo) with the system's reason; what was appended before stays valid. */
  void Append(const std::string& lines);

  /** Of the file now, if nobody else writes it [bytes]. */
  uintmax_t size() const;

  /** Cuts off what lies behind the first `length` bytes. @throws Error(kIo). */
  void Truncate(size_t length);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** The lock of an open file against other programs (flock), which ends when the file is closed. */
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
