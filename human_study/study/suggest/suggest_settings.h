#pragma once
/** @file
Settings that a study's data ask for. A study is run repeatedly, each time with one more change
that one of its reasons for removing trials points to; a change stands when with it more trials
count, or fewer are removed for that reason and no fewer count. First those that mend (a rule, a
companion, an axis, a unit), then those that tolerate (limits of doubt), which cost trust and say
so. At the end every change without which as many trials count is taken out again. */

#include <optional>
#include <string>
#include <vector>

#include "human_study/recording/recording.h"
#include "human_study/study/design/study_config.h"
#include "human_study/study/run/prepare_recording.h"
#include "human_study/study/run/trial_removal.h"

namespace graspbench {

struct Suggestion {
  std::vector<std::string> settings;  ///< "movement.rule=regression", as --set takes them
  std::string reason;                 ///< what in the data asks for it, with numbers
  std::string cost;                   ///< what it costs, or what to look at first
  int num_kept = 0;                   ///< included trials with this and those before it
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

// What the markers of recordings say about settings: which marker goes along with a tip, whether the
// object yields, at which distances a long recording falls into reaches.

/** A marker that stays where it is on a digit, and is seen while the tip's is hidden. */
struct CompanionEvidence {
  int digit = 0;  ///< 0: thumb .. 4: little
  std::string tip, companion;
  size_t num_hidden = 0;   ///< samples without the tip
  size_t num_bridged = 0;  ///< .. that show the companion
  double distance = 0.0;   ///< median, of the two [m]
  double spread = 0.0;     ///< of the distance: half of the middle 90 % [m]
};
/** For every digit without a companion whose tip is hidden in some samples: of the markers that the
study does not use as tips or object, the one with the smallest spread of its distance (below 8 mm,
nearer than 80 mm) that is seen in at least half of those samples. */
std::vector<CompanionEvidence> FindCompanions(const Recording& recording,
                                              const MarkerConfig& markers);

/** How far two markers of the object change their distance: the middle 90 %, of the pair that does
it most, without the share of white noise [m]; 0 with fewer than two. */
double FindYield(const PreparedRecording& recording);

/** Distances at which the recording falls into the most regular reaches: a quarter and a half of the
way from where the hand usually is at the object (10 % of the samples are nearer) to where it usually
is away (90 %). Nothing when that makes fewer than three reaches. */
std::optional<CutConfig> FindCut(const PreparedRecording& recording);

}  // namespace graspbench
