#pragma once
/** @file
How far a session's results depend on the numerics: its trials under other steps and stiffnesses
(graspbench check-numerics) beside its own, one by one and seat by seat.

A verdict flips when a success becomes a failure or the other way round; one failure that becomes
another is no flip. A seat flips when both trials are held, in different seats (object_in_hand.h).
Changes of grip force, sigma, times and breaking force are relative to the session's value, of
trials that are held in the same seat. A held trial is flagged when it is reseated or caged; of one
that is not, grip, sigma and breaking force should change by no more than kLargeChange, also where
its seat flips. */

#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/trial/measures/object_in_hand.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** A quarter, half and double of the step, half and double contact stiffness (normal and
tangential), friction 0.1 % lower and higher, so that flips of the step stand beside those of a draw
that nobody can know, and Simbody's compliant contact ("compliant") where it has a geometry for hand
and object; what is out of a session's range is left out. */
std::vector<Condition> ListNumericsVariants(const SessionConfig& config);

inline constexpr double kLargeChange = 0.1;

/** One variant of one trial beside its stored result. */
struct NumericsComparison {
  std::string variant;
  TrialRecord before;
  TrialRecord after;

  bool is_flipped() const;
  bool is_held() const;  ///< both are
  bool is_seat_flipped() const;
  bool is_flagged() const;
  /** Of grip, sigma or breaking force. */
  bool has_large_change() const;
};

struct NumericsMeasure {
  const char* name;   ///< column, with its unit
  const char* title;  ///< for people
  double (*value)(const TrialRecord&);
};
/** GCT, GFT, GOT, sigma, grip, breaking force. */
const std::vector<NumericsMeasure>& ListNumericsMeasures();

struct ChangeSummary {
  double median = 0.0;  ///< of the absolute relative changes; NaN: none could be compared
  double max = 0.0;
  int num = 0;  ///< how many could be compared
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
  int num_left_out = 0;  ///< that other variants have and this one has not
  int num_successes_before = 0;
  int num_successes = 0;
  int num_flips = 0;
  int num_numerical_failures = 0;
  int num_held = 0;        ///< before and after
  int num_seat_flips = 0;  ///< of them
  int num_flagged = 0;     ///< of them
  int num_large = 0;       ///< large changes of those that are not flagged
  std::vector<SeatNumerics> seats;
};
/** In the order in which variants occur. */
std::vector<NumericsSummary> SummariseNumerics(const std::vector<NumericsComparison>& comparisons);

/** Finished trials of an experiment under its conditions, variant by variant, each with that of the
base; none where the base's is not finished. */
std::vector<NumericsComparison> ListNumericsComparisons(const Session& experiment);
/** Of all experiments in the session's folder numerics/. @throws as LoadSession. */
std::vector<NumericsComparison> LoadNumericsComparisons(const Session& session);

/** As people see them: the variants, the relative changes of held trials by seat, the flips. */
ShownTable ShowVariants(const std::vector<NumericsSummary>& summaries);
ShownTable ShowSeatChanges(const std::vector<NumericsSummary>& summaries);
ShownTable ShowFlips(const std::vector<NumericsComparison>& comparisons);

/** One row per comparison; missing = empty. */
std::string FormatNumericsCsv(const std::vector<NumericsComparison>& comparisons);
/** Its data dictionary. */
Json MakeNumericsSchema();

/** {variants: [..], flips: [..]}. */
Json MakeNumericsJson(const std::vector<NumericsSummary>& summaries,
                      const std::vector<NumericsComparison>& comparisons);

}  // namespace graspbench
