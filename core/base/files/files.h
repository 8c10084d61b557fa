#pragma once
/** @file
Files: whole ones, those larger than what should be held of them, and where the project's own data
lie. */

#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <memory>
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

/** 16 hexadecimal digits that nobody can predict, for names of temporary files. Never in results. */
std::string MakeRandomName();

/** The name of a file, for one beside it: a long one ends in its hash, so that with an ending of up
to 54 bytes it has at most 255, which is what file systems take. */
std::string ShortenName(const std::string& name);

/** Regular files only: a device or a pipe is refused, not waited for. A read that fails in passing
(ESTALE, EIO, EINTR, as on disks over the network) is tried four times within a second.
@throws Error(kNotFound, kIo) naming the file and the system's reason. */
std::string ReadFile(const std::filesystem::path& path);

/** Hands a file over piece by piece until `take` gives false. Files and failures as in ReadFile.
@param start  the first byte that is read.
@throws Error(kNotFound, kIo) naming the file and the system's reason; what `take` throws. */
void ReadPieces(const std::filesystem::path& path,
                const std::function<bool(std::string_view)>& take, uintmax_t start = 0);

/** A file as a stream. Files and failures as in ReadFile, also later, by what reads the stream.
@throws Error(kNotFound, kIo). */
std::unique_ptr<std::istream> OpenStream(const std::filesystem::path& path);

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

/** The whole content by AtomicFile (below).
@throws Error(kIo) with the system's reason (disk full, read-only, ...). */
void WriteFileAtomically(const std::filesystem::path& path, std::string_view content);

/** Creates or replaces a file without waiting for the disk: for one of many, which nobody may trust
before SyncFileSystem and a last file that says they are complete.
@throws Error(kIo) with the system's reason. */
void WriteFile(const std::filesystem::path& path, std::string_view content);

/** Waits until everything written to the disk of this folder is there.
@throws Error(kIo) with the system's reason. */
void SyncFileSystem(const std::filesystem::path& folder);

/** A file that is written piece by piece beside its target, synced and renamed by Commit: the target
is the old or the new file, never half of one. Without Commit nothing is left. What killed processes
of this host left beside the target is removed. Nobody can prepare a file or a link in its place: the
name is random and must be new. */
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

  std::filesystem::path path_;
  std::string temporary_;
  std::string gathered_;
  int file_ = -1;
  bool is_committed_ = false;
};

}  // namespace graspbench
