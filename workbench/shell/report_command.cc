#include <filesystem>
#include <optional>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/trial/trial_trace.h"
#include "datasets/records/compare_results.h"
#include "reports/trial_page.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

/** The course of a trial that nobody changed on its way. */
std::optional<TracedTrial> TraceAgain(const TrialSetup& setup, const TrialResult& result) {
  constexpr double kInstants = 0.01;  // apart [s]
  TrialRunner runner(setup.hand, setup.object);
  TracedTrial traced = TraceTrial(runner, setup, kInstants);
  if (FindFirstDifference(result, traced.result)) return std::nullopt;
  return traced;
}

}  // namespace

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
