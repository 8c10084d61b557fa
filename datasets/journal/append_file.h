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

class AppendFile {
 public:
  /** Locks it (file_lock.h). @throws Error(kIo) when it cannot be written or another process writes
  it. */
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

}  // namespace graspbench
