#pragma once
/** @file
An append-only file of lines, locked against a second writer; appended lines are on disk when Append
returns. An incomplete line left by a crash stays; the next line starts after a line break. */

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace graspbench {

/** Whether the last line of a file lacks its line break; false if there is no such file. */
bool EndsInTornLine(const std::filesystem::path& path);

class AppendFile {
 public:
  /** Locks the file (file_lock.h). @throws Error(kIo) when it cannot be written or another process
  writes to it. */
  explicit AppendFile(const std::filesystem::path& path);
  /** @param in_use  message if another process writes to it. */
  AppendFile(const std::filesystem::path& path, const std::string& in_use);
  ~AppendFile();
  /** @param lines  each with its line break.
  @throws Error(kIo) with the system's reason; earlier lines stay valid. */
  void Append(const std::string& lines);

  /** Size of the file, if no one else writes to it [bytes]. */
  uintmax_t size() const;

  /** Truncates the file to its first `length` bytes. @throws Error(kIo). */
  void Truncate(size_t length);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace graspbench
