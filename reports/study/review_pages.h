#pragma once
/** @file
Pages for a person who looks at every contact of a study: an index, a page a trial with speeds and
distances of the tips, marks of all detectors and uncertainties, and reviews.csv, to be filled in and
named in study.yaml (human_study/study/design/trial_review.h). */

#include <filesystem>
#include <string>
#include <vector>

#include "human_study/study/run/run_study.h"

namespace graspbench {

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

}  // namespace graspbench
