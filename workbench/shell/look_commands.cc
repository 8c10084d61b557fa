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

/** "front", or "free AZIMUTH ELEVATION [ZOOM]". */
SceneView ParseView(const ShellArguments& arguments) {
  SceneView view;
  if (arguments.empty()) return view;
  if (ToLower(arguments[0]) != "free") {
    if (arguments.size() > 1) {
      throw Error(ErrorKind::kUsage, "a named view has no numbers; see: help view");
    }
    return FindSceneView(ToLower(arguments[0]));
  }
  if (arguments.size() < 3) {
    throw Error(ErrorKind::kUsage, "free needs azimuth and elevation [deg]; see: help view");
  }
  view.name = "free";
  view.azimuth_deg = ParseNumber(arguments[1], "the azimuth", "deg", -360.0, 360.0);
  view.elevation_deg = ParseNumber(arguments[2], "the elevation", "deg", -89.0, 90.0);
  if (arguments.size() > 3) view.zoom = ParseNumber(arguments[3], "the zoom", "", 0.1, 10.0);
  return view;
}

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
  const SceneView view = ParseView(arguments);
  PrintControlled(stdout, shell.painter.DrawForTerminal(shell.scene(), view));
  PrintResult(DescribeView(shell.scene(), view));
}

void ShootScene(Shell& shell, const ShellArguments& arguments) {
  const std::string& file = arguments[0];
  if (std::filesystem::path(file).extension() != ".png") {
    throw Error(ErrorKind::kUsage, "\"" + file + "\" does not end in .png");
  }
  const SceneView view = ParseView({arguments.begin() + 1, arguments.end()});
  CheckOutputFile(file);
  WriteFileAtomically(file,
                      EncodePng(shell.painter.Draw(shell.scene(), view, kShotWidth, kShotHeight)));
  PrintResult(file + "\n" + DescribeView(shell.scene(), view));
}

}  // namespace graspbench
