#pragma once
/** @file
One trial of a study as figures, for the report and for the pages of a review. */

#include <filesystem>
#include <string>
#include <vector>

#include "human_study/study/run/run_study.h"
#include "reports/page/html.h"

namespace graspbench {

// @pre the trial was analysed.

/** Speed of the wrist with the threshold of the onset, where the rule has one. */
Html DrawTrialSpeed(const StudyTrial& trial, const MovementOptions& options);
/** Hand opening over time with the events that the measures rest on. */
Html DrawTrialOpening(const StudyTrial& trial);
/** The curve that shows why it does not count, or the opening of one that does. */
Html DrawDecidingCurve(const StudyTrial& trial, const MovementOptions& options);
/** One row a digit: a mark a detector, a span of the believed one's 95 %. */
Html DrawTrialContacts(const StudyTrial& trial);
/** Speed of every tip against the object, and its distance: from the surface where the shape is
known, else from its place in the hold; with the contacts believed.
@param reach  what the trial was analysed from. */
Html DrawTrialTips(const StudyTrial& trial, const ReachTrial& reach,
                   const AnalysisOptions& options);
/** "P1-3, diameter 30 mm: GFT 31 ms, ..", with flags or the reason of its removal. */
std::string DescribeTrial(const StudyTrial& trial, const std::vector<Factor>& factors);

/* Pages for a person who looks at every contact of a study: an index, a page a trial with speeds and
distances of the tips, marks of all detectors and uncertainties, and reviews.csv, to be filled in and
named in study.yaml (human_study/study/design/trial_review.h). */
class ReviewPages {
 public:
  /** Makes the folders. @throws Error(kIo), as all below. */
  explicit ReviewPages(const std::filesystem::path& folder);

  /** A page. @param options  what the trial was analysed by. */
  void WriteTrial(const StudyTrial& trial, const ReachTrial& reach,
                  const std::vector<Factor>& factors, const AnalysisOptions& options);
  /** index.html and reviews.csv, in which a row without a verdict counts for nothing; verdicts that
  were replayed stand there again. */
  void Finish(const StudyResult& result) const;

 private:
  std::filesystem::path folder_;
};

/** The data dictionary of reviews.csv. */
Json MakeReviewSchema();

}  // namespace graspbench
