#include "workbench/program.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/text/escape.h"
#include "core/base/text/text.h"
#include "core/base/version.h"
#include "datasets/journal/file_lock.h"
#include "datasets/plan/scene_names.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/machines/machine.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/run_session.h"
#include "workbench/pictures/scene_view.h"

namespace graspbench {
namespace {

/** What a room of commands/ is called in the help: "hands_and_objects" as "Hands and objects". */
std::string MakeHeading(std::string room) {
  std::replace(room.begin(), room.end(), '_', ' ');
  room[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(room[0])));
  return room;
}

/** Lists what `add` adds to the program under the heading of its room. */
void AddToRoom(const std::string& room, void (*add)(Command&, ExitCode&), Command& program,
               ExitCode& exit_code) {
  const size_t num_before = program.subcommands().size();
  add(program, exit_code);
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

/** Adds the names of "g1,g2". @throws Error(kUsage) where one is empty. */
void SplitNames(const std::string& option, const std::string& given,
                std::vector<std::string>& names) {
  size_t number = 1;
  for (size_t start = 0; start <= given.size(); ++number) {
    const size_t comma = std::min(given.find(',', start), given.size());
    if (comma == start) {
      throw Error(ErrorKind::kUsage, option + " \"" + given + "\": name " + std::to_string(number) +
                                         " of the list is empty; expected names with one comma "
                                         "between two");
    }
    names.push_back(given.substr(start, comma - start));
    start = comma + 1;
  }
}

}  // namespace

void AddListOption(Command& command, const std::string& name, std::vector<std::string>& list,
                   const std::string& text, const std::string& form) {
  std::string names;
  for (const std::string& item : list) names += (names.empty() ? "" : ",") + item;
  // Not by SplitAtCommas(), which drops empty names.
  command
      .AddOptionFunction<std::vector<std::string>>(
          name,
          [name, &list](const std::vector<std::string>& given) {
            list.clear();
            for (const std::string& one : given) SplitNames(name, one, list);
          },
          text)
      ->OneValueEach()
      ->ValueName(form)
      ->ShowDefault(names);
}

void AddSceneOptions(Command& command, SessionConfig& config) {
  AddListOption(command, "--hand", config.hands, "hands by id or folder, or all", "H,..");
  AddListOption(command, "--object", config.objects,
                "objects by id or folder, all, or a folder of such folders", "O,..");
}

void AddSettingsOption(Command& command, std::vector<std::string>& settings,
                       const std::string& example) {
  command.AddOption("--set", settings, "any other setting, e.g. " + example)
      ->OneValueEach()
      ->ValueName("KEY=VALUE");
}

void AddSearchOptions(Command& command, OptimiseConfig& config, const std::string& of) {
  command.AddOption("--evaluations", config.evaluations, of)->ValueName("N")->ShowDefault();
  command
      .AddOption("--fitness-trials", config.fitness_trials,
                 "trials of an evaluation: 1 without variation, or so many drawn ones")
      ->ValueName("N")
      ->ShowDefault();
  command
      .AddOption("--search", config.search, "what step 2 changes: " + ListNames(ListGraspSpaces()))
      ->OneOf(ListGraspSpaces())
      ->ValueName("SPACE")
      ->ShowDefault();
  command.AddFlag("--race", config.race,
                  "simulate only those individuals of which earlier ones promise most, 28 %");
  command
      .AddOption("--fitness", config.fitness,
                 "what step 2 makes larger: sigma, by statics, or strength, by pulling")
      ->OneOf(ListNames(kFitnessKinds))
      ->ValueName("FITNESS")
      ->ShowDefault();
  command
      .AddOption("--grip", config.grip,
                 "what a target may grip with: equal to the start, free, or limit")
      ->OneOf(ListNames(kGripBudgets))
      ->ValueName("GRIP")
      ->ShowDefault();
  command.AddOption("--grip-limit", config.grip_limit, "for --grip limit [N]")->ValueName("N");
}

void AddReplaceOption(Command& command, bool& replace) {
  command.AddFlag("--replace", replace,
                  "write in the place of an earlier result, if all its files are as written");
}

void AddPlanOnlyOption(Command& command, bool& plan_only) {
  command.AddFlag("--plan-only", plan_only, "make the folder and run nothing: see work, submit");
}

void PrintPlan(const std::filesystem::path& folder, int count, const std::string& unit,
               bool as_json) {
  const std::string name = folder.string();
  const std::string next = "graspbench submit " + QuoteForShell(name) + " --engine local";
  if (as_json) {
    PrintJson({{"folder", name}, {unit + "s", count}, {"next", next}});
  } else {
    PrintResult(name + ": " + FormatCount(count, unit) + " planned\nnext     " + next + "\n");
  }
}

void PrintExperimentPlan(const PreparedSession& experiment, bool as_json) {
  PrintPlan(experiment.folder, static_cast<int>(experiment.session.plan.size()), "trial", as_json);
}

void DemandFinished(bool is_finished) {
  if (is_finished) return;
  throw Error(ErrorKind::kInterrupted,
              "stopped; what has run is kept. Continue with the same command");
}

void AddJsonOption(Command& command, bool& as_json) {
  command.AddFlag("--json", as_json, "print one JSON object");
}

void AddResumeOption(Command& command, bool& resume) {
  command.AddFlag("--resume", resume,
                  "continue what is in the folder of --out, with its own settings");
}

void CheckResume(const Command& command, const std::vector<std::string>& settings) {
  if (!command.IsGiven("--out")) {
    throw Error(ErrorKind::kUsage, "--resume needs --out DIR, the folder to be continued");
  }
  for (const std::string& name : settings) {
    if (!command.IsGiven(name)) continue;
    throw Error(ErrorKind::kUsage, name +
                                       " does not go with --resume: what is continued keeps its "
                                       "own settings; leave it out");
  }
}

void AddAcceptDamageOption(Command& command, OnDamage& on_damage) {
  command.AddFlag(
      "--accept-damage", [&on_damage] { on_damage = OnDamage::kAccept; },
      "go on with what is whole in a damaged folder; the report names the damage");
}

void AddSecondsOption(Command& command, const std::string& name, double& seconds,
                      const std::string& text) {
  const auto check = [](const std::string& value) {
    double number = 0.0;
    const bool is_time = ReadNumber(value, number) && std::isfinite(number) && number > 0.0;
    return is_time ? std::string() : "\"" + value + "\": expected a number of seconds above 0";
  };
  command.AddOption(name, seconds, text)->Check(check)->ValueName("S")->ShowDefault();
}

void AddTrialTimeoutOption(Command& command, double& seconds) {
  AddSecondsOption(
      command, "--trial-timeout", seconds,
      "seconds of processor time after which a trial is given up as a numerical failure");
}

void AddStoreFolder(Command& command, std::filesystem::path& folder, const std::string& text) {
  const auto name = [](const std::string& value) {
    return value == "." ? std::filesystem::current_path().string() : value;
  };
  command.AddOption("folder", folder, text)->Require()->Transform(name)->ValueName("DIR");
}

std::vector<Option*> AddPictureOptions(Command& command, std::string& at,
                                       std::vector<std::string>& view, std::string& size) {
  return {command
              .AddOption("--at,--phase", at,
                         "which instant: a time as 1.25s, or the end of a phase; else of "
                         "stabilisation")
              ->ValueName("TIME|PHASE"),
          command.AddOption("--camera", view, "from where: " + ListNames(ListSceneViews()))
              ->NumValues(1, 4)
              ->ValueName("VIEW [AZ EL [ZOOM]]"),
          command.AddOption("--size", size, "of the picture, in pixels")
              ->ValueName("WxH")
              ->ShowDefault()};
}

void AddJobsOption(Command& command, int& num_workers, const std::string& what) {
  num_workers = CountProcessors();
  command.AddOption("--jobs", num_workers, what + " at a time")
      ->Within(1, 1024)
      ->ValueName("N")
      ->ShowDefault("processors");
}

std::string ListNames(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void AddCommands(Command& program, ExitCode& exit_code) {
  program.Describe("graspbench", "Grasping experiments with simulated robot hands.",
                   "  graspbench run                       both hands, 21 objects, then a report\n"
                   "  graspbench render shadow can g3 --at closed --out can.png");
  program.RequireSubcommand();
  program.AddVersionFlag("--version,-V", std::string("graspbench ") + program_version(),
                         "Print the version of the program and exit");
#define GRASPBENCH_COMMAND(Name, room) AddToRoom(#room, &Add##Name##Command, program, exit_code);
#include "workbench/commands/command_list.inc"
#include "workbench/terminal/command_line.h"
#undef GRASPBENCH_COMMAND
  RefuseEmptyNames(program);
  AcceptNames(program);
}

int RunProgram(int argc, const char* const* argv) {
  WarnOfMissingLocks([](const std::string& text) { PrintMessage(text); });
  ExitCode exit_code = kExitOk;
  Command program;
  try {
    AddCommands(program, exit_code);
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
    return exit_code;
  } catch (const Error& error) {
    PrintFault(error.what());
    return ExitCodeOf(error.kind());
  } catch (const std::bad_alloc&) {
    PrintFault(
        "the machine, or a limit (ulimit -v), gives too little memory; finished trials are "
        "kept. Use fewer workers (--jobs 1) or a smaller mesh, or allow more");
    return kExitEnvironment;
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string path = error.path1().string();
    PrintFault("the machine cannot give what is needed" +
               (path.empty() ? ", the folder you are in for instance" : " at \"" + path + "\"") +
               ": " + error.code().message());
    return kExitEnvironment;
  } catch (const std::system_error& error) {  // of threads and locks
    PrintFault(std::string("the machine cannot give what is needed: ") + error.what());
    return kExitEnvironment;
  } catch (const std::exception& error) {
    PrintFault(std::string("failed: ") + error.what());
    return kExitFailed;
  }
}

}  // namespace graspbench
