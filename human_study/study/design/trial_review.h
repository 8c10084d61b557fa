#pragma once
/** @file
A reviewer's verdicts on single contacts (`graspbench study review`): a table that study.yaml names
under `reviews` and that every run applies.

    trial      id as in trials.csv: P1-3
    digit      thumb, index, middle, ring or little
    verdict    confirmed; corrected: the digit touched at contact_s; no_contact: it did not touch;
               empty: not reviewed
    contact_s  on the recording's clock, for corrected; for confirmed the time that was confirmed:
               it is valid while the contact found is within a frame of it (empty: any contact)
    uncertainty_s  standard uncertainty, for corrected; else that of a frame
    by         the reviewer; optional, as is `note`

A reviewed contact is the same under every choice of the multiverse, and a disagreement of detectors
about it raises no doubt. Tables, events and the report name every reviewed trial. */

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
  int line = 0;  ///< in the table
  std::string trial;
  std::string digit;  ///< id: "FF"
  ReviewVerdict verdict = ReviewVerdict::kConfirmed;
  double contact = NAN;      ///< corrected or confirmed time [s]; NaN: not stated
  double uncertainty = NAN;  ///< [s]; NaN: a frame's
  std::string by;
};

/** Reads the rows with a verdict. Faults are added to `problems`: an unknown digit or verdict, a
correction without a time, or a duplicate digit of a trial. */
std::vector<ContactReview> ReadReviews(DataTable& table, Diagnostics& problems);

/** Removes confirmations of contacts that are now found at another time; returns a text for each,
with its line. @param frame  duration of a frame [s]. */
std::vector<std::string> DropLapsed(const TrialAnalysis& analysis, double frame,
                                    std::vector<ContactReview>& reviews);

/** Sets the contacts of one trial and recomputes its measures. @param frame  duration of a frame
[s].
@throws Error(kFormat) with the line, when the digit is not recorded, a time lies outside the trial,
or there is nothing to confirm. */
void ApplyReviews(const std::vector<ContactReview>& reviews, const AnalysisOptions& options,
                  double begin, double end, double frame, TrialAnalysis& analysis);

/** "index corrected to 1.234 s, thumb confirmed". */
std::string DescribeReviews(const std::vector<ContactReview>& reviews);

}  // namespace graspbench
