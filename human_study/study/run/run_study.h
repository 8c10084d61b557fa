#pragma once
/** @file
Runs a study from recordings to results. Every trial is read, cut, cleaned and analysed under the
study's choices and under those of its multiverse; then the statistics are computed
(study_statistics.h).

A trial that cannot be analysed is removed with a reason; it never stops the study. Results do not
depend on the time, the machine or the order of files in a folder.

@code
const StudyResult result = RunStudy(LoadStudy("pilot/study.yaml"));
for (const StudyTrial& trial : result.trials) {
  if (!trial.IsKept()) continue;  // trial.removed says why
  const double forming_time = trial.analysis->timing.gft;  // [s]; NaN: a contact is not resolved
}
@endcode */

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "human_study/recording/recording.h"
#include "human_study/study/design/study_config.h"
#include "human_study/study/inference/study_statistics.h"

namespace graspbench {

/** A warning about the study as a whole; warnings do not remove trials.

  digit_never_touches: a digit has no contact in at least 80 % of the included trials, of the
    study or of one object (at least 5 trials).
  frozen_samples: a fifth of all samples, and 100, repeated the previous one and are treated as
    missing.
  spikes: a thousandth of all samples, and 20, were at positions that no marker can reach and
    leave between two frames.
  filtered_export: recordings were low-passed before they were exported (FindLowPassTrace).
  two_rates: recordings differ in their sampling rate by more than 2 %.
  thumb_exchanged: "thumb or index" in three trials or more, and a fifth of all.
  review_lapsed: the contact time found differs from the time that a reviewer confirmed. */
struct StudyWarning {
  std::string code;
  std::string text;
};

/** One measure of hand opening in one trial [m]; NaN: missing. */
struct OpeningValues {
  double open = NAN;    ///< largest between the onset and the last contact
  double closed = NAN;  ///< at the last contact
  /** Both values without each recorded digit, in the order of StudyResult::digits. */
  std::vector<double> open_without, closed_without;
};

/** Number of samples stored of a trial's opening between onset and last contact. */
inline constexpr size_t kNumOpeningSteps = 51;
/** Minimum number of samples (at most twice as many) kept of a trial's curves after the analysis.
This suffices for figures, and ten thousand trials fit into memory. */
inline constexpr size_t kNumDrawn = 120;

struct StudyTrial : TrialNames {
  std::string id;                         ///< "<participant>-<trial>"
  std::string removed;                    ///< reason for removal; empty: included
  std::string removed_code;               ///< code of the reason (trial_removal.h)
  double begin = NAN, end = NAN;          ///< part of the recording [s]; NaN if not read
  std::optional<TrialAnalysis> analysis;  ///< with curves thinned to kNumDrawn
  std::vector<ContactReview> reviews;     ///< reviews of its contacts
  std::vector<OpeningValues> openings;    ///< in the order of HandOpeningList()
  /** The chosen opening at kNumOpeningSteps even instants from the onset to the last contact [m];
  NaN where it is missing. Empty: the trial is removed. */
  std::vector<double> opening_course;
  std::vector<double> universes;  ///< main measure, in the order of StudyResult::universes
  /** The measures that the study tests, each in the order of `universes`. */
  std::vector<std::vector<double>> measure_universes;

  bool IsKept() const { return removed.empty(); }
};

struct FileFinding {
  std::string file;
  ImportFinding finding;
};

struct StudyResult {
  Study study;
  std::vector<std::string> digits;  ///< ids of those in the marker map
  std::vector<StudyTrial> trials;   ///< in the order of trials.csv, then of time
  std::vector<FileFinding> findings;
  int num_resampled = 0;                         ///< recordings with an uneven clock
  size_t num_frozen = 0;                         ///< frozen samples, of num_samples
  size_t num_spikes = 0;                         ///< samples
  double lowest_rate = NAN, highest_rate = NAN;  ///< of the recordings [Hz]
  size_t num_samples = 0;                        ///< of all markers in all recordings
  std::vector<StudyWarning> warnings;
  double rate = NAN;            ///< median of the recordings [Hz]
  double noise = NAN;           ///< median over trials, SD of one coordinate of the thumb [m]
  int num_learned = 0;          ///< contacts from which analysis.contact.depths was learned
  double advised_cutoff = NAN;  ///< median over trials, by residual analysis of the thumb [Hz]
  std::vector<Universe> universes;
  StudyStatistics statistics;

  int CountKept() const;
};

/** Callbacks during a run. */
struct StudyWatch {
  /** Called after every row of trials.csv, with the numbers done and planned. */
  std::function<void(size_t, size_t)> on_row;
  /** Called for every included trial, with the cleaned data of its analysis. */
  std::function<void(const StudyTrial&, const ReachTrial&)> on_trial;
  /** As on_trial, for every analysed trial, whether included or removed. */
  std::function<void(const StudyTrial&, const ReachTrial&)> on_analysed;
};

/** Finds all warnings but review_lapsed, which RunTrials finds. @pre trials and samples of the
result are counted. */
std::vector<StudyWarning> FindWarnings(const StudyResult& result);

/** Returns the study without the parts needed only for its report: no bias card, no multiverse. */
Study LeaveOutReport(Study study);

/** Runs only the trials, without statistics and warnings. @throws as RunStudy. */
StudyResult RunTrials(const Study& study, const StudyWatch& watch = {});

/** Runs the whole study. @throws Error(kFormat) when no recording has a marker that study.yaml
names, with file and line; Error(kNotFound) when no recording could be read. */
StudyResult RunStudy(const Study& study, const StudyWatch& watch = {});

/** Runs the study and writes its tables, the tidy data with their R script (tidy/) and the BIDS
derivative (bids/). @param on_row  as StudyWatch::on_row.
@throws as RunStudy; Error(kIo). */
StudyResult AnalyseStudy(const Study& study, const std::filesystem::path& folder,
                         const std::function<void(size_t, size_t)>& on_row);

}  // namespace graspbench
