#include "workbench/trial_files.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/gltf/trial_gltf.h"
#include "datasets/session/find_trial.h"
#include "datasets/trajectory/trajectory_form.h"
#include "reports/plots/trial_plots.h"
#include "reports/trial_page.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/pictures/trial_picture.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

/** "tum-can-g2-3"; under a condition, whose name may be long, with the trial's id. */
std::string MakeFileName(PlannedTrial planned) {
  const std::string id = planned.condition ? "-" + planned.id : "";
  planned.condition.reset();
  std::string name = NameTrial(planned) + id;
  std::replace(name.begin(), name.end(), ':', '-');
  return name;
}

/** The name that a person gave, with another ending. */
fs::path ReplaceEnding(const fs::path& file, const std::string& ending) {
  return file.parent_path() / (file.stem().string() + ending);
}

}  // namespace

TrajectoryOutput::TrajectoryOutput(TrajectoryRequest request, size_t num_trials)
    : request_(std::move(request)),
      form_(FindTrajectoryForm(request_.name)),
      num_trials_(num_trials) {
  const bool is_form = request_.name == form_.name;
  if (is_form && request_.out.empty()) {
    throw Error(ErrorKind::kUsage, "--trajectory " + request_.name +
                                       ": a folder is missing; add --out DIR, or name a file");
  }
  if (!is_form && !request_.out.empty()) {
    throw Error(ErrorKind::kUsage,
                "--trajectory \"" + request_.name + "\" is a file, and --out " +
                    "needs a folder; with --out give the format only: " + form_.name);
  }
  if (!is_form && !form_.collect && num_trials > 1) {
    throw Error(ErrorKind::kUsage, "--trajectory \"" + request_.name +
                                       "\" is one file, and there are " +
                                       std::to_string(num_trials) + " trials; --trajectory " +
                                       form_.name + " --out DIR writes one for each");
  }
  if (is_form) {
    staged_.emplace(OutputRequest{request_.out,
                                  "trajectories",
                                  request_.replace,
                                  {request_.session},
                                  "graspbench replay DIR --trajectory " + request_.name +
                                      " --fps " + FormatJson(request_.rate) + " --out OUT"});
  } else {
    CheckOutputFile(request_.name);
  }
  if (form_.collect) collection_ = form_.collect();
}

void TrajectoryOutput::Take(size_t trial, const PlannedTrial& planned, const TrialSetup& setup,
                            const TracedTrial& traced) {
  std::optional<TrialTrajectory> trajectory;
  if (!traced.trace.empty() || num_trials_ == 1) {
    trajectory = MakeTrajectory(planned, setup, traced, request_.rate);
  }
  std::vector<TrajectoryFile> files;
  if (trajectory && form_.make) files = form_.make(*trajectory);
  if (staged_) {
    for (const TrajectoryFile& file : files) {
      WriteFile(staged_->path() / (MakeFileName(planned) + file.ending), file.bytes);
    }
    files.clear();
  }
  const std::lock_guard lock(mutex_);
  num_skipped_ += !trajectory;
  if (!files.empty()) files_ = std::move(files);
  if (collection_) Collect(trial, std::move(trajectory));
}

void TrajectoryOutput::Collect(size_t trial, std::optional<TrialTrajectory> trajectory) {
  waiting_[trial] = std::move(trajectory);
  while (!waiting_.empty() && waiting_.begin()->first == num_collected_) {
    if (waiting_.begin()->second) collection_->Add(*waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
    ++num_collected_;
  }
}

std::vector<fs::path> TrajectoryOutput::Commit() {
  if (collection_) files_ = {{"." + std::string(form_.name), collection_->Finish()}};
  if (staged_) {
    for (const TrajectoryFile& file : files_) {
      WriteFile(staged_->path() / ("trajectories" + file.ending), file.bytes);
    }
    staged_->Commit();
    return {request_.out};
  }
  std::vector<fs::path> written;
  for (const TrajectoryFile& file : files_) {
    written.push_back(ReplaceEnding(request_.name, file.ending));
    CheckOutputFile(written.back());
  }
  for (size_t i = 0; i < files_.size(); ++i) WriteOutputFile(written[i], files_[i].bytes);
  return written;
}

namespace {

SceneView ParseView(const TrialFileOptions& options) {
  return ParseSceneView(options.view, "trial --help");
}

std::string MakeTraceTable(const TrialFileOptions&, const ExaminedTrial& trial) {
  return FormatCsv(ListInstantColumns(*trial.setup.hand, trial.traced), trial.traced.trace);
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

template <const char* kForm>
std::string MakeTrialTrajectory(const TrialFileOptions&, const ExaminedTrial& trial) {
  const TrialTrajectory trajectory =
      MakeTrajectory(trial.planned, trial.setup, trial.traced, kTrajectoryRate);
  return MakeTrajectoryFiles(FindTrajectoryForm(kForm), trajectory).front().bytes;
}
constexpr char kMcap[] = "mcap", kH5[] = "h5", kNpz[] = "npz";

std::string MakeWholePage(const TrialFileOptions& options, const ExaminedTrial& trial) {
  TrialPageData data;
  data.setup = trial.setup;
  data.name = NameTrial(trial.planned);
  data.record = {trial.planned, trial.traced.result, {}};
  data.traced = trial.traced;
  data.cards = {{"Trial", FormatTrial(trial, options.folder)}};
  data.script = {"open " + QuoteForShell(options.folder) + " " + trial.planned.id, "run"};
  data.commands = {"graspbench trial DIR " + trial.planned.id + " --page FILE.html"};
  data.explanation = trial.explanation;
  if (!trial.recorded || trial.difference) data.warnings = {FormatComparison(trial)};
  return MakeTrialPage(data);
}

}  // namespace

const std::vector<TrialFile>& ListTrialFiles() {
  static const std::vector<TrialFile> files = {
      {"--trace", ".csv", "FILE.csv|.svg", "write every step as a table, or plot forces and joints",
       true, &MakeTraceTable},
      {"--trace", ".svg", "", "", false, &MakeTraceDrawing},
      {"--render", ".png", "FILE.png", "draw one instant with its forces", false,
       &MakeTrialPicture},
      {"--film", ".webp", "FILE.webp", "draw the whole trial as an animation in real time", false,
       &MakeTrialFilm},
      {"--trajectory", ".glb", "FILE.glb|.mcap|.h5|.npz",
       "write the motion of the trial: animated 3-D model (glTF), messages (MCAP) or arrays (HDF5, "
       "NumPy); graspbench replay writes several trials",
       false, &MakeTrialModel},
      {"--trajectory", ".mcap", "", "", true, &MakeTrialTrajectory<kMcap>},
      {"--trajectory", ".h5", "", "", true, &MakeTrialTrajectory<kH5>},
      {"--trajectory", ".npz", "", "", true, &MakeTrialTrajectory<kNpz>},
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
                  (num_endings == 1 ? ", the only format" : ", the available formats"));
}

}  // namespace graspbench
