#pragma once
/** @file
One trial of a study as figures, for the report and for the review pages. */

#include <filesystem>
#include <string>
#include <vector>

#include "human_study/study/run/run_study.h"
#include "reports/page/html.h"

namespace graspbench {

// @pre for all functions: the trial was analysed.

/** Draws the wrist speed, with the onset threshold if the rule has one. */
Html DrawTrialSpeed(const StudyTrial& trial, const MovementOptions& options);
/** Draws the hand opening over time, with the events that the measures are computed from. */
Html DrawTrialOpening(const StudyTrial& trial);
/** Draws the curve that shows why a trial was removed, or the opening of an included trial. */
Html DrawDecidingCurve(const StudyTrial& trial, const MovementOptions& options);
/** Draws one row per digit: a mark per detector, and the 95 % interval of the accepted contact as a
span. */
Html DrawTrialContacts(const StudyTrial& trial);
/** Draws the speed of every fingertip relative to the object, and its distance, with the accepted
contacts. The distance is to the surface if the shape is known, else to the tip's position during
the hold. @param reach  input of the trial's analysis. */
Html DrawTrialTips(const StudyTrial& trial, const ReachTrial& reach,
                   const AnalysisOptions& options);
/** "P1-3, diameter 30 mm: GFT 31 ms, ..", with flags or the removal reason. */
std::string DescribeTrial(const StudyTrial& trial, const std::vector<Factor>& factors);

/* Pages for a reviewer who checks every contact of a study: an index, and a page per trial with the
speeds and distances of the tips, the marks of all detectors, and uncertainties. Also reviews.csv,
to be filled in and named in study.yaml (human_study/study/design/trial_review.h). */
class ReviewPages {
 public:
  /** Creates the folders. @throws Error(kIo), as do all functions below. */
  explicit ReviewPages(const std::filesystem::path& folder);

  /** Writes a trial's page. @param options  settings of the trial's analysis. */
  void WriteTrial(const StudyTrial& trial, const ReachTrial& reach,
                  const std::vector<Factor>& factors, const AnalysisOptions& options);
  /** Writes index.html and reviews.csv, where rows without a verdict have no effect. Verdicts that
  were applied are written again. */
  void Finish(const StudyResult& result) const;

 private:
  std::filesystem::path folder_;
};

/** Makes the data dictionary of reviews.csv. */
Json MakeReviewSchema();

}  // namespace graspbench
