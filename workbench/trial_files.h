#pragma once
/** @file
The files that `graspbench trial` writes for one trial, each a row of a table. */

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

/** Picture options as the user gave them. */
struct TrialFileOptions {
  std::string folder;  ///< name of the session's folder, for a page
  std::string at;      ///< instant; empty: the end of stabilisation, or of a shorter trial
  std::vector<std::string> view;
  std::string size = "960x720";
};

struct TrialFile {
  const char* option;  ///< an option may have several rows, told apart by the file's ending
  const char* ending;
  const char* hint;  ///< value name in the help; taken from the option's first row
  const char* text;
  bool needs_every_step;  ///< of the physics; else instants some 0.01 s apart suffice
  /** Returns the file's bytes. @throws Error when there is nothing to show. */
  std::string (*make)(const TrialFileOptions& options, const ExaminedTrial& trial);
};

const std::vector<TrialFile>& ListTrialFiles();

/** Returns the row for a requested file.
@throws Error(kUsage) when the option writes no file with this ending. */
const TrialFile& FindTrialFile(const std::string& option, const std::string& file);

/** Where the trajectories of replayed trials are written: one file, or a folder of their own. */
struct TrajectoryRequest {
  std::string name;  ///< a file ("trial.mcap"), or a format ("mcap") for the folder `out`
  std::filesystem::path out;
  bool replace = false;           ///< overwrite an older folder of trajectories
  double rate = kTrajectoryRate;  ///< instants per second
  std::filesystem::path session;  ///< its folder
};

class TrajectoryOutput {
 public:
  /** @throws Error(kUsage) when the name has no known format, when one file is requested for
  several trials and cannot hold them, or when the output path is blocked. */
  TrajectoryOutput(TrajectoryRequest request, size_t num_trials);

  /** Takes one trial. Thread-safe; called once per trial, in any order.
  @throws Error(kUnsupported) when it is the only trial and could not begin; Error(kIo). */
  void Take(size_t trial, const PlannedTrial& planned, const TrialSetup& setup,
            const TracedTrial& traced);
  /** Completes the output after the last trial. @returns the files written. @throws Error(kUsage,
  kIo). */
  std::vector<std::filesystem::path> Commit();
  /** Trials that could not begin and have no trajectory. */
  int num_skipped() const { return num_skipped_; }

 private:
  void Collect(size_t trial, std::optional<TrialTrajectory> trajectory);

  TrajectoryRequest request_;
  const TrajectoryForm& form_;
  const size_t num_trials_;
  std::optional<StagedFolder> staged_;  // set for a folder
  std::mutex mutex_;                    // guards everything below
  std::unique_ptr<TrajectoryCollection> collection_;
  std::map<size_t, std::optional<TrialTrajectory>> waiting_;  // until all earlier trials are taken
  size_t num_collected_ = 0;
  std::vector<TrajectoryFile> files_;  // for a single output file
  int num_skipped_ = 0;
};

}  // namespace graspbench
