#pragma once
/** @file
Locks a file against other programs; all locks of the project follow this rule.

A lock has two parts. One is flock of the open file, which ends with the process. Some cluster file
systems lack it (ENOSYS, ENOLCK), others grant it without informing other machines. The other is an
owner file, `<file>.owner`, with host, boot, process namespace, process and its start time; it is
removed when the lock is released. The owner file of a killed program is taken over if that program
has certainly ended: same boot, same namespace, and no such process. Whether any other owner still
runs is unknown, so the user decides by removing the owner file. */

#include <filesystem>
#include <string>

namespace graspbench {

inline const std::string kOwnerEnding = ".owner";

class FileLock {
 public:
  /** Takes the lock unless another process holds it; does not wait.
  @param file  open for writing; must outlive this.
  @param path  of the file. @throws Error(kIo) with the system's reason. */
  FileLock(int file, std::filesystem::path path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  bool is_held() const { return is_held_; }
  /** If another process holds the lock: who, and how to take it over; empty for this machine. */
  const std::string& holder() const { return holder_; }

 private:
  std::filesystem::path path_;
  std::string owner_;  // contents of the owner file while the lock is held
  std::string holder_;
  bool is_held_ = false;
};

/** Whether another process holds the lock, as far as this machine can know; an owner that has
certainly ended does not. False if there is no such file. */
bool IsLocked(const std::filesystem::path& path);

/** Removes the owner file of a program that has certainly ended. */
void RemoveLeftOwner(const std::filesystem::path& path);

}  // namespace graspbench
