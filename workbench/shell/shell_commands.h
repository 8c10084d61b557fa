#pragma once
/** @file
The table of the shell's commands, from which help, completion and dispatch are derived. A new
command needs a row of the table and a function. */

#include <string>
#include <vector>

namespace graspbench {

class Shell;

using ShellArguments = std::vector<std::string>;
using ShellAction = void(Shell& shell, const ShellArguments& arguments);

struct ShellCommand {
  const char* name;
  const char* group;      ///< heading in the overview
  const char* arguments;  ///< "[to PHASE|contact|slip]"
  const char* help;       ///< one sentence, with units and ranges
  const char* example;
  int min_arguments, max_arguments;
  int file_argument;  ///< index of the argument that may be a file; -1: none
  /** Lists known names for argument `index`; null: none. */
  std::vector<std::string> (*list_names)(Shell& shell, size_t index);
  ShellAction* run;
};

/** In the order of the overview. */
const std::vector<ShellCommand>& ListShellCommands();

/** @param words  a command, or an unambiguous beginning of one, and its arguments.
@throws Error(kUsage) with suggestions; the command's Error, after which nothing has changed. */
void RunShellCommand(Shell& shell, const std::vector<std::string>& words);

/** Completions of the line's last word: matching names and files, sorted. Loads nothing. */
std::vector<std::string> FindCompletions(Shell& shell, const std::string& line);

/** The commands' functions, by file, and lists of names they accept. */
///@{ scene_commands.cc
ShellAction ChooseHand, ChooseObject, ChooseGrasp, ChooseDraw, MoveThing, TurnThing, SetJoint,
    SetDigit, DriveJoint, ChangeSetting, OpenTrial, UndoChange, RedoChange, ShowChanges, SaveGrasp;
///@}
///@{ time_commands.cc
ShellAction StepTrial, RunTrial, GoToTime, GoBack, ResetTrial, ChooseLiveCard;
/** Arguments of `live`: "off", "contacts", "joints", "timing", "stability", "view". */
std::vector<std::string> ListLiveCards();
/** Phases and events accepted by `run`. */
std::vector<std::string> ListRunTargets();
///@}
///@{ look_commands.cc
ShellAction ShowScene, ShowPads, ViewScene, ShootScene, FilmTrial, ReportTrial;
std::vector<std::string> ListPostures();
///@}
///@{ trial_commands.cc
ShellAction RunTrials, JudgeTrial, ExplainTrial, OptimiseTrial;
///@}
///@{ shell_commands.cc
ShellAction ShowHelp, ShowHistory, TakeNote, Leave;
///@}

}  // namespace graspbench
