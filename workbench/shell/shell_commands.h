#pragma once
/** @file
The table of the shell's commands: help, completion and what a line means are made from it. A new
command is a row of the table and a function. */

#include <string>
#include <vector>

namespace graspbench {

class Shell;

using ShellArguments = std::vector<std::string>;

struct ShellCommand {
  const char* name;
  const char* group;      ///< heading in the overview
  const char* arguments;  ///< "[to PHASE|contact|slip]"
  const char* help;       ///< one sentence, with units and ranges
  const char* example;
  int min_arguments, max_arguments;
  int file_argument;  ///< index of the one that may be a file; -1: none
  /** Known names of argument `index`; null: none. */
  std::vector<std::string> (*list_names)(Shell& shell, size_t index);
  void (*run)(Shell& shell, const ShellArguments& arguments);
};

/** In the order of the overview. */
const std::vector<ShellCommand>& ListShellCommands();

/** @param words  a command, or the beginning of a single one, and its arguments.
@throws Error(kUsage) with suggestions; Error of what it does, which then has changed nothing. */
void RunShellCommand(Shell& shell, const std::vector<std::string>& words);

/** What a line may go on with: names and files that begin with the word it ends with, sorted. Loads
nothing. */
std::vector<std::string> FindCompletions(Shell& shell, const std::string& line);

/** Commands by file. */
///@{ scene_commands.cc
void ChooseHand(Shell& shell, const ShellArguments& arguments);
void ChooseObject(Shell& shell, const ShellArguments& arguments);
void ChooseGrasp(Shell& shell, const ShellArguments& arguments);
void ChooseDraw(Shell& shell, const ShellArguments& arguments);
void MoveThing(Shell& shell, const ShellArguments& arguments);
void TurnThing(Shell& shell, const ShellArguments& arguments);
void SetJoint(Shell& shell, const ShellArguments& arguments);
void SetDigit(Shell& shell, const ShellArguments& arguments);
void DriveJoint(Shell& shell, const ShellArguments& arguments);
void ChangeSetting(Shell& shell, const ShellArguments& arguments);
void OpenTrial(Shell& shell, const ShellArguments& arguments);
void UndoChange(Shell& shell, const ShellArguments& arguments);
void RedoChange(Shell& shell, const ShellArguments& arguments);
void ShowChanges(Shell& shell, const ShellArguments& arguments);
void SaveGrasp(Shell& shell, const ShellArguments& arguments);
///@}
///@{ time_commands.cc
void StepTrial(Shell& shell, const ShellArguments& arguments);
void RunTrial(Shell& shell, const ShellArguments& arguments);
/** Phases and events that `run` knows. */
std::vector<std::string> ListRunTargets();
void GoToTime(Shell& shell, const ShellArguments& arguments);
void GoBack(Shell& shell, const ShellArguments& arguments);
void ResetTrial(Shell& shell, const ShellArguments& arguments);
void ChooseLiveCard(Shell& shell, const ShellArguments& arguments);
///@}
///@{ look_commands.cc
void ShowScene(Shell& shell, const ShellArguments& arguments);
void ShowJoints(Shell& shell, const ShellArguments& arguments);
void ShowContacts(Shell& shell, const ShellArguments& arguments);
void ShowTiming(Shell& shell, const ShellArguments& arguments);
void ShowStability(Shell& shell, const ShellArguments& arguments);
void ShowWrenchSpace(Shell& shell, const ShellArguments& arguments);
void ShowPads(Shell& shell, const ShellArguments& arguments);
std::vector<std::string> ListPostures();
void ViewScene(Shell& shell, const ShellArguments& arguments);
void ShootScene(Shell& shell, const ShellArguments& arguments);
void FilmTrial(Shell& shell, const ShellArguments& arguments);
///@}
///@{ trial_commands.cc
void RunTrials(Shell& shell, const ShellArguments& arguments);
void JudgeTrial(Shell& shell, const ShellArguments& arguments);
void ExplainTrial(Shell& shell, const ShellArguments& arguments);
///@}
///@{ optimise_commands.cc, report_command.cc
void OptimiseTrial(Shell& shell, const ShellArguments& arguments);
void ReportTrial(Shell& shell, const ShellArguments& arguments);
///@}
///@{ shell_commands.cc
void ShowHelp(Shell& shell, const ShellArguments& arguments);
void ShowHistory(Shell& shell, const ShellArguments& arguments);
void TakeNote(Shell& shell, const ShellArguments& arguments);
void Leave(Shell& shell, const ShellArguments& arguments);
///@}

}  // namespace graspbench
