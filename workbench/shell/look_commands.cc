#include <algorithm>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/shell/shell_picture.h"
#include "workbench/shell/shell_words.h"
#include "workbench/terminal.h"

namespace graspbench {
namespace {

constexpr int kShotWidth = 960, kShotHeight = 720;

constexpr const char* kViewHelp = "help view";

}  // namespace

void ShowScene(Shell& shell, const ShellArguments&) { PrintResult(FormatScene(shell.scene())); }

void ShowJoints(Shell& shell, const ShellArguments&) { PrintResult(FormatJoints(shell.scene())); }

void ShowContacts(Shell& shell, const ShellArguments&) {
  PrintResult(FormatContacts(shell.scene()));
}

void ShowTiming(Shell& shell, const ShellArguments&) { PrintResult(FormatTiming(shell.scene())); }

void ShowStability(Shell& shell, const ShellArguments&) {
  PrintResult(FormatStability(shell.scene()));
}

void ViewScene(Shell& shell, const ShellArguments& arguments) {
  const SceneView view = ParseSceneView(arguments, kViewHelp);
  PrintControlled(stdout, shell.painter.DrawForTerminal(shell.scene(), view));
  PrintResult(DescribeView(shell.scene(), view));
}

void ShootScene(Shell& shell, const ShellArguments& arguments) {
  const std::string& file = arguments[0];
  if (std::filesystem::path(file).extension() != ".png") {
    throw Error(ErrorKind::kUsage, "\"" + file + "\" does not end in .png");
  }
  const SceneView view = ParseSceneView({arguments.begin() + 1, arguments.end()}, kViewHelp);
  CheckOutputFile(file);
  WriteFileAtomically(file,
                      EncodePng(shell.painter.Draw(shell.scene(), view, kShotWidth, kShotHeight)));
  PrintResult(file + "\n" + DescribeView(shell.scene(), view));
}

}  // namespace graspbench
