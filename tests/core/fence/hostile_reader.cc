// A reader of the fence whose readers do what damaged and malicious files make readers do.
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "core/base/files/files.h"
#include "core/fence/serve_fence.h"

namespace graspbench {
namespace {

void Spin() {
  for (volatile unsigned i = 0;; i = i + 1) continue;
}

std::string Overflow(int depth) {
  volatile char frame[4096];
  frame[depth % 4096] = 1;
  return depth < 0 ? "" : Overflow(depth + 1) + frame[0];
}

void FillWithoutThrowing(std::string& content) noexcept { content.resize(size_t{2} << 30, 'x'); }

// What of the system may be changed; empty: nothing.
std::string TryToWrite(const std::string& folder) {
  std::string done;
  const std::string made = folder + "/made", kept = folder + "/kept";
  if (::open(made.c_str(), O_WRONLY | O_CREAT, 0600) >= 0) done += " open";
  if (::open(kept.c_str(), O_RDWR) >= 0) done += " open for change";
  if (::open(kept.c_str(), O_RDONLY | O_TRUNC) >= 0) done += " cut by open";
  if (::truncate(kept.c_str(), 0) == 0) done += " truncate";
  if (::unlink(kept.c_str()) == 0) done += " unlink";
  if (::rename(kept.c_str(), made.c_str()) == 0) done += " rename";
  if (::link(kept.c_str(), made.c_str()) == 0) done += " link";
  if (::symlink("kept", made.c_str()) == 0) done += " symlink";
  if (::mkdir(made.c_str(), 0700) == 0) done += " mkdir";
  if (::mkfifo(made.c_str(), 0600) == 0) done += " mkfifo";
  if (::chmod(kept.c_str(), 0777) == 0) done += " chmod";
  return done;
}

void Read(const FencedInput& input, IncomingValues& arguments, OutgoingValues& answer) {
  std::string task;
  Cross(arguments, task);
  std::string content = ReadFile(input.path());
  if (task == "crash") std::raise(SIGSEGV);
  if (task == "abort") std::abort();
  if (task == "recurse") content = Overflow(0);
  if (task == "spin") Spin();
  if (task == "exit") ::_exit(3);
  if (task == "throw") throw std::runtime_error("said so");
  if (task == "refuse") throw Error(ErrorKind::kUnsupported, input.path() + " is refused");
  if (task == "fill") content.resize(size_t{2} << 30, 'x');
  if (task == "fill and end") FillWithoutThrowing(content);
  if (task == "write") content = TryToWrite(content);
  if (task == "beside") content = input.ReadBeside(content).value_or("nothing");
  if (task == "lie") {  // a text longer than the answer
    const size_t size = size_t{1} << 40;
    return answer.Bytes(&size, sizeof size);
  }
  Cross(answer, content);
}

}  // namespace
}  // namespace graspbench

int main() { ::_exit(graspbench::ServeFence({{"task", &graspbench::Read}})); }
