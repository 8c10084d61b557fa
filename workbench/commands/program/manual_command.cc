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
#include "core/base/version.h"
#include "workbench/build_info.h"
#include "workbench/command.h"
#include "workbench/text/command_line_text.h"

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

/** The file of a page, or of the row of a reference page, with its anchor. An option is named
without its dashes: the parser would take it for one of this command.
@throws Error(kUsage) with suggestions. */
std::string FindPage(const std::string& page) {
  const fs::path folder = FindManual();
  std::vector<std::string> pages;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".html") continue;
    if (entry.path().stem() == page) return entry.path().string();
    pages.push_back(entry.path().stem().string());
  }
  for (const char* reference : {"options", "keys", "columns"}) {
    const fs::path file = folder / (std::string(reference) + ".html");
    const std::string text = ReadFile(file);
    for (const std::string& name : {page, "--" + page}) {
      if (text.find(" id=\"" + name + "\"") != text.npos) return file.string() + "#" + name;
    }
  }
  std::sort(pages.begin(), pages.end());
  throw Error(ErrorKind::kUsage,
              "the manual has no page \"" + page + "\"" + SuggestNames(page, pages));
}

/** Hands the page to the desktop's browser where there is a desktop. */
void OpenInBrowser(const std::string& page) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  std::string name = "xdg-open", file = "file://" + page;
  char* words[] = {name.data(), file.data(), nullptr};
  pid_t process = 0;
  if (::posix_spawnp(&process, name.c_str(), nullptr, nullptr, words, environ) != 0) return;
  ::waitpid(process, nullptr, 0);
}

Json MakeVersion() {
  Json libraries;
  for (const auto& [name, version] : kLibraryVersions) libraries[name] = version;
  return {{"graspbench", program_version()},
          {"compiler", kCompiler},
          {"build_type", kBuildType},
          {"flags", kCompilerFlags},
          {"libraries", libraries}};
}

void PrintVersion(const Json& version) {
  std::string text = "graspbench " + version["graspbench"].get<std::string>() + "\ncompiler   " +
                     version["compiler"].get<std::string>() + "\nbuild type " +
                     version["build_type"].get<std::string>() + "\nflags      " +
                     version["flags"].get<std::string>() + "\nlibraries ";
  for (const auto& [name, number] : version["libraries"].items()) {
    text += " " + name + " " + number.get<std::string>();
  }
  PrintResult(text + "\n");
}

}  // namespace

/** What the program says of itself besides help: the manual, its command line for shells, versions.
*/
void AddManualCommand(Command& program) {
  Command& manual = AddSubcommand(
      program, "manual", "Open the manual in a browser and print its path.",
      "  graspbench manual                     contents and search\n"
      "  graspbench manual failed-trial\n"
      "  graspbench manual sim.step_s          a key, an option or a column of a table");
  const auto page = std::make_shared<std::string>("index");
  manual.AddOption("page", *page,
                   "a page, a key, an option or a column; absent: contents and search",
                   "PAGE|NAME");
  manual.SetAction([page] {
    const std::string file = FindPage(*page);
    PrintResult(file + "\n");
    OpenInBrowser(file);
  });

  Command& completion = AddSubcommand(
      program, "completion", "Print a script that completes command lines, or the man page.",
      "  source <(graspbench completion bash)\n"
      "  graspbench completion man >graspbench.1");
  std::vector<std::string> names = ListShells();
  names.emplace_back("man");
  const auto name = std::make_shared<std::string>();
  completion.AddRequired("for", *name, ListNames(names), "FOR")->OneOf(names);
  completion.SetAction([&program, name] {
    PrintResult(*name == "man" ? FormatManPage(program) : FormatCompletion(program, *name));
  });

  Command& version = AddSubcommand(program, "version",
                                   "Print the versions of the program, its compiler and libraries.",
                                   "  graspbench version\n"
                                   "  graspbench version --json");
  Option* json = version.AddFlag("--json", "print one JSON object");
  version.SetAction(
      [json] { json->IsGiven() ? PrintJson(MakeVersion()) : PrintVersion(MakeVersion()); });
}

}  // namespace graspbench
