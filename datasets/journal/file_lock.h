#pragma once
/** @file
The lock of a file against other programs: one rule for every lock of the project.

Two things together. flock of the open file, which ends with its process, but which some file
systems of clusters lack (ENOSYS, ENOLCK) and others grant without telling other machines. And an
owner file beside it, `<file>.owner`: host, boot, process namespace, process and its start. It is
removed when the lock is given back. What a killed program left is taken over where that program
certainly has ended: same boot, same namespace, and no such process. Of any other owner nobody here
knows whether it lives, so a person decides, by removing the owner file. */

#include <filesystem>
#include <string>

namespace graspbench {

inline const std::string kOwnerEnding = ".owner";

class FileLock {
 public:
  /** Takes the lock unless somebody has it. Does not wait for who has it.
  @param file  open for writing; outlives this.
  @param path  its name. @throws Error(kIo) with the system's reason. */
  FileLock(int file, std::filesystem::path path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  bool is_held() const { return is_held_; }
  /** Of a lock that somebody else has: who, and how it is taken over; empty: of this machine. */
  const std::string& holder() const { return holder_; }

 private:
  std::filesystem::path path_;
  std::string owner_;  // what the owner file holds while this has the lock
  std::string holder_;
  bool is_held_ = false;
};

/** Whether somebody has the lock of the file, as far as this machine can know: an owner that
certainly has ended has not. False where there is no such file. */
bool IsLocked(const std::filesystem::path& path);

/** Removes the owner file of a program that certainly has ended. */
void RemoveLeftOwner(const std::filesystem::path& path);

}  // namespace graspbench
