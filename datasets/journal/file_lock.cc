#include "datasets/journal/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/json.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

fs::path FindOwnerFile(const fs::path& path) {
  return path.parent_path() / (ShortenName(path.filename().string()) + kOwnerEnding);
}

/** Empty: there is none. */
std::string ReadSystemFile(const fs::path& path) {
  std::string text;
  try {
    text = ReadFile(path);
  } catch (const Error&) {
  }
  return text;
}

/** The fields behind the name in /proc/PID/stat: state, then parent, ..; the 20th is the start. */
std::vector<std::string> ReadProcess(int64_t process) {
  const std::string stat = ReadSystemFile("/proc/" + std::to_string(process) + "/stat");
  const size_t name_end = stat.rfind(") ");  // the name may have any characters
  std::vector<std::string> fields;
  for (size_t at = name_end; at != stat.npos; at = stat.find(' ', at + 1)) {
    const size_t begin = at == name_end ? at + 2 : at + 1;
    fields.push_back(stat.substr(begin, stat.find(' ', begin) - begin));
    if (at == name_end) ++at;
  }
  return fields;
}

std::string FindStart(int64_t process) {
  constexpr size_t kStart = 19;
  const std::vector<std::string> fields = ReadProcess(process);
  return fields.size() > kStart ? fields[kStart] : "";
}

struct Owner {
  std::string host, boot, processes, start;
  int64_t process = 0;
};

/** Host, boot and namespace stay as they are; a process may be a fork of another. */
Owner FindSelf() {
  static const Owner here = [] {
    Owner owner;
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    owner.host = host.data();
    constexpr size_t kUuid = 36;
    owner.boot = ReadSystemFile("/proc/sys/kernel/random/boot_id").substr(0, kUuid);
    struct stat processes {};
    ::stat("/proc/self/ns/pid", &processes);
    owner.processes = std::to_string(processes.st_ino);
    return owner;
  }();
  Owner self = here;
  self.process = ::getpid();
  self.start = FindStart(self.process);
  return self;
}

std::string FormatSelf() {
  const Owner self = FindSelf();
  return FormatJson({{"host", self.host},
                     {"boot", self.boot},
                     {"processes", self.processes},
                     {"process", self.process},
                     {"start", self.start}}) +
         "\n";
}

/** Nothing: the text is not of an owner file, or not yet all of it. */
std::optional<Owner> ParseOwner(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    return Owner{json.at("host").get<std::string>(), json.at("boot").get<std::string>(),
                 json.at("processes").get<std::string>(), json.at("start").get<std::string>(),
                 json.at("process").get<int64_t>()};
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

/** Only of those processes that this one can see. */
bool HasCertainlyEnded(const Owner& owner) {
  const Owner self = FindSelf();
  if (owner.boot.empty() || owner.boot != self.boot || owner.processes != self.processes ||
      owner.host != self.host || owner.process <= 0 || owner.process > INT32_MAX) {
    return false;
  }
  if (::kill(static_cast<pid_t>(owner.process), 0) != 0 && errno == ESRCH) return true;
  const std::vector<std::string> fields = ReadProcess(owner.process);
  if (fields.empty()) return false;
  return fields[0] == "Z" || FindStart(owner.process) != owner.start;
}

/** Of a file that may come and go; nothing: it is not there. An owner writes its file at once, so
that one that stays empty was left by a killed program: it reads as no owner. */
std::optional<std::string> ReadOwnerFile(const fs::path& path) {
  constexpr int kNumLooks = 20;
  std::string text;
  for (int look = 0; look < kNumLooks; ++look) {
    try {
      text = ReadFile(path);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kNotFound) return std::nullopt;
      throw;
    }
    if (!text.empty()) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return text;
}

bool IsLeft(const std::string& text) {
  const std::optional<Owner> owner = ParseOwner(text);
  return owner ? HasCertainlyEnded(*owner) : text.empty();
}

std::string DescribeHolder(const fs::path& owner_file, const std::string& text) {
  const std::optional<Owner> owner = ParseOwner(text);
  const std::string who = owner ? "process " + std::to_string(owner->process) + " of host \"" +
                                      owner->host + "\" has it"
                                : "\"" + owner_file.string() + "\" does not name its owner";
  return "; " + who + ". If that process has ended, take over with: rm \"" + owner_file.string() +
         "\"";
}

/** Two programs may find the same left file: who moves it away first has removed it. */
bool RemoveOwner(const fs::path& path, const std::string& text) {
  const fs::path aside = path.string() + "-" + MakeRandomName();
  if (::rename(path.c_str(), aside.c_str()) != 0) return false;
  const bool is_the_left_one = ReadSystemFile(aside) == text;
  if (!is_the_left_one) ::link(aside.c_str(), path.c_str());  // of who was faster
  ::unlink(aside.c_str());
  return is_the_left_one;
}

/** @returns whether the owner file is new and holds the text. */
bool CreateOwner(const fs::path& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (file < 0 && errno == EEXIST) return false;
  const bool is_written =
      file >= 0 && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int reason = errno;
  struct stat mine {
  }, there{};
  const bool is_mine = file >= 0 && ::fstat(file, &mine) == 0 &&
                       ::stat(path.c_str(), &there) == 0 && mine.st_ino == there.st_ino;
  if (file >= 0) ::close(file);
  if (!is_written) {
    if (is_mine) ::unlink(path.c_str());
    throw Error(ErrorKind::kIo, "cannot write \"" + path.string() + "\": " + std::strerror(reason) +
                                    (reason == ENOSPC ? "; free some space and resume" : ""));
  }
  return is_mine;  // else it was taken for left before it was written
}

bool IsWithoutLocks(int reason) {
  return reason == ENOLCK || reason == ENOSYS || reason == EOPNOTSUPP;
}

}  // namespace

FileLock::FileLock(int file, fs::path path) : path_(std::move(path)) {
  if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return;
    if (!IsWithoutLocks(errno)) {
      throw Error(ErrorKind::kIo,
                  "cannot lock \"" + path_.string() + "\": " + std::strerror(errno));
    }
  }
  const fs::path owner_file = FindOwnerFile(path_);
  const std::string self = FormatSelf();
  constexpr int kNumTries = 10;
  for (int i = 0; i < kNumTries && !is_held_; ++i) {
    is_held_ = CreateOwner(owner_file, self);
    if (is_held_) break;
    const std::optional<std::string> text = ReadOwnerFile(owner_file);
    if (!text) continue;
    if (!IsLeft(*text)) {
      holder_ = DescribeHolder(owner_file, *text);
      return;
    }
    RemoveOwner(owner_file, *text);
  }
  if (is_held_) owner_ = self;
}

FileLock::~FileLock() {
  if (!is_held_ || owner_ != FormatSelf()) return;  // not of a fork
  const fs::path owner_file = FindOwnerFile(path_);
  if (ReadSystemFile(owner_file) == owner_) ::unlink(owner_file.c_str());
}

bool IsLocked(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool is_taken = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(file);
  if (is_taken) return true;
  const std::optional<std::string> text = ReadOwnerFile(FindOwnerFile(path));
  return text && !IsLeft(*text);
}

void RemoveLeftOwner(const fs::path& path) {
  const fs::path owner_file = FindOwnerFile(path);
  const std::optional<std::string> text = ReadOwnerFile(owner_file);
  if (text && IsLeft(*text)) RemoveOwner(owner_file, *text);
}

}  // namespace graspbench
