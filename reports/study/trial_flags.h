#pragma once
/** @file
What may be doubtful about a trial that counts all the same. */

#include <string>
#include <vector>

#include "human_study/events/trial_analysis.h"

namespace graspbench {

struct TrialFlag {
  const char* name;  ///< "filled", beside a trial
  const char* text;  ///< a sentence for tables
  bool (*is_set)(const TrialAnalysis& analysis);
};

const std::vector<TrialFlag>& TrialFlagList();

/** Names of those set, with commas; empty: none. */
std::string FormatFlags(const TrialAnalysis& analysis);

}  // namespace graspbench
