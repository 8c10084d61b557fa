// To be preloaded into another program: what it does to files whose names hold a text fails at
// random.
// GRASPBENCH_FAULTS="SEED PROBABILITY TEXT": opening for writing, write (at times half of it is
// written first), fsync, fdatasync, ftruncate, rename and close (the file is closed all the same).
// GRASPBENCH_FAULTS="at N EIO|ENOSPC TEXT": the Nth of these operations fails with that reason, and
// no other; GRASPBENCH_COUNT names a file for how many there were.
// GRASPBENCH_FLOCK="ENOSYS|ENOLCK|EIO": every flock fails with that reason, whatever the file;
// "local": each one is granted, as where machines do not tell each other.
// GRASPBENCH_READS="ESTALE|EIO|EINTR N TEXT": the first N reads of such files fail with that reason.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

std::atomic<uint64_t> num_operations{0};

struct Faults {
  uint64_t seed = 0;
  uint64_t only = 0;  // the number of the operation that fails
  int reason = 0;     // of that one
  double probability = 0.0;
  char text[4096] = "";
};

const Faults& Read() {
  static const Faults faults = [] {
    Faults read;
    unsigned long long seed = 0;
    const char* setting = std::getenv("GRASPBENCH_FAULTS");
    char reason[16] = "";
    if (setting && std::sscanf(setting, "at %llu %15s %4095s", &seed, reason, read.text) == 3) {
      read.only = seed;
      read.reason = std::strcmp(reason, "EIO") == 0 ? EIO : ENOSPC;
    } else if (setting &&
               std::sscanf(setting, "%llu %lf %4095s", &seed, &read.probability, read.text) == 3) {
      read.seed = seed;
    }
    return read;
  }();
  return faults;
}

/** Uniform in [0, 1), another one at each call (SplitMix64). */
double Draw() {
  static std::atomic<uint64_t> count{0};
  uint64_t z = Read().seed * 0x9e3779b97f4a7c15u + ++count * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

bool FailsName(const char* name) {
  const Faults& faults = Read();
  if (!faults.text[0] || !std::strstr(name, faults.text)) return false;
  return faults.reason != 0 ? ++num_operations == faults.only : Draw() < faults.probability;
}

/** Of an open file; false: it has none. */
bool FindName(int file, char (&name)[4096]) {
  char link[64];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t size = ::readlink(link, name, sizeof name - 1);
  if (size <= 0) return false;
  name[size] = '\0';
  return true;
}

bool FailsFile(int file) {
  char name[4096];
  return Read().text[0] && FindName(file, name) && FailsName(name);
}

/** 0, or why this read fails. */
int FindReadFault(int file) {
  static std::atomic<int> left{-1};
  char reason[16], text[4096], name[4096];
  int count = 0;
  const char* setting = std::getenv("GRASPBENCH_READS");
  if (!setting || std::sscanf(setting, "%15s %d %4095s", reason, &count, text) != 3) return 0;
  if (!FindName(file, name) || !std::strstr(name, text)) return 0;
  int none = -1;
  left.compare_exchange_strong(none, count);
  if (left-- <= 0) {
    left = 0;
    return 0;
  }
  return std::strcmp(reason, "ESTALE") == 0 ? ESTALE
         : std::strcmp(reason, "EIO") == 0  ? EIO
                                            : EINTR;
}

int Fail(int reason) {
  errno = Read().reason != 0 ? Read().reason : reason;
  return -1;
}

struct Counter {
  ~Counter() {
    const char* file = std::getenv("GRASPBENCH_COUNT");
    std::FILE* stream = file ? std::fopen(file, "w") : nullptr;
    if (!stream) return;
    std::fprintf(stream, "%llu\n", static_cast<unsigned long long>(num_operations));
    std::fclose(stream);
  }
} counter;

int Open(const char* name, int flags, va_list rest) {
  const int mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, int) : 0;
  if ((flags & O_ACCMODE) != O_RDONLY && FailsName(name)) return Fail(EIO);
  return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, name, flags, mode));
}

}  // namespace

extern "C" {

int open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const int file = Open(name, flags, rest);
  va_end(rest);
  return file;
}

int open64(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const int file = Open(name, flags, rest);
  va_end(rest);
  return file;
}

ssize_t write(int file, const void* bytes, size_t size) {
  if (FailsFile(file)) {
    if (Read().reason != 0 || Draw() < 0.5) return Fail(ENOSPC);
    size = (size + 1) / 2;
  }
  return ::syscall(SYS_write, file, bytes, size);
}

ssize_t read(int file, void* bytes, size_t size) {
  if (const int reason = FindReadFault(file)) {
    errno = reason;
    return -1;
  }
  return ::syscall(SYS_read, file, bytes, size);
}

ssize_t pread(int file, void* bytes, size_t size, off_t start) {
  if (const int reason = FindReadFault(file)) {
    errno = reason;
    return -1;
  }
  return ::syscall(SYS_pread64, file, bytes, size, start);
}

ssize_t pread64(int file, void* bytes, size_t size, off_t start) {
  return pread(file, bytes, size, start);
}

int fsync(int file) {
  return FailsFile(file) ? Fail(EIO) : static_cast<int>(::syscall(SYS_fsync, file));
}

int fdatasync(int file) {
  return FailsFile(file) ? Fail(EIO) : static_cast<int>(::syscall(SYS_fdatasync, file));
}

int ftruncate(int file, off_t length) noexcept {
  return FailsFile(file) ? Fail(EIO) : static_cast<int>(::syscall(SYS_ftruncate, file, length));
}

int flock(int file, int operation) noexcept {
  const char* reason = std::getenv("GRASPBENCH_FLOCK");
  if (!reason) return static_cast<int>(::syscall(SYS_flock, file, operation));
  if (std::strcmp(reason, "local") == 0) return 0;
  errno = std::strcmp(reason, "ENOSYS") == 0   ? ENOSYS
          : std::strcmp(reason, "ENOLCK") == 0 ? ENOLCK
                                               : EIO;
  return -1;
}

int rename(const char* from, const char* to) noexcept {
  if (FailsName(to)) return Fail(EIO);
  return static_cast<int>(::syscall(SYS_rename, from, to));
}

int close(int file) {
  const bool fails = FailsFile(file);
  const int result = static_cast<int>(::syscall(SYS_close, file));
  return fails ? Fail(EIO) : result;
}

}  // extern "C"
