#pragma once
/** @file
How an outcome, or the seat of an object, is called in a page, and how an end is explained. */

#include <string>

#include "core/trial/measures/seat.h"
#include "core/trial/outcome.h"
#include "core/trial/trial_result.h"

namespace graspbench {

/** The name in records and tables of export/, said in full where it can be misread: the other
digits of a trial of "no contact" may well have touched. */
inline std::string WordsOf(Outcome outcome) {
  return NameOf(outcome) + std::string(outcome == Outcome::kNoContact ? " of a digit" : "");
}

/** Why a trial ended as it did, in the words of its record; empty for a success. */
inline std::string ExplainEnd(const TrialResult& result) {
  if (!result.diagnosis) return result.reason;
  return (result.reason.empty() ? "" : result.reason + ". ") + result.diagnosis->text;
}

inline std::string WordsOf(Seat seat) {
  return seat == Seat::kUnknown ? "not recorded" : NameOf(seat);
}

}  // namespace graspbench
