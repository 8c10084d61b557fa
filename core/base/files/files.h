#pragma once
/** @file
Access to files, as a whole or in pieces, and the location of the project's data. */

#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <memory>
#include <string>
#include <string_view>

namespace graspbench {

/** Returns the folder that contains `core/hand/models` and `objects/catalogue`. It is the
environment variable GRASPBENCH_HOME, else share/graspbench of the installed program, else the
source folder that this program was built from. */
std::filesystem::path FindDataRoot();

/** Returns the folder for files that can be rebuilt at any time: $XDG_CACHE_HOME/graspbench, else
$HOME/.cache/graspbench, else a private folder in the system's temporary folder, which is created.
If that folder is a link or owned by another user, the returned path is not writable. */
std::filesystem::path FindCacheRoot();

/** Returns 16 unpredictable hexadecimal digits for the name of a temporary file. Never used in
results. */
std::string MakeRandomName();

/** Returns a file's name for building the name of a file beside it. A name above 200 bytes is cut
and ends in its hash. With a suffix of up to 54 bytes the result has at most 255 bytes, the limit of
file systems. */
std::string ShortenName(const std::string& name);

/** Reads a regular file; a device or a pipe is refused without blocking. A read that fails
transiently (ESTALE, EIO, EINTR, as on network file systems) is attempted four times within a
second.
@throws Error(kNotFound, kIo) naming the file and the system's reason. */
std::string ReadFile(const std::filesystem::path& path);

/** Passes a file to `take` piece by piece until `take` returns false. Accepts and retries as
ReadFile.
@param start  offset of the first byte to read.
@throws Error(kNotFound, kIo) naming the file and the system's reason; whatever `take` throws. */
void ReadPieces(const std::filesystem::path& path,
                const std::function<bool(std::string_view)>& take, uintmax_t start = 0);

/** Opens a file as a stream. Accepts and retries as ReadFile. Reading from the stream can throw as
well. @throws Error(kNotFound, kIo). */
std::unique_ptr<std::istream> OpenStream(const std::filesystem::path& path);

/** Creates a folder and its parents; an existing folder is accepted.
@throws Error(kIo) with the system's reason. */
void MakeFolder(const std::filesystem::path& folder);

/** Creates a folder that only its owner can enter, and its parents. An existing folder is made
private.
@throws Error(kIo) with the system's reason, or when it is not a folder or has another owner. */
void MakePrivateFolder(const std::filesystem::path& folder);

/** Returns whether this is a folder, not a link to one, that belongs to this user and that nobody
else can write to. */
bool IsPrivateFolder(const std::filesystem::path& folder);

/** Makes the names of new and renamed files in a folder survive a power failure.
@throws Error(kIo) with the system's reason. */
void SyncFolder(const std::filesystem::path& folder);

/** Writes the whole content through AtomicFile (below).
@throws Error(kIo) with the system's reason (disk full, read-only, ...). */
void WriteFileAtomically(const std::filesystem::path& path, std::string_view content);

/** Creates or replaces a file without waiting for the disk. Meant for one of many files that are
valid only after SyncFileSystem and a final file that marks them as complete.
@throws Error(kIo) with the system's reason. */
void WriteFile(const std::filesystem::path& path, std::string_view content);

/** Waits until everything written to this folder's file system is on the disk.
@throws Error(kIo) with the system's reason. */
void SyncFileSystem(const std::filesystem::path& folder);

/** A file that is written in pieces beside its target. Commit syncs it and renames it to the
target, so that the target is the old or the new file, never a partial one. Without Commit nothing
is left. Leftovers of killed processes of this host are removed. The temporary name is random and
must be new, so that nobody can plant a file or a link there. */
class AtomicFile {
 public:
  /** @throws Error(kIo) with the system's reason (read-only, no such folder, ...). */
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /** Buffers small pieces. @throws Error(kIo) with the system's reason (disk full, ...). */
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
