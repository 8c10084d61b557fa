
#include "core/base/version.h"
#include "workbench/build_info.h"
#include "workbench/commands/command.h"

namespace graspbench {
namespace {

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

void AddVersionCommand(Command& program, ExitCode&) {
  Command& command = AddSubcommand(program, "version",
                                   "Print the versions of the program, its compiler and libraries.",
                                   "  graspbench version\n"
                                   "  graspbench version --json");
  Option* json = command.AddFlag("--json", "print one JSON object");
  command.SetAction([json] {
    if (json->IsGiven()) {
      PrintJson(MakeVersion());
    } else {
      PrintVersion(MakeVersion());
    }
  });
}

}  // namespace graspbench
