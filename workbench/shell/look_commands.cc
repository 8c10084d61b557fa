#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/trial/trial_trace.h"
#include "datasets/records/trial_record.h"
#include "reports/trial_page.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/pictures/scene_view.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/shell/shell_picture.h"
#include "workbench/terminal/command_line.h"
#include "workbench/terminal/terminal.h"

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

/** The course of a trial that nobody changed on its way. */
std::optional<TracedTrial> TraceAgain(const TrialSetup& setup, const TrialResult& result) {
  constexpr double kInstants = 0.01;  // apart [s]
  TrialRunner runner(setup.hand, setup.object);
  TracedTrial traced = TraceTrial(runner, setup, kInstants);
  if (FindFirstDifference(result, traced.result)) return std::nullopt;
  return traced;
}

}  // namespace

void ShowScene(Shell& shell, const ShellArguments&) { PrintResult(FormatScene(shell.scene())); }

std::vector<std::string> ListPostures() { return {"now", "pre", "target"}; }

void ShowPads(Shell& shell, const ShellArguments& arguments) {
  const std::string posture = arguments.empty() ? "now" : ToLower(arguments[0]);
  const std::vector<std::string> known = ListPostures();
  if (std::find(known.begin(), known.end(), posture) == known.end()) {
    throw Error(ErrorKind::kUsage,
                "\"" + posture + "\" is not a posture" + SuggestNames(posture, known));
  }
  PrintResult(FormatPads(shell.scene(), posture));
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
    film.Add(scene.time(), world.state().q, world.state().X_WH, world.CalcObjectPose(),
             world.state().arm, world.state().q_arm);
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

void ReportTrial(Shell& shell, const ShellArguments& arguments) {
  const std::string& file = arguments[0];
  if (std::filesystem::path(file).extension() != ".html") {
    throw Error(ErrorKind::kUsage, "\"" + file + "\" does not end in .html");
  }
  CheckOutputFile(file);
  ShellScene& scene = shell.scene();
  if (!scene.is_over()) throw Error(ErrorKind::kUsage, "the trial goes on; first: run");
  const TrialSetup& setup = scene.setup();
  TrialPageData data;
  data.setup = setup;
  data.record.plan.hand = setup.hand->id;
  data.record.plan.object = setup.object->id;
  data.record.plan.grasp = setup.grasp.id;
  data.record.plan.trial = scene.choice().draw.value_or(0);
  data.record.result = scene.course().End();
  data.traced = TraceAgain(setup, data.record.result);
  data.cards = {
      {"Scene", FormatScene(scene)},
      {"Changes", FormatChanges(scene)},
      {"Why", shell.explanation.empty() ? "not asked for; see: why\n" : shell.explanation},
      {"Contacts", FormatContacts(scene)},
      {"Stability", FormatStability(scene)},
      {"Joints", FormatJoints(scene)}};
  if (!shell.comparison.empty()) data.cards.emplace_back("Draws", shell.comparison);
  data.script = shell.script();
  WriteFileAtomically(file, MakeTrialPage(data));
  PrintResult(file + "\n");
}

}  // namespace graspbench
