#pragma once
/** @file
Settings that a study's data ask for. A study is run repeatedly, each time with one more change
that one of its reasons for removing trials points to; a change stands when with it more trials
count, or fewer are removed for that reason and no fewer count. First those that mend (a rule, a
companion, an axis, a unit), then those that tolerate (limits of doubt), which cost trust and say
so. At the end every change without which as many trials count is taken out again. */

#include <string>
#include <vector>

#include "human_study/study/run/trial_removal.h"

namespace graspbench {

struct Suggestion {
  std::vector<std::string> settings;  ///< "movement.rule=regression", as --set takes them
  std::string reason;                 ///< what in the data asks for it, with numbers
  std::string cost;                   ///< what it costs, or what to look at first
  int num_kept = 0;                   ///< trials that count with this and those before it
};

struct StudySuggestions {
  int num_rows = 0, num_all_rows = 0;  ///< rows of trials.csv that were tried, and all
  int num_trials = 0, num_kept = 0;    ///< as the study stands
  std::vector<Suggestion> suggestions;
  int num_trials_then = 0, num_kept_then = 0;  ///< with all of them
  std::vector<RemovalGroup> others;            ///< what no setting mends
};

/** @throws as RunStudy. */
StudySuggestions SuggestSettings(const Study& study);

}  // namespace graspbench
