#pragma once
/** @file
A study from its recordings to its numbers: every trial is read, cut, cleaned and analysed under the
study's choices and under those of its multiverse; then the statistics (study_statistics.h).

A trial that cannot be analysed is removed with a reason in words; it never stops the study. Nothing
here depends on the clock, the machine or the order in which files lie in a folder.

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

/** What a person should know of a whole study before its numbers: none of it removes a trial.

  digit_never_touches: a digit has no contact in at least 80 % of the included trials, of the
    study or of one object (at least 5 trials).
  frozen_samples: a fifth of all samples, and 100, repeated the one before and count as missing.
  spikes: a thousandth of all samples, and 20, were where no marker gets to and back.
  filtered_export: recordings were low-passed before they were exported (FindLowPassTrace).
  two_rates: recordings differ in their sampling rate by more than 2 %.
  thumb_exchanged: "thumb or index" in three trials or more, and a fifth of all.
  review_lapsed: a person confirmed another time of contact than the one found now. */
struct StudyWarning {
  std::string code;
  std::string text;
};

/** One measure of hand opening in one trial [m]; NaN: missing. */
struct OpeningValues {
  double open = NAN;    ///< largest between the onset and the last contact
  double closed = NAN;  ///< at the last contact
  /** Both without each recorded digit, in the order of StudyResult::digits. */
  std::vector<double> open_without, closed_without;
};

/** Samples in which a trial's opening is kept from its onset to its last contact. */
inline constexpr size_t kNumOpeningSteps = 51;
/** Samples, or up to twice as many, that are left of the curves of a trial once it is analysed:
pictures need no more, and ten thousand trials fit into memory. */
inline constexpr size_t kNumDrawn = 120;

struct StudyTrial : TrialNames {
  std::string id;                         ///< "<participant>-<trial>"
  std::string removed;                    ///< why it does not count; empty: it counts
  std::string removed_code;               ///< the same for programs (trial_removal.h)
  double begin = NAN, end = NAN;          ///< part of the recording [s]; NaN when it was not read
  std::optional<TrialAnalysis> analysis;  ///< its curves thinned to kNumDrawn
  std::vector<ContactReview> reviews;     ///< what a person said of its contacts
  std::vector<OpeningValues> openings;    ///< in the order of HandOpeningList()
  /** The chosen opening at kNumOpeningSteps even instants from the onset to the last contact [m];
  NaN where it is missing. Empty: the trial does not count. */
  std::vector<double> opening_course;
  std::vector<double> universes;  ///< main measure, in the order of StudyResult::universes
  /** The measures that the study tests, each in that order. */
  std::vector<std::vector<double>> measure_universes;

  bool IsKept() const { return removed.empty(); }
};

struct FileFinding {
  std::string file;
  ImportFinding finding;
};

struct StudyResult {
  Study study;
  std::vector<std::string> digits;  ///< ids of those the marker map names
  std::vector<StudyTrial> trials;   ///< in the order of trials.csv, then of time
  std::vector<FileFinding> findings;
  int num_resampled = 0;                         ///< recordings with an uneven clock
  size_t num_frozen = 0;                         ///< samples, of num_samples
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

/** What may watch a run. */
struct StudyWatch {
  /** After every row of trials.csv, with the numbers done and planned. */
  std::function<void(size_t, size_t)> on_row;
  /** Every included trial, with the cleaned data it was analysed from. */
  std::function<void(const StudyTrial&, const ReachTrial&)> on_trial;
  /** The same of every trial that was analysed, whether it counts or not. */
  std::function<void(const StudyTrial&, const ReachTrial&)> on_analysed;
};

/** All but review_lapsed, which RunTrials finds. @pre trials and samples of the result are counted.
*/
std::vector<StudyWarning> FindWarnings(const StudyResult& result);

/** The study without what only its report needs: no bias card, no other choices. */
Study LeaveOutReport(Study study);

/** The trials alone, without statistics and warnings. @throws as RunStudy. */
StudyResult RunTrials(const Study& study, const StudyWatch& watch = {});

/** @throws Error(kFormat) when no recording has a marker that study.yaml names, with file and line;
Error(kNotFound) when no recording could be read. */
StudyResult RunStudy(const Study& study, const StudyWatch& watch = {});

/** Runs the study and writes its tables, the tidy data with their R script (tidy/) and the BIDS
derivative (bids/). @param on_row  as StudyWatch::on_row.
@throws as RunStudy; Error(kIo). */
StudyResult AnalyseStudy(const Study& study, const std::filesystem::path& folder,
                         const std::function<void(size_t, size_t)>& on_row);

}  // namespace graspbench
