#pragma once
/** @file
Writes the cleaned trials and their events as a BIDS derivative with the motion datatype (BIDS
specification, modality-specific-files/motion; Jeung et al. 2024):

    dataset_description.json, participants.tsv, README
    sub-<label>/motion/sub-<label>_task-<task>_tracksys-markers_run-<n>_desc-cleaned_motion.tsv
        with _channels.tsv and _motion.json; sub-<label>_task-<task>_run-<n>_desc-cleaned_events.tsv

Labels keep the letters and digits of the participant's name. Positions are in metres, on an even
clock that starts with the trial; event times use the same clock. trials.csv gives the trial's start
in the recording. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "human_study/study/run/run_study.h"

namespace graspbench {

class MotionBidsWriter {
 public:
  /** Creates the folder and removes the description of an earlier run. @throws Error(kIo). */
  MotionBidsWriter(const std::filesystem::path& folder, const Study& study);

  /** Writes one included trial. @throws Error(kIo). */
  void WriteTrial(const StudyTrial& trial, const ReachTrial& reach);
  /** Writes the files about the whole dataset; dataset_description.json is last, after the trials
  are safely on the disk. @throws Error(kIo). */
  void Finish() const;

 private:
  const std::string& FindLabel(const std::string& participant);

  std::filesystem::path folder_;
  const Study* study_;
  std::map<std::string, std::string> labels_;  // by participant
  std::map<std::string, int> num_runs_;        // by label
};

}  // namespace graspbench
