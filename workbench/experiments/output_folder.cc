#include "workbench/experiments/output_folder.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/version.h"
#include "datasets/journal/file_lock.h"
#include "datasets/journal/manifest.h"
#include "datasets/journal/store_kind.h"
#include "datasets/session/ro_crate.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kLock[] = ".lock";  // in a folder that is being filled
const std::string kLockOwner = kLock + kOwnerEnding;
constexpr char kAside[] = ".old";  // the older result while it changes places with the new one

[[noreturn]] void Refuse(const fs::path& path, const std::string& text) {
  throw Error(ErrorKind::kUsage, "\"" + path.string() + "\" " + text);
}

[[noreturn]] void FailOnSystem(const std::string& doing, const fs::path& path) {
  throw Error(ErrorKind::kIo, doing + " \"" + path.string() + "\": " + std::strerror(errno));
}

void CheckName(const fs::path& path) {
  if (path.empty()) {
    throw Error(ErrorKind::kUsage, "the name of the output is empty; expected a file or folder");
  }
}

/** The path without links and dots; its last parts need not be there. */
fs::path FindPlace(const fs::path& path) {
  std::error_code status;
  fs::path place = fs::absolute(path, status);
  if (!status) place = fs::weakly_canonical(place, status);
  if (status)
    throw Error(ErrorKind::kIo, "cannot use \"" + path.string() + "\": " + status.message());
  return place.has_filename() ? place : place.parent_path();
}

bool IsWithin(const fs::path& inner, const fs::path& outer) {
  const auto mismatch = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return mismatch.first == outer.end();
}

/** The root of the file system counts as one. */
bool IsMountPoint(const fs::path& folder) {
  struct stat own {
  }, above{};
  if (::stat(folder.c_str(), &own) != 0 || ::stat((folder / "..").c_str(), &above) != 0)
    return false;
  return own.st_dev != above.st_dev || own.st_ino == above.st_ino;
}

/** A result that this folder is or is inside of; empty: none. */
fs::path FindResultAround(fs::path folder) {
  for (; !folder.empty(); folder = folder.parent_path()) {
    if (fs::is_directory(folder) && (FindStoreKind(folder) || FindManifest(folder))) return folder;
    if (folder == folder.root_path()) break;
  }
  return {};
}

void CheckPlace(const OutputRequest& request, const fs::path& place) {
  const char* home = std::getenv("HOME");
  if (home && *home && place == FindPlace(home)) {
    Refuse(request.folder, "is your home folder; name a new folder for the results");
  }
  if (IsMountPoint(place)) {
    Refuse(request.folder, "is a mount point; name a new folder for the results");
  }
  // It would be swapped away from under the feet of the shell.
  std::error_code gone;  // a folder that was removed is no place to stand in
  if (const fs::path here = fs::current_path(gone); !gone && IsWithin(here, place)) {
    Refuse(request.folder, "is the folder you are in; name a new folder for the results");
  }
  for (const fs::path& input : request.inputs) {
    if (input.empty() || !fs::exists(input)) continue;
    if (IsWithin(FindPlace(input), place)) {
      Refuse(request.folder, "holds \"" + input.string() +
                                 "\", which is read; name another folder for the results");
    }
  }
}

}  // namespace

void CheckOutside(const fs::path& folder, const fs::path& input) {
  CheckName(folder);
  if (!IsWithin(FindPlace(folder), FindPlace(input))) return;
  Refuse(folder, "is \"" + input.string() +
                     "\", which is read, or lies in it; name another folder for the results");
}

namespace {

/** Regular files and whatever else is no folder but the lock, relative to it, sorted. */
std::vector<std::string> ListFiles(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path() == folder / kLock || entry.path() == folder / kLockOwner) continue;
    if (!entry.is_directory() || entry.is_symlink()) {
      files.push_back(entry.path().lexically_relative(folder).string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/** Files that were added, changed or replaced by links since the manifest was written. */
std::vector<std::string> ListForeign(const fs::path& folder, const Manifest& manifest,
                                     const std::vector<std::string>& derived) {
  std::vector<std::string> foreign;
  for (const Damage& damage : FindDamage(folder, manifest)) foreign.push_back(damage.path);
  for (const std::string& file : ListFiles(folder)) {
    const bool is_listed = file == kManifestFile ||
                           std::count(derived.begin(), derived.end(), file) > 0 ||
                           std::any_of(manifest.files.begin(), manifest.files.end(),
                                       [&](const ManifestFile& own) { return own.path == file; });
    if (!is_listed || fs::is_symlink(folder / file)) foreign.push_back(file);
  }
  std::sort(foreign.begin(), foreign.end());
  return foreign;
}

/** "a", "b" and 3 more. */
std::string FormatSome(const std::vector<std::string>& names) {
  constexpr size_t kMaxShown = 3;
  std::string text;
  for (size_t i = 0; i < names.size() && i < kMaxShown; ++i) {
    text += (i > 0 ? ", \"" : "\"") + names[i] + "\"";
  }
  if (names.size() > kMaxShown)
    text += " and " + std::to_string(names.size() - kMaxShown) + " more";
  return text;
}

void CheckContent(const OutputRequest& request, const fs::path& place) {
  const std::optional<Manifest> manifest = FindManifest(place);
  if (!manifest || request.kind.empty() || manifest->kind != request.kind) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(place)) {
      names.push_back(entry.path().filename().string());
    }
    if (names.empty()) return;
    std::sort(names.begin(), names.end());
    const std::string what = request.kind.empty() ? "" : " and is no earlier " + request.kind;
    Refuse(request.folder,
           "holds " + FormatSome(names) + what + "; name a new or empty folder for the results");
  }
  const std::vector<std::string> foreign = ListForeign(place, *manifest, request.derived);
  if (!foreign.empty()) {
    Refuse(request.folder, "holds " + FormatSome(foreign) + ", added or changed since its " +
                               request.kind +
                               " was written; move that away or name another folder");
  }
  if (!request.replace) {
    Refuse(request.folder, "holds an earlier " + request.kind +
                               "; --replace writes the new one in its place, or name another "
                               "folder");
  }
}

/** In one step where the file system can. */
void Exchange(const fs::path& a, const fs::path& b) {
  if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return;
  const fs::path aside = a.string() + kAside;
  if (::rename(b.c_str(), aside.c_str()) != 0 || ::rename(a.c_str(), b.c_str()) != 0 ||
      ::rename(aside.c_str(), a.c_str()) != 0) {
    FailOnSystem("cannot move the results to", b);
  }
}

/** The lock goes last: a program that is killed on the way leaves what the next one removes. */
void RemoveStaged(const fs::path& folder) {
  std::error_code status;
  for (const auto& entry : fs::directory_iterator(folder, status)) {
    if (entry.path().filename() != kLock) fs::remove_all(entry.path(), status);
  }
  fs::remove(folder / kLock, status);
  fs::remove(folder, status);
}

std::string NameStaged(const fs::path& target) {
  return "." + ShortenName(target.filename().string()) + ".part-";
}

/** Removes what killed programs left beside the target: nobody holds its lock any more. */
void RemoveAbandoned(const fs::path& target) {
  const std::string head = NameStaged(target);
  std::error_code status;
  std::vector<fs::path> staged;
  for (const auto& entry : fs::directory_iterator(target.parent_path(), status)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(head, 0) == 0 && entry.path().extension() != kAside) {
      staged.push_back(entry.path());
    }
  }
  for (const fs::path& folder : staged) {
    const int lock = ::open((folder / kLock).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (lock < 0) {
      fs::remove(folder, status);  // where it is empty; any other without a lock is not ours
      continue;
    }
    if (FileLock(lock, folder / kLock).is_held()) RemoveStaged(folder);
    ::close(lock);
  }
}

/** By its way from the result when both lie in one folder, else by its name: nothing says where a
person keeps other things. */
void AddSource(const fs::path& input, const fs::path& target, ManifestOrigin& origin) {
  if (input.empty()) return;
  fs::path place = fs::weakly_canonical(input);
  if (!place.has_filename()) place = place.parent_path();
  const std::string sha256 = CalcSourceSha256(place);
  if (sha256.empty()) return;
  const fs::path way = place.lexically_relative(target.parent_path());
  const bool is_near = !way.empty() && *way.begin() != "..";
  origin.inputs.push_back({(is_near ? ".." / way : place.filename()).generic_string(), sha256});
}

}  // namespace

void CheckOutputFolder(const OutputRequest& request) {
  CheckName(request.folder);
  const fs::path place = FindPlace(request.folder);
  const fs::file_status status = fs::symlink_status(place);
  CheckPlace(request, place);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) {
    Refuse(request.folder, "exists and is not a folder; name a new folder for the results");
  }
  CheckContent(request, place);
}

void CheckOutsideResults(const fs::path& path) {
  const fs::path result = FindResultAround(FindPlace(path).parent_path());
  if (result.empty()) return;
  Refuse(path, "is inside \"" + result.string() +
                   "\", which holds only a result of graspbench; name another folder");
}

void CheckOutputFile(const fs::path& file) {
  CheckName(file);
  if (!file.has_filename()) {
    Refuse(file, "ends in a slash, as the name of a folder does; name a new file");
  }
  const fs::file_status status = fs::symlink_status(file);
  if (fs::is_directory(status)) Refuse(file, "is a folder; name a new file");
  if (fs::exists(status)) Refuse(file, "is already there; remove it or name another file");
  // Whoever computes for an hour first would then find that no folder can be made there.
  fs::path folder = FindPlace(file).parent_path();
  while (!fs::exists(folder)) folder = folder.parent_path();
  if (!fs::is_directory(folder)) {
    Refuse(file, "is below \"" + folder.string() + "\", which is not a folder");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    Refuse(file, "cannot be written: no permission for \"" + folder.string() + "\"");
  }
  CheckOutsideResults(file);
}

void WriteOutputFile(const fs::path& file, const std::string& content) {
  CheckOutputFile(file);  // also what has come into the way since
  MakeFolder(FindPlace(file).parent_path());
  WriteFileAtomically(file, content);
}

std::vector<std::string> ListStoreFiles(const fs::path& folder) {
  const StoreKind* kind = FindStoreKind(folder);
  if (!kind) return {};
  std::vector<std::string> files = ListMatches(folder, kind->journals);
  files.insert(files.end(), {"run.json", "index.sqlite"});
  for (const std::string& output : kind->outputs) {
    const std::optional<Manifest> manifest = FindManifest(folder / output);
    if (!manifest || !FindDamage(folder / output, *manifest).empty()) continue;
    files.push_back(output + "/" + kManifestFile);
    for (const ManifestFile& file : manifest->files) files.push_back(output + "/" + file.path);
  }
  return files;
}

StagedFolder::StagedFolder(OutputRequest request, Mark mark)
    : request_(std::move(request)), mark_(mark) {
  CheckOutputFolder(request_);
  target_ = FindPlace(request_.folder);
  MakeFolder(target_.parent_path());
  RemoveAbandoned(target_);
  staged_ = target_.parent_path() / (NameStaged(target_) + MakeRandomName());
  while (!TryStage()) {
  }
}

StagedFolder::~StagedFolder() {
  if (!staged_.empty()) RemoveStaged(staged_);
  lock_.reset();
  if (lock_file_ >= 0) ::close(lock_file_);
}

bool StagedFolder::TryStage() {
  if (::mkdir(staged_.c_str(), 0777) != 0) FailOnSystem("cannot create", staged_);
  const fs::path path = staged_ / kLock;
  lock_file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (lock_file_ < 0) {
    if (errno == ENOENT) return false;
    const int reason = errno;
    ::rmdir(staged_.c_str());
    errno = reason;
    FailOnSystem("cannot lock", staged_);
  }
  try {
    lock_.emplace(lock_file_, path);
    if (lock_->is_held() && fs::exists(path)) return true;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kIo || fs::exists(path)) {
      RemoveStaged(staged_);
      throw;
    }
  }
  lock_.reset();
  ::close(std::exchange(lock_file_, -1));
  RemoveStaged(staged_);
  return false;
}

void StagedFolder::Commit() {
  if (!request_.kind.empty() && mark_ == Mark::kWhole) {
    Manifest manifest;
    manifest.kind = request_.kind;
    manifest.versions = {{"program", program_version()}};
    manifest.origin = MakeOrigin(request_.command);
    for (const fs::path& input : request_.inputs) AddSource(input, target_, *manifest.origin);
    for (const std::string& file : ListFiles(staged_)) {
      manifest.files.push_back(SealFile(staged_, file));
    }
    SyncFileSystem(staged_);
    WriteManifest(staged_, manifest);
  }
  CheckOutputFolder(request_);
  const bool is_swap = fs::exists(target_) && !fs::is_empty(target_);
  if (is_swap) {
    WriteFileAtomically(target_ / kLock, "");  // of the older result, should its removal be killed
    Exchange(staged_, target_);
  } else if (::rename(staged_.c_str(), target_.c_str()) != 0) {
    FailOnSystem("cannot move the results to", target_);
  }
  // Not before: without its lock, what a killed program leaves beside the target would stay there.
  lock_.reset();
  fs::remove(target_ / kLockOwner);  // its path has changed
  fs::remove(target_ / kLock);
  SyncFolder(target_.parent_path());
  if (is_swap) RemoveStaged(staged_);  // the older result
  staged_.clear();
}

}  // namespace graspbench
