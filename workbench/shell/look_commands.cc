#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/pictures/scene_film.h"
#include "workbench/shell/grasp_cards.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/shell/shell_picture.h"
#include "workbench/terminal/terminal.h"
#include "workbench/text/typed_words.h"

namespace graspbench {
namespace {

constexpr int kShotWidth = 960, kShotHeight = 720;
constexpr int kFilmWidth = 480, kFilmHeight = 360;
constexpr double kFilmInterval = 0.05;  // [s]

bool Never() { return false; }

/** @throws Error(kUsage) for another ending, and where there is a file already. */
void CheckPictureFile(const std::string& file, const char* ending) {
  if (std::filesystem::path(file).extension() != ending) {
    throw Error(ErrorKind::kUsage, "\"" + file + "\" does not end in " + ending);
  }
  CheckOutputFile(file);
}

constexpr const char* kViewHelp = "help view";

}  // namespace

void ShowScene(Shell& shell, const ShellArguments&) { PrintResult(FormatScene(shell.scene())); }

void ShowJoints(Shell& shell, const ShellArguments&) { PrintResult(FormatJoints(shell.scene())); }

void ShowContacts(Shell& shell, const ShellArguments&) {
  PrintResult(FormatContacts(shell.scene()));
}

void ShowTiming(Shell& shell, const ShellArguments&) { PrintResult(FormatTiming(shell.scene())); }

void ShowWrenchSpace(Shell& shell, const ShellArguments&) {
  PrintResult(FormatWrenchSpace(shell.scene()));
}

std::vector<std::string> ListPostures() { return {"now", "pre", "target"}; }

void ShowPads(Shell& shell, const ShellArguments& arguments) {
  const std::string posture = arguments.empty() ? "now" : ToLower(arguments[0]);
  const std::vector<std::string> known = ListPostures();
  if (std::find(known.begin(), known.end(), posture) == known.end()) {
    throw Error(ErrorKind::kUsage,
                "\"" + posture + "\" is no posture" + SuggestNames(posture, known));
  }
  PrintResult(FormatPads(shell.scene(), posture));
}

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
  CheckPictureFile(file, ".png");
  const SceneView view = ParseSceneView({arguments.begin() + 1, arguments.end()}, kViewHelp);
  WriteFileAtomically(file,
                      EncodePng(shell.painter.Draw(shell.scene(), view, kShotWidth, kShotHeight)));
  PrintResult(file + "\n" + DescribeView(shell.scene(), view));
}

void FilmTrial(Shell& shell, const ShellArguments& arguments) {
  const std::string& file = arguments[0];
  CheckPictureFile(file, ".webp");
  const SceneView view = ParseSceneView({arguments.begin() + 1, arguments.end()}, kViewHelp);
  ShellScene& scene = shell.scene();
  const double time = scene.time();
  SceneFilm film(scene.setup().hand, scene.setup().object);
  scene.Reset();
  for (double next = 0.0; !shell.IsStopped(); next += kFilmInterval) {
    scene.GoTo(next, Never);
    World& world = scene.course().world();
    film.Add(scene.time(), world.state().q, world.state().X_WH, world.CalcObjectPose());
    if (scene.is_over()) break;
  }
  scene.GoTo(time, Never);
  const std::string bytes = film.Encode(view, kFilmWidth, kFilmHeight, [&](size_t num_drawn) {
    shell.region.Show({fmt::format("picture {} of {}", num_drawn, film.size())});
    return !shell.IsStopped();
  });
  shell.region.Clear();
  if (bytes.empty()) return;
  WriteFileAtomically(file, bytes);
  PrintResult(fmt::format("{}\n{}, the whole trial in real time\n", file,
                          FormatCount(static_cast<int64_t>(film.size()), "picture")));
}

}  // namespace graspbench
