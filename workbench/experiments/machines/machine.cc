#include "workbench/experiments/machines/machine.h"

#include <gnu/libc-version.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/version.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {
namespace {

/** The value of a key of /proc/cpuinfo, of the first processor; empty: not there. */
std::string FindProcessorEntry(const std::string& text, std::string_view key) {
  std::string value;
  ForEachLine(text, [&](std::string_view line, int, bool) {
    const size_t colon = line.find(": ");
    if (!value.empty() || line.substr(0, key.size()) != key || colon == line.npos) return;
    value = line.substr(colon + 2);
  });
  return value;
}

}  // namespace

std::string FindHost() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return name;
}

const std::string& FindBuild() {
  static const std::string build = CalcHashHex(ReadFile("/proc/self/exe"));
  return build;
}

Machine FindMachine() {
  const std::string processors = ReadFile("/proc/cpuinfo");
  std::string model = FindProcessorEntry(processors, "model name");
  std::string flags = FindProcessorEntry(processors, "flags");
  if (model.empty()) model = FindProcessorEntry(processors, "CPU part");  // of ARM
  if (flags.empty()) flags = FindProcessorEntry(processors, "Features");
  return {FindHost(),         model.empty() ? "unknown processor" : model,
          CalcHashHex(flags), std::string("glibc ") + ::gnu_get_libc_version(),
          FindBuild(),        program_version()};
}

int CountProcessors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

}  // namespace graspbench
