#pragma once
/** @file
How far a session's results depend on numerics: its trials compared with the same trials under other
steps and stiffnesses (graspbench check-numerics), one by one and seat by seat.

A verdict flips if a success becomes a failure or vice versa; a change between kinds of failure is
not a flip. A seat flips if both trials hold the object in different seats (object_in_hand.h).
Changes of grip force, sigma, times and breaking force are relative to the session's value, in
trials held in the same seat. A held trial is flagged if it is reseated or caged in the session. In
other held trials grip, sigma and breaking force should change by at most kLargeChange, even if the
seat flips. */

#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/trial/measures/object_in_hand.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Lists the variants: a quarter, half and double of the step; half and double contact stiffness
(normal and tangential); friction 0.1 % lower and higher, as a reference for flips by an
unmeasurably small change; and Simbody's compliant contact ("compliant"), which needs a geometry for
hand and object and no arm. Variants out of the session's ranges are left out. */
std::vector<Condition> ListNumericsVariants(const SessionConfig& config);

inline constexpr double kLargeChange = 0.1;

/** One variant of one trial and the trial's stored result. */
struct NumericsComparison {
  std::string variant;
  TrialRecord before;
  TrialRecord after;

  bool is_flipped() const;
  bool is_held() const;  ///< both succeed
  bool is_seat_flipped() const;
  bool is_flagged() const;
  /** Whether grip, sigma or breaking force changes by more than kLargeChange. */
  bool has_large_change() const;
};

struct NumericsMeasure {
  const char* name;   ///< column, with its unit
  const char* title;  ///< for display
  double (*value)(const TrialRecord&);
};
/** GCT, GFT, GOT, sigma, grip, breaking force. */
const std::vector<NumericsMeasure>& ListNumericsMeasures();

struct ChangeSummary {
  double median = 0.0;  ///< of the absolute relative changes; NaN if num is 0
  double max = 0.0;
  int num = 0;  ///< number of comparable trials
};

struct SeatNumerics {
  std::string variant;
  Seat seat = Seat::kUnknown;
  int num_held = 0;
  std::vector<ChangeSummary> changes;  ///< in the order of ListNumericsMeasures()
};

struct NumericsSummary {
  std::string variant;
  int num_trials = 0;
  int num_left_out = 0;  ///< trials that other variants have, but not this one
  int num_successes_before = 0;
  int num_successes = 0;
  int num_flips = 0;
  int num_numerical_failures = 0;
  int num_held = 0;        ///< in both trials
  int num_seat_flips = 0;  ///< of them
  int num_flagged = 0;     ///< of them
  int num_large = 0;       ///< held trials with a large change that are not flagged
  std::vector<SeatNumerics> seats;
};
/** In the order in which variants occur. */
std::vector<NumericsSummary> SummariseNumerics(const std::vector<NumericsComparison>& comparisons);

/** Lists the finished trials of an experiment by variant, each with the base's trial. Trials whose
base trial is not finished are left out. */
std::vector<NumericsComparison> ListNumericsComparisons(const Session& experiment);
/** Loads the comparisons of all experiments in the session's folder numerics/. @throws as
LoadSession. */
std::vector<NumericsComparison> LoadNumericsComparisons(const Session& session);

/** Make the displayed tables: the variants, the relative changes of held trials by seat, the
flips. */
ShownTable ShowVariants(const std::vector<NumericsSummary>& summaries);
ShownTable ShowSeatChanges(const std::vector<NumericsSummary>& summaries);
ShownTable ShowFlips(const std::vector<NumericsComparison>& comparisons);

/** Writes one row per comparison; missing values are empty. */
std::string FormatNumericsCsv(const std::vector<NumericsComparison>& comparisons);
/** Returns the data dictionary of this table. */
Json MakeNumericsSchema();

/** Writes {variants: [..], flips: [..]}. */
Json MakeNumericsJson(const std::vector<NumericsSummary>& summaries,
                      const std::vector<NumericsComparison>& comparisons);

}  // namespace graspbench
