#pragma once
/** @file
What may be doubtful about a trial that counts all the same. */

#include <string>
#include <vector>

#include "human_study/events/trial_analysis.h"

namespace graspbench {

struct StudyResult;
struct StudyTrial;

struct TrialFlag {
  const char* name;  ///< "filled", beside a trial
  const char* text;  ///< a sentence for tables
  bool (*is_set)(const TrialAnalysis& analysis);
};

const std::vector<TrialFlag>& TrialFlagList();

/** Names of those set, with commas; empty: none. */
std::string FormatFlags(const TrialAnalysis& analysis);

struct FlagCount {
  const TrialFlag* flag = nullptr;
  int count = 0;       ///< trials that count in spite of it
  double share = 0.0;  ///< of those that count; NaN without any
};
/** In the order of TrialFlagList(). */
std::vector<FlagCount> CountFlags(const StudyResult& result);

/** The trial to begin with: one that counts, without a flag if there is one, whose GFT is nearest
to the median; null when none counts. */
const StudyTrial* FindGoodTrial(const StudyResult& result);

/** Contacts that only the digit's own stop shows, in trials that count. */
struct UnverifiedTouches {
  int num_contacts = 0, num_trials = 0;
};
UnverifiedTouches CountUnverified(const StudyResult& result);

}  // namespace graspbench
