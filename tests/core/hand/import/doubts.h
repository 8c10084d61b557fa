#pragma once
/** @file
What must not be said of a hand that is described right. */

#include <string>

#include "core/base/error.h"

namespace graspbench {

/** The messages that doubt places, sizes, axes, limits or masses; empty: none. */
inline std::string FindDoubts(const Diagnostics& problems) {
  std::string doubts;
  for (const Diagnostic& problem : problems.entries()) {
    for (const char* doubt :
         {"would fit",        "mirror image",   "times as much",    "taken to be in",
          "fixed: give",      "without torque", "close away",       "closes away",
          "run the same way", "half a turn",    "is a limit wrong", "kg/m^3 of",
          "longest digit",    "--palm-normal",  "cannot oppose",    "deep in",
          "lies within",      "in the air",     "its picture, ",    "beside its picture",
          "the other way",    "deg from those", "the like links",   "wrong joint",
          "opposite sign",    "gear wrong",     "second servo",     "crawl",
          "turn; this rpy"}) {
      if (problem.text.find(doubt) == std::string::npos) continue;
      doubts += problem.text + "\n";
      break;
    }
  }
  return doubts;
}

}  // namespace graspbench
