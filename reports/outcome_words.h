#pragma once
/** @file
How an outcome, or the seat of an object, is called in a page. */

#include <string>

#include "core/trial/measures/seat.h"
#include "core/trial/outcome.h"

namespace graspbench {

/** The name in records and tables of export/, said in full where it can be misread: the other
digits of a trial of "no contact" may well have touched. */
inline std::string WordsOf(Outcome outcome) {
  return NameOf(outcome) + std::string(outcome == Outcome::kNoContact ? " of a digit" : "");
}

inline std::string WordsOf(Seat seat) {
  return seat == Seat::kUnknown ? "not recorded" : NameOf(seat);
}

}  // namespace graspbench
