#pragma once
/** @file
How far a session's results depend on the numerics: its trials again with other steps, other
contact stiffnesses and another backend, compared one by one with the stored results.

A verdict flips when a success becomes a failure or the other way round; one failure that becomes
another is no flip. Times of contacts are compared where both trials have them. */

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/records/trial_record.h"
#include "datasets/session/session_store.h"
#include "workbench/experiments/observer.h"

namespace graspbench {

struct NumericsVariant {
  std::string id;  ///< "half step"
  SimConfig sim;
  bool is_compliant = false;  ///< core/physics/compliant_world.h instead of our own world
};
/** Half and double step, half and double contact stiffness (normal and tangential), and Simbody's
compliant contact ("compliant"). */
std::vector<NumericsVariant> ListNumericsVariants(const SimConfig& sim);

/** The first `trials_per_cell` finished trials of each hand, object and grasp; in the records'
order. */
std::vector<TrialRecord> ChooseTrials(const std::vector<TrialRecord>& records, int trials_per_cell);

/** The trials that the variant can do: for "compliant" those whose object it has a geometry for. */
std::vector<TrialRecord> FindCovered(const std::vector<TrialRecord>& trials,
                                     const NumericsVariant& variant, const SessionInputs& inputs);

/** Simulates the trials again. @returns their results in the same order; the same for any number of
workers. @param config  of the session. @throws Error(kInterrupted). */
std::vector<TrialResult> RerunTrials(const std::vector<TrialRecord>& trials,
                                     const NumericsVariant& variant, const SessionConfig& config,
                                     const SessionInputs& inputs, int num_workers,
                                     Observer& observer, const std::atomic<bool>& stop);

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
/** Runs the first `trials_per_cell` finished trials of each cell with every variant; each variant
is a stage. @throws Error(kUsage) without a finished trial, and when hands, objects or physics have
changed since; Error(kInterrupted). */
NumericsCheck CheckNumerics(const std::filesystem::path& folder, const Session& session,
                            int trials_per_cell, int num_workers, Observer& observer,
                            const std::atomic<bool>& stop);

/** One row per comparison; missing = empty. */
std::string FormatNumericsCsv(const std::vector<NumericsComparison>& comparisons);

/** {variants: [..], flips: [..]}. */
Json MakeNumericsJson(const std::vector<NumericsSummary>& summaries,
                      const std::vector<NumericsComparison>& comparisons);

}  // namespace graspbench
