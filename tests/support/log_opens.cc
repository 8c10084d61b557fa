// To be preloaded into another program: appends the name of every file that it opens to the file
// that GRASPBENCH_OPEN_LOG names.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

void Log(const char* name) {
  const char* log = std::getenv("GRASPBENCH_OPEN_LOG");
  if (log == nullptr || name == nullptr) return;
  const auto file = static_cast<int>(
      ::syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  if (file < 0) return;
  char line[4096];
  const int size = std::snprintf(line, sizeof line, "%s\n", name);
  if (::write(file, line, static_cast<size_t>(size)) < 0) std::abort();
  ::close(file);
}

template <class Function>
Function Next(const char* name) {
  void* const found = ::dlsym(RTLD_NEXT, name);
  Function function = nullptr;
  std::memcpy(&function, &found, sizeof function);
  return function;
}

int OpenAt(int folder, const char* name, int flags, va_list rest) {
  Log(name);
  const int mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, int) : 0;
  return static_cast<int>(::syscall(SYS_openat, folder, name, flags, mode));
}

}  // namespace

extern "C" {

int open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const int file = OpenAt(AT_FDCWD, name, flags, rest);
  va_end(rest);
  return file;
}
int open64(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const int file = OpenAt(AT_FDCWD, name, flags, rest);
  va_end(rest);
  return file;
}
int openat(int folder, const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const int file = OpenAt(folder, name, flags, rest);
  va_end(rest);
  return file;
}
FILE* fopen(const char* name, const char* mode) {
  Log(name);
  return Next<FILE* (*)(const char*, const char*)>("fopen")(name, mode);
}
FILE* fopen64(const char* name, const char* mode) {
  Log(name);
  return Next<FILE* (*)(const char*, const char*)>("fopen64")(name, mode);
}

}  // extern "C"
