#pragma once
/** @file
What a person said of single contacts after looking at them (`graspbench study review`): a table
that study.yaml names under `reviews`, replayed by every run.

    trial      id as in trials.csv: P1-3
    digit      thumb, index, middle, ring or little
    verdict    confirmed; corrected: the digit touched at contact_s; no_contact: it did not touch;
               empty: not looked at
    contact_s  on the recording's clock, for corrected; for confirmed the time that was confirmed:
               it holds while the contact found is no more than a frame away (empty: whatever is
               found)
    uncertainty_s  standard, for corrected; else that of a frame
    by         who looked; optional, as `note`

A reviewed contact is the same under every choice of the multiverse, and detectors that disagree
about it raise no doubt. Tables, events and the report name every trial it happened to. */

#include <cmath>
#include <string>
#include <vector>

#include "human_study/events/trial_analysis.h"

namespace graspbench {

class DataTable;
class Diagnostics;

enum class ReviewVerdict { kConfirmed, kCorrected, kNoContact };
/** "confirmed" and so on. */
const char* NameOf(ReviewVerdict verdict);

struct ContactReview {
  int line = 0;  ///< of the table
  std::string trial;
  std::string digit;  ///< id: "FF"
  ReviewVerdict verdict = ReviewVerdict::kConfirmed;
  double contact = NAN;      ///< corrected or confirmed to be there [s]; NaN: not said
  double uncertainty = NAN;  ///< [s]; NaN: a frame's
  std::string by;
};

/** Rows with a verdict. Faults go into the table's problems: an unknown digit or verdict, a
correction without a time, a digit of a trial twice. */
std::vector<ContactReview> ReadReviews(DataTable& table, Diagnostics& problems);

/** Takes out confirmations of a contact that is elsewhere now; a text for each, with its line.
@param frame  length of one [s]. */
std::vector<std::string> DropLapsed(const TrialAnalysis& analysis, double frame,
                                    std::vector<ContactReview>& reviews);

/** Sets the contacts of one trial and all measures of it.
@param frame  length of one [s].
@throws Error(kFormat) with the line, when the digit is not recorded, a time lies outside of the
trial, or there is nothing to confirm. */
void ApplyReviews(const std::vector<ContactReview>& reviews, const AnalysisOptions& options,
                  double begin, double end, double frame, TrialAnalysis& analysis);

/** "index corrected to 1.234 s, thumb confirmed". */
std::string DescribeReviews(const std::vector<ContactReview>& reviews);

}  // namespace graspbench
