#pragma once
/** @file
A file that is written piece by piece and is there when it is whole. */

#include <filesystem>
#include <string>
#include <string_view>

namespace graspbench {

/** False, and errno says why, when not all of it could be written. */
[[nodiscard]] bool WriteAll(int file, std::string_view content);

/** Written beside the target, synced and renamed by Commit: the target is the old or the new file,
never half of one. Without Commit nothing is left. What killed processes of this host left beside
the target is removed. */
class AtomicFile {
 public:
  /** @throws Error(kIo) with the system's reason (read-only, no such folder, ...). */
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /** Small pieces are gathered. @throws Error(kIo) with the system's reason (disk full, ...). */
  void Write(std::string_view piece);
  /** @throws Error(kIo). */
  void Commit();

 private:
  void Flush();
  [[noreturn]] void Fail(const char* what) const;

  std::filesystem::path path_;
  std::string temporary_;
  std::string gathered_;
  int file_ = -1;
  bool is_committed_ = false;
};

}  // namespace graspbench
