#include "workbench/program.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
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

/** The examples, kept in the footer, come first. */
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    return "Examples:\n" + app->get_footer() + "\n\n" + CLI::Formatter::make_help(app, name, mode);
  }
  std::string make_footer(const CLI::App*) const override { return {}; }
  /** The default stands at the end, taken from where the program has it. */
  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string text = CLI::Formatter::make_option_desc(option);
    const std::string value = option->get_default_str();
    return value.empty() ? text : text + " (default " + value + ")";
  }
};

/** The command that the user was typing when the parser gave up. */
const CLI::App& FindCurrentCommand(const CLI::App& program) {
  const std::vector<CLI::App*> parsed = program.get_subcommands();
  return parsed.empty() ? program : FindCurrentCommand(*parsed.back());
}

std::vector<std::string> ListSubcommands(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : command.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(subcommand->get_name());
  }
  return names;
}

std::vector<std::string> ListOptions(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) names.push_back(option->get_name());
  }
  return names;
}

/** What a room of commands/ is called in the help: "hands_and_objects" as "Hands and objects". */
std::string MakeHeading(std::string room) {
  std::replace(room.begin(), room.end(), '_', ' ');
  room[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(room[0])));
  return room;
}

/** Lists what `add` adds to the program under the heading of its room. */
void AddToRoom(const std::string& room, void (*add)(CLI::App&, ExitCode&), CLI::App& program,
               ExitCode& exit_code) {
  const auto all = [](const CLI::App*) { return true; };
  const size_t num_before = program.get_subcommands(all).size();
  add(program, exit_code);
  const std::vector<CLI::App*> commands = program.get_subcommands(all);
  for (size_t i = num_before; i < commands.size(); ++i) commands[i]->group(MakeHeading(room));
}

/** The parser's complaint in our words, with suggestions. */
std::string Explain(const CLI::ParseError& fault, const CLI::App& program) {
  const CLI::App& command = FindCurrentCommand(program);
  const std::vector<std::string> subcommands = ListSubcommands(command);
  std::string typed = "graspbench";
  if (&command != &program) {
    if (command.get_parent() != &program) typed += " " + command.get_parent()->get_name();
    typed += " " + command.get_name();
  }
  std::vector<std::string> extras = command.remaining();
  std::string text;
  if (!extras.empty() && extras.front().rfind('-', 0) == 0) {
    extras.front() = extras.front().substr(0, extras.front().find('='));
    text = "unknown option \"" + extras.front() + "\"" +
           SuggestNames(extras.front(), ListOptions(command));
  } else if (!extras.empty() && !subcommands.empty()) {
    text = "unknown command \"" + extras.front() + "\"" + SuggestNames(extras.front(), subcommands);
  } else if (!extras.empty()) {
    text = "unexpected argument \"" + extras.front() + "\"";
  } else if (fault.get_name() == "RequiredError" && !subcommands.empty()) {
    text = "a command is missing" + SuggestNames("", subcommands);
  } else if (fault.get_name() == "ConversionError") {
    const std::string what = fault.what();  // "Could not convert: --trials = ten"
    text = what.substr(what.find("--")) + ": a whole number is expected";
  } else {
    text = fault.what();
  }
  return text + "\nsee: " + typed + " --help";
}

/** An empty argument is a variable of a script that was not set: never silently the default. */
void RefuseEmptyNames(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->get_expected_max() == 0) continue;  // flags
    option->check([](const std::string& value) {
      return value.empty() ? std::string("an empty name; expected a value") : std::string();
    });
  }
  for (CLI::App* subcommand : command.get_subcommands([](CLI::App*) { return true; })) {
    RefuseEmptyNames(*subcommand);
  }
}

/** Wherever a command takes an id, it takes the name too. */
void AcceptNames(CLI::App& command) {
  const std::pair<const char*, std::string (*)(const std::string&)> kinds[] = {
      {"hand", &FindHandId}, {"object", &FindObjectId}, {"grasp", &FindGraspId}};
  for (CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    for (const auto& [kind, find_id] : kinds) {
      if (name == kind || name == std::string("--") + kind) option->transform(find_id);
    }
  }
  for (CLI::App* subcommand : command.get_subcommands([](CLI::App*) { return true; })) {
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

CLI::App& AddSubcommand(CLI::App& parent, const std::string& name, const std::string& description,
                        const std::string& examples) {
  CLI::App* command = parent.add_subcommand(name, description);
  command->footer(examples);
  command->group("Subcommands");  // not the heading that the parent stands under
  return *command;
}

void AddListOption(CLI::App& command, const std::string& name, std::vector<std::string>& list,
                   const std::string& text, const std::string& form) {
  std::string names;
  for (const std::string& item : list) names += (names.empty() ? "" : ",") + item;
  // Not by CLI's own delimiter, which drops empty names.
  command
      .add_option_function<std::vector<std::string>>(
          name,
          [name, &list](const std::vector<std::string>& given) {
            list.clear();
            for (const std::string& one : given) SplitNames(name, one, list);
          },
          text)
      ->allow_extra_args(false)
      ->option_text(form)
      ->default_str(names);
}

void AddSceneOptions(CLI::App& command, SessionConfig& config) {
  AddListOption(command, "--hand", config.hands, "hands by id or folder, or all", "H,..");
  AddListOption(command, "--object", config.objects,
                "objects by id or folder, all, or a folder of such folders", "O,..");
}

void AddSettingsOption(CLI::App& command, std::vector<std::string>& settings,
                       const std::string& example) {
  command.add_option("--set", settings, "any other setting, e.g. " + example)
      ->allow_extra_args(false)
      ->option_text("KEY=VALUE");
}

void AddSearchOptions(CLI::App& command, OptimiseConfig& config, const std::string& of) {
  command.add_option("--evaluations", config.evaluations, of)
      ->option_text("N")
      ->capture_default_str();
  command
      .add_option("--fitness-trials", config.fitness_trials,
                  "trials of an evaluation: 1 without variation, or so many drawn ones")
      ->option_text("N")
      ->capture_default_str();
  command
      .add_option("--search", config.search, "what step 2 changes: " + ListNames(ListGraspSpaces()))
      ->check(CLI::IsMember(ListGraspSpaces()))
      ->option_text("SPACE")
      ->capture_default_str();
  command.add_flag("--race", config.race,
                   "simulate only those individuals of which earlier ones promise most, 28 %");
  command
      .add_option("--fitness", config.fitness,
                  "what step 2 makes larger: sigma, by statics, or strength, by pulling")
      ->check(CLI::IsMember(ListNames(kFitnessKinds)))
      ->option_text("FITNESS")
      ->capture_default_str();
  command
      .add_option("--grip", config.grip,
                  "what a target may grip with: equal to the start, free, or limit")
      ->check(CLI::IsMember(ListNames(kGripBudgets)))
      ->option_text("GRIP")
      ->capture_default_str();
  command.add_option("--grip-limit", config.grip_limit, "for --grip limit [N]")->option_text("N");
}

void AddReplaceOption(CLI::App& command, bool& replace) {
  command.add_flag("--replace", replace,
                   "write in the place of an earlier result, if all its files are as written");
}

void AddPlanOnlyOption(CLI::App& command, bool& plan_only) {
  command.add_flag("--plan-only", plan_only, "make the folder and run nothing: see work, submit");
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

void AddJsonOption(CLI::App& command, bool& as_json) {
  command.add_flag("--json", as_json, "print one JSON object");
}

void AddResumeOption(CLI::App& command, bool& resume) {
  command.add_flag("--resume", resume,
                   "continue what is in the folder of --out, with its own settings");
}

void CheckResume(const CLI::App& command, const std::vector<std::string>& settings) {
  if (command.count("--out") == 0) {
    throw Error(ErrorKind::kUsage, "--resume needs --out DIR, the folder to be continued");
  }
  for (const std::string& name : settings) {
    if (command.count(name) == 0) continue;
    throw Error(ErrorKind::kUsage, name +
                                       " does not go with --resume: what is continued keeps its "
                                       "own settings; leave it out");
  }
}

void AddAcceptDamageOption(CLI::App& command, OnDamage& on_damage) {
  command.add_flag_callback(
      "--accept-damage", [&on_damage] { on_damage = OnDamage::kAccept; },
      "go on with what is whole in a damaged folder; the report names the damage");
}

void AddSecondsOption(CLI::App& command, const std::string& name, double& seconds,
                      const std::string& text) {
  const auto check = [](const std::string& value) {
    double number = 0.0;
    const bool is_time =
        CLI::detail::lexical_cast(value, number) && std::isfinite(number) && number > 0.0;
    return is_time ? std::string() : "\"" + value + "\": expected a number of seconds above 0";
  };
  command.add_option(name, seconds, text)->check(check)->option_text("S")->capture_default_str();
}

void AddTrialTimeoutOption(CLI::App& command, double& seconds) {
  AddSecondsOption(
      command, "--trial-timeout", seconds,
      "seconds of processor time after which a trial is given up as a numerical failure");
}

void AddStoreFolder(CLI::App& command, std::filesystem::path& folder, const std::string& text) {
  const auto name = [](const std::string& value) {
    return value == "." ? std::filesystem::current_path().string() : value;
  };
  command.add_option("folder", folder, text)->required()->transform(name)->option_text("DIR");
}

std::vector<CLI::Option*> AddPictureOptions(CLI::App& command, std::string& at,
                                            std::vector<std::string>& view, std::string& size) {
  return {command
              .add_option("--at,--phase", at,
                          "which instant: a time as 1.25s, or the end of a phase; else of "
                          "stabilisation")
              ->option_text("TIME|PHASE"),
          command.add_option("--camera", view, "from where: " + ListNames(ListSceneViews()))
              ->expected(1, 4)
              ->option_text("VIEW [AZ EL [ZOOM]]"),
          command.add_option("--size", size, "of the picture, in pixels")
              ->option_text("WxH")
              ->capture_default_str()};
}

void AddJobsOption(CLI::App& command, int& num_workers, const std::string& what) {
  num_workers = CountProcessors();
  command.add_option("--jobs", num_workers, what + " at a time")
      ->check(CLI::Range(1, 1024))
      ->option_text("N")
      ->default_str("processors");
}

std::string ListNames(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void AddCommands(CLI::App& program, ExitCode& exit_code) {
  program.name("graspbench");
  program.description("Grasping experiments with simulated robot hands.");
  program.formatter(std::make_shared<HelpFormatter>());
  program.footer(
      "  graspbench run                       both hands, 21 objects, then a report\n"
      "  graspbench render shadow can g3 --at closed --out can.png");
  program.require_subcommand(1);
  program.set_version_flag("--version,-V", std::string("graspbench ") + program_version(),
                           "Print the version of the program and exit");
#define GRASPBENCH_COMMAND(Name, room) AddToRoom(#room, &Add##Name##Command, program, exit_code);
#include "workbench/commands/command_list.inc"
#undef GRASPBENCH_COMMAND
  RefuseEmptyNames(program);
  AcceptNames(program);
}

int RunProgram(int argc, const char* const* argv) {
  WarnOfMissingLocks([](const std::string& text) { PrintMessage(text); });
  ExitCode exit_code = kExitOk;
  CLI::App program;
  try {
    AddCommands(program, exit_code);
    RefuseLineFeeds(argc, argv);
    if (argc == 1 && ::isatty(STDIN_FILENO) && ::isatty(STDOUT_FILENO)) {
      program.parse(std::vector<std::string>{"shell"});
    } else {
      program.parse(argc, argv);
    }
    FlushResults();
    return exit_code;
  } catch (const CLI::ParseError& fault) {
    if (fault.get_exit_code() == 0) {  // --help, --version
      std::ostringstream help, none;
      program.exit(fault, help, none);
      PrintResult(help.str());
      return kExitOk;
    }
    const std::string text = Explain(fault, program);
    if (IsJsonTyped(argc, argv)) PrintJson({{"error", text}});
    PrintFault(text);
    return kExitUsage;
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
