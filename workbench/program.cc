#include "workbench/program.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/version.h"
#include "datasets/journal/append_file.h"
#include "datasets/plan/scene_names.h"
#include "workbench/command.h"

namespace graspbench {
namespace {

/** What a room of commands/ is called in the help: "hands_and_objects" as "Hands and objects". */
std::string MakeHeading(std::string room) {
  std::replace(room.begin(), room.end(), '_', ' ');
  room[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(room[0])));
  return room;
}

/** Lists what `add` adds to the program under the heading of its room. */
void AddToRoom(const std::string& room, void (*add)(Command&), Command& program) {
  const size_t num_before = program.subcommands().size();
  add(program);
  for (size_t i = num_before; i < program.subcommands().size(); ++i) {
    program.subcommands()[i]->SetHeading(MakeHeading(room));
  }
}

/** An empty argument is a variable of a script that was not set: never silently the default. */
void RefuseEmptyNames(const Command& command) {
  for (const auto& option : command.options()) {
    if (!option->takes_value()) continue;
    option->Check([](const std::string& value) {
      return value.empty() ? std::string("an empty name; expected a value") : std::string();
    });
  }
  for (const auto& subcommand : command.subcommands()) {
    RefuseEmptyNames(*subcommand);
  }
}

/** Wherever a command takes an id, it takes the name too. */
void AcceptNames(const Command& command) {
  const std::pair<const char*, std::string (*)(const std::string&)> kinds[] = {
      {"hand", &FindHandId}, {"object", &FindObjectId}, {"grasp", &FindGraspId}};
  for (const auto& option : command.options()) {
    const std::string name = option->name();
    for (const auto& [kind, find_id] : kinds) {
      if (name == kind || name == std::string("--") + kind) option->Transform(find_id);
    }
  }
  for (const auto& subcommand : command.subcommands()) {
    AcceptNames(*subcommand);
  }
}

void PrintFault(const std::string& message) {
  std::fflush(stdout);
  PrintMessage("graspbench: " + message);
}

/** A program that asked for JSON gets it also when the command line was wrong. */
bool IsJsonTyped(int argc, const char* const* argv) {
  return std::any_of(argv, argv + argc,
                     [](const char* word) { return word == std::string("--json"); });
}

/** Messages are lines; a name that holds a line feed could pass for one of them. */
void RefuseLineFeeds(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string text = argv[i];
    if (text.find_first_of("\n\r") == text.npos) continue;
    throw Error(ErrorKind::kUsage, "\"" + EscapeForTerminal(text, LineFeeds::kEscape) +
                                       "\" holds a line feed; names and values are one line, so "
                                       "rename the file or folder");
  }
}

}  // namespace

void AddCommands(Command& program) {
  program.Describe("graspbench", "Grasping experiments with simulated robot hands.",
                   "  graspbench run                       both hands, 21 objects, then a report\n"
                   "  graspbench render shadow can g3 --at closed --out can.png");
  program.RequireSubcommand();
  program.AddVersionFlag("--version,-V", std::string("graspbench ") + program_version(),
                         "Print the version of the program and exit");
#define GRASPBENCH_COMMAND(Name, room) AddToRoom(#room, &Add##Name##Command, program);
#include "workbench/commands/command_list.inc"
#include "workbench/terminal/command_line.h"
#undef GRASPBENCH_COMMAND
  RefuseEmptyNames(program);
  AcceptNames(program);
}

int RunProgram(int argc, const char* const* argv) {
  Command program;
  try {
    AddCommands(program);
    RefuseLineFeeds(argc, argv);
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    if (argc == 1 && ::isatty(STDIN_FILENO) && ::isatty(STDOUT_FILENO)) words = {"shell"};
    const Command::Parsed parsed = program.Parse(words);
    if (!parsed.fault.empty()) {
      if (IsJsonTyped(argc, argv)) PrintJson({{"error", parsed.fault}});
      PrintFault(parsed.fault);
      return kExitUsage;
    }
    if (parsed.answer) {
      PrintResult(*parsed.answer);
      return kExitOk;
    }
    FlushResults();
    return parsed.exit_code;
  } catch (const Error& error) {
    PrintFault(error.what());
    return ExitCodeOf(error.kind());
  } catch (const std::bad_alloc&) {
    PrintFault(
        "the machine or a limit (ulimit -v) provides too little memory; finished trials are kept. "
        "Use fewer workers (--jobs 1) or a smaller mesh, or raise the limit");
    return kExitEnvironment;
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string path = error.path1().string();
    if (error.code() == std::errc::too_many_symbolic_link_levels) {
      PrintFault(
          "\"" + path +
          "\" leads through a symbolic link to itself; remove the link, or name another file");
      return kExitUsage;
    }
    PrintFault("the machine lacks a resource" +
               (path.empty() ? ", for example the current folder" : " at \"" + path + "\"") + ": " +
               error.code().message());
    return kExitEnvironment;
  } catch (const std::system_error& error) {  // of threads and locks
    PrintFault(std::string("the machine lacks a resource: ") + error.what());
    return kExitEnvironment;
  } catch (const std::exception& error) {
    PrintFault(std::string("failed: ") + error.what());
    return kExitFailed;
  }
}

}  // namespace graspbench
