#pragma once
/** @file
The files that `graspbench trial` writes of one trial: one row of a list each. */

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "datasets/trajectory/trajectory_form.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/text/trial_text.h"

namespace graspbench {

/** How a person wants the pictures. */
struct TrialFileOptions {
  std::string folder;  ///< name of the session's, for a page
  std::string at;      ///< empty: when it was closed, or the end of a shorter trial
  std::vector<std::string> view;
  std::string size = "960x720";
};

struct TrialFile {
  const char* option;  ///< may have several rows: the file's ending says which
  const char* ending;
  const char* hint;  ///< the option's, in the help; of its first row
  const char* text;
  bool needs_every_step;  ///< of the trial; else some 0.01 s apart is enough
  /** The file's bytes. @throws Error when there is nothing to be seen. */
  std::string (*make)(const TrialFileOptions& options, const ExaminedTrial& trial);
};

const std::vector<TrialFile>& ListTrialFiles();

/** The row for a file that was asked for.
@throws Error(kUsage) when it ends in nothing that the option writes. */
const TrialFile& FindTrialFile(const std::string& option, const std::string& file);

/** Where the trajectories of replayed trials go: one file, or a folder of their own. */
struct TrajectoryRequest {
  std::string name;  ///< a file, "trial.mcap", or a form, "mcap", for the folder `out`
  std::filesystem::path out;
  bool replace = false;           ///< an older folder of trajectories
  double rate = kTrajectoryRate;  ///< instants a second
  std::filesystem::path session;  ///< its folder
};

class TrajectoryOutput {
 public:
  /** @throws Error(kUsage) when the name is no form's, when one file is asked for several trials
  and cannot hold them, or when something stands in the way. */
  TrajectoryOutput(TrajectoryRequest request, size_t num_trials);

  /** Several threads may call it, once for each trial in any order.
  @throws Error(kUnsupported) when it is the only one and could not begin; Error(kIo). */
  void Take(size_t trial, const PlannedTrial& planned, const TrialSetup& setup,
            const TracedTrial& traced);
  /** After the last trial. @returns what was written. @throws Error(kUsage, kIo). */
  std::vector<std::filesystem::path> Commit();
  /** Trials that could not begin and have no trajectory. */
  int num_skipped() const { return num_skipped_; }

 private:
  void Collect(size_t trial, std::optional<TrialTrajectory> trajectory);

  TrajectoryRequest request_;
  const TrajectoryForm& form_;
  const size_t num_trials_;
  std::optional<StagedFolder> staged_;  // of a folder
  std::mutex mutex_;                    // guards everything below
  std::unique_ptr<TrajectoryCollection> collection_;
  std::map<size_t, std::optional<TrialTrajectory>> waiting_;  // for those before them
  size_t num_collected_ = 0;
  std::vector<TrajectoryFile> files_;  // of a single file's name
  int num_skipped_ = 0;
};

}  // namespace graspbench
