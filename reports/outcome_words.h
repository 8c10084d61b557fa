#pragma once
/** @file How an outcome is called in a page. */

#include <string>

#include "core/trial/outcome.h"

namespace graspbench {

/** The name in records and tables of export/, said in full where it can be misread: the other
digits of a trial of "no contact" may well have touched. */
inline std::string WordsOf(Outcome outcome) {
  return NameOf(outcome) + std::string(outcome == Outcome::kNoContact ? " of a digit" : "");
}

}  // namespace graspbench
