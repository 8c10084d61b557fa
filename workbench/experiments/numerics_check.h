#pragma once
/** @file
How far a session's results depend on the numerics: its trials again with other steps, other
contact stiffnesses and another backend, compared one by one with the stored results.

A verdict flips when a success becomes a failure or the other way round; one failure that becomes
another is no flip. Times of contacts are compared where both trials have them. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "datasets/records/trial_record.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {

/** Half and double step, half and double contact stiffness (normal and tangential), and Simbody's
compliant contact ("compliant") where it has a geometry for hand and object; what is out of a
session's range is left out. */
std::vector<Condition> ListNumericsVariants(const SessionConfig& config);

/** One variant of one trial beside its stored result. */
struct NumericsComparison {
  std::string variant;
  TrialRecord before;
  TrialResult after;

  bool is_flipped() const {
    return (before.result.outcome == Outcome::kSuccess) != (after.outcome == Outcome::kSuccess);
  }
};

struct ChangeSummary {
  double median = 0.0;  ///< of the absolute changes; NaN: none could be compared
  double max = 0.0;
  int num = 0;  ///< how many could be compared
};

struct NumericsSummary {
  std::string variant;
  int num_trials = 0;
  int num_successes_before = 0;
  int num_successes = 0;
  int num_flips = 0;
  int num_numerical_failures = 0;
  ChangeSummary gct, gft, got;  ///< [s]
  ChangeSummary sigma;
};
NumericsSummary SummariseNumerics(const std::string& variant,
                                  const std::vector<NumericsComparison>& comparisons);

struct NumericsCheck {
  std::vector<NumericsComparison> comparisons;
  std::vector<NumericsSummary> summaries;
};
/** Its folder, in which RunExperiment runs it. @throws as PrepareExperiment. */
PreparedSession PrepareNumerics(const ExperimentRequest& request);
/** Of what is finished, variant by variant. */
NumericsCheck CompareNumerics(const Session& experiment);

/** One row per comparison; missing = empty. */
std::string FormatNumericsCsv(const std::vector<NumericsComparison>& comparisons);

/** {variants: [..], flips: [..]}. */
Json MakeNumericsJson(const std::vector<NumericsSummary>& summaries,
                      const std::vector<NumericsComparison>& comparisons);

}  // namespace graspbench
