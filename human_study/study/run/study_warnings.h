#pragma once
/** @file
What a person should know of a whole study before its numbers: none of it removes a trial.

  digit_never_touches: a digit has no contact in at least 80 % of the trials that count, of the
    study or of one object (at least 5 trials).
  frozen_samples: a fifth of all samples, and 100, repeated the one before and count as missing.
  spikes: a thousandth of all samples, and 20, were where no marker gets to and back.
  filtered_export: recordings were low-passed before they were exported (low_pass_trace.h).
  two_rates: recordings differ in their sampling rate by more than 2 %.
  review_lapsed: a person confirmed another time of contact than the one found now. */

#include <string>
#include <vector>

namespace graspbench {

struct StudyResult;

struct StudyWarning {
  std::string code;
  std::string text;
};

/** @pre trials and samples of the result are counted. */
std::vector<StudyWarning> FindNeverTouching(const StudyResult& result);
std::vector<StudyWarning> FindManyFrozen(const StudyResult& result);
std::vector<StudyWarning> FindSpikes(const StudyResult& result);
std::vector<StudyWarning> FindFilteredExports(const StudyResult& result);
/** "thumb or index" in three trials or more, and a fifth of all. */
std::vector<StudyWarning> FindExchangedThumbs(const StudyResult& result);
std::vector<StudyWarning> FindTwoRates(const StudyResult& result);

}  // namespace graspbench
