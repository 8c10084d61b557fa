#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "workbench/commands/command.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** As installed, else as built beside the program. @throws Error(kEnvironment). */
fs::path FindManual() {
  std::error_code status;
  const fs::path built =
      fs::read_symlink("/proc/self/exe", status).parent_path() / "share" / "graspbench" / "manual";
  for (const fs::path& folder : {FindDataRoot() / "manual", built}) {
    if (fs::is_regular_file(folder / "index.html", status)) return folder;
  }
  throw Error(ErrorKind::kEnvironment,
              "the manual is not installed beside this program; build it with: cmake --build "
              "build/release --target manual");
}

/** @throws Error(kUsage) with suggestions. */
fs::path FindPage(const std::string& page) {
  const fs::path folder = FindManual();
  std::vector<std::string> pages;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".html") continue;
    if (entry.path().stem() == page) return entry.path();
    pages.push_back(entry.path().stem().string());
  }
  std::sort(pages.begin(), pages.end());
  throw Error(ErrorKind::kUsage,
              "the manual has no page \"" + page + "\"" + SuggestNames(page, pages));
}

/** Hands the page to the desktop's browser where there is a desktop. */
void OpenInBrowser(const fs::path& page) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  std::string name = "xdg-open", file = page.string();
  char* words[] = {name.data(), file.data(), nullptr};
  pid_t process = 0;
  if (::posix_spawnp(&process, name.c_str(), nullptr, nullptr, words, environ) != 0) return;
  ::waitpid(process, nullptr, 0);
}

}  // namespace

void AddManualCommand(Command& program, ExitCode&) {
  Command& command =
      AddSubcommand(program, "manual", "Open the manual in a browser, and print where it is.",
                    "  graspbench manual                     contents and search\n"
                    "  graspbench manual failed-trial");
  const auto page = std::make_shared<std::string>("index");
  command.AddOption("page", *page, "the name of a page; absent: contents and search")
      ->ValueName("PAGE");
  command.SetAction([page] {
    const fs::path file = FindPage(*page);
    PrintResult(file.string() + "\n");
    OpenInBrowser(file);
  });
}

}  // namespace graspbench
