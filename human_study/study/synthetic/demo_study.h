#pragma once
/** @file
A synthetic study as files on disk, and how well its truth is recovered: a demonstration of the
workbench, and an end-to-end test from files to measures. */

#include <filesystem>
#include <vector>

#include "human_study/study/run/run_study.h"
#include "human_study/study/synthetic/synthetic_study.h"

namespace graspbench {

/** Six people, four cylinders, five trials each, five digits at 200 Hz with short dropouts. */
SyntheticOptions MakeDemoOptions();

/** Writes study.yaml, trials.csv, objects.csv, hypotheses.csv and recordings/ into the folder.
@throws Error(kIo). */
void WriteDemoStudy(const std::vector<SyntheticTrial>& trials, const std::filesystem::path& folder);

/** Errors of the event times that a study found, over the included trials [s]. */
struct TruthComparison {
  int num_trials = 0;  ///< planned
  int num_kept = 0;
  Answer<Summary> onset, contact, gft, closure_start;  ///< found - true
};

/** @param trials  trials of the study, in the order of its trials.csv. */
TruthComparison CompareWithTruth(const StudyResult& result,
                                 const std::vector<SyntheticTrial>& trials);

}  // namespace graspbench
