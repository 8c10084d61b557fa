#include "workbench/trial_files.h"

#include <filesystem>

#include "core/base/error.h"
#include "datasets/gltf/trial_gltf.h"
#include "datasets/records/trace_table.h"
#include "datasets/trajectory/trajectory_form.h"
#include "reports/plots/trial_plots.h"
#include "reports/trial_page.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/pictures/trial_picture.h"

namespace graspbench {
namespace {

SceneView ParseView(const TrialFileOptions& options) {
  return ParseSceneView(options.view, "trial --help");
}

std::string MakeTraceTable(const TrialFileOptions&, const ExaminedTrial& trial) {
  return FormatCsv(ListTraceColumns(*trial.setup.hand), trial.traced.trace);
}

std::string MakeTraceDrawing(const TrialFileOptions&, const ExaminedTrial& trial) {
  return MakeTrialSvg(*trial.setup.hand, trial.traced, NameTrial(trial.planned));
}

std::string MakeTrialPicture(const TrialFileOptions& options, const ExaminedTrial& trial) {
  return EncodePng(DrawTrial(trial.setup, trial.traced, FindNamedInstant(trial.traced, options.at),
                             ParseView(options), ParsePictureSize(options.size)));
}

std::string MakeTrialFilm(const TrialFileOptions& options, const ExaminedTrial& trial) {
  constexpr PictureSize kFilmSize = {480, 360};  // as in the shell
  return FilmTrial(trial.setup, trial.traced, ParseView(options), kFilmSize);
}

std::string MakeTrialModel(const TrialFileOptions&, const ExaminedTrial& trial) {
  return MakeTrialGlb(*trial.setup.hand, *trial.setup.object, trial.traced);
}

/** @param form  of trajectories. */
std::string MakeTrialTrajectory(const ExaminedTrial& trial, const char* form) {
  const TrialTrajectory trajectory =
      MakeTrajectory(trial.planned, trial.setup, trial.traced, kTrajectoryRate);
  return MakeTrajectoryFiles(FindTrajectoryForm(form), trajectory).front().bytes;
}

std::string MakeTrialMcap(const TrialFileOptions&, const ExaminedTrial& trial) {
  return MakeTrialTrajectory(trial, "mcap");
}

std::string MakeTrialH5(const TrialFileOptions&, const ExaminedTrial& trial) {
  return MakeTrialTrajectory(trial, "h5");
}

std::string MakeWholePage(const TrialFileOptions& options, const ExaminedTrial& trial) {
  TrialPageData data;
  data.setup = trial.setup;
  data.name = NameTrial(trial.planned);
  data.record = {trial.planned, trial.traced.result, {}};
  data.traced = trial.traced;
  data.cards = {{"Trial", FormatTrial(trial, options.folder)}};
  data.script = {"open " + QuoteForShell(options.folder) + " " + trial.planned.id, "run"};
  data.commands = {"graspbench trial DIR " + trial.planned.id + " --page FILE.html"};
  if (!trial.recorded || trial.difference) data.warnings = {FormatComparison(trial)};
  return MakeTrialPage(data);
}

}  // namespace

const std::vector<TrialFile>& ListTrialFiles() {
  static const std::vector<TrialFile> files = {
      {"--trace", ".csv", "FILE.csv|.svg",
       "write every step as a table, or forces and joints as curves", true, &MakeTraceTable},
      {"--trace", ".svg", "", "", false, &MakeTraceDrawing},
      {"--render", ".png", "FILE.png", "draw an instant with its forces", false, &MakeTrialPicture},
      {"--film", ".webp", "FILE.webp", "draw the whole trial as a moving picture, in real time",
       false, &MakeTrialFilm},
      {"--trajectory", ".glb", "FILE.glb|.mcap|.h5",
       "write the whole trial as a moving 3-D model (glTF), as messages (MCAP) or tables (HDF5); "
       "graspbench replay writes many",
       false, &MakeTrialModel},
      {"--trajectory", ".mcap", "", "", true, &MakeTrialMcap},
      {"--trajectory", ".h5", "", "", true, &MakeTrialH5},
      {"--page", ".html", "FILE.html", "write a page with pictures, curves and a 3-D view", false,
       &MakeWholePage}};
  return files;
}

const TrialFile& FindTrialFile(const std::string& option, const std::string& file) {
  std::string endings;
  int num_endings = 0;
  for (const TrialFile& form : ListTrialFiles()) {
    if (form.option != option) continue;
    if (std::filesystem::path(file).extension() == form.ending) return form;
    endings += (num_endings++ > 0 ? " or " : "") + std::string(form.ending);
  }
  throw Error(ErrorKind::kUsage,
              option + ": \"" + file + "\" does not end in " + endings +
                  (num_endings == 1 ? ", the only form there is" : ", the forms there are"));
}

}  // namespace graspbench
