#include "workbench/pictures/svg_to_pdf.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "core/base/error.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kConverter[] = "rsvg-convert";

}  // namespace

bool HasPdfConverter() {
  const char* search_path = std::getenv("PATH");
  std::istringstream folders(search_path ? search_path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (!folder.empty() && ::access((fs::path(folder) / kConverter).c_str(), X_OK) == 0)
      return true;
  }
  return false;
}

void ConvertSvgToPdf(const fs::path& svg) {
  const std::string from = svg.string(), to = fs::path(svg).replace_extension(".pdf").string();
  std::string words[] = {kConverter, "--format=pdf", "--output=" + to, from};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  pid_t process = 0;
  int state = 0;
  const bool was_run =
      ::posix_spawnp(&process, kConverter, nullptr, nullptr, arguments, environ) == 0 &&
      ::waitpid(process, &state, 0) == process;
  if (!was_run || !WIFEXITED(state) || WEXITSTATUS(state) != 0) {
    throw Error(ErrorKind::kEnvironment, std::string(kConverter) + " could not convert \"" + from +
                                             "\"; without it on the PATH figures are SVG only");
  }
}

}  // namespace graspbench
