#include "workbench/trajectory_output.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/session/find_trial.h"

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
                    "asks for a folder; with --out name the form alone: " + form_.name);
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

}  // namespace graspbench
