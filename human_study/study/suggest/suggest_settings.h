#pragma once
/** @file
Suggests settings based on a study's data. The study is run repeatedly, each time with one more
change that a removal reason suggests. A change is accepted when more trials are included, or when
fewer are removed for this reason and no fewer are included. Corrections (a rule, a companion, an
axis, a unit) come first. Then come tolerances (limits of doubt), which reduce reliability and say
so. Finally, every change that is not needed for the number of included trials is dropped. */

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
  std::string reason;                 ///< the evidence in the data, with numbers
  std::string cost;                   ///< the drawback, or what to check first
  int num_kept = 0;                   ///< included trials with this and all earlier suggestions
};

struct StudySuggestions {
  int num_rows = 0, num_all_rows = 0;  ///< rows of trials.csv that were used, and all rows
  int num_trials = 0, num_kept = 0;    ///< with the present settings
  std::vector<Suggestion> suggestions;
  int num_trials_then = 0, num_kept_then = 0;  ///< with all suggestions
  std::vector<RemovalGroup> others;            ///< removals that no setting avoids
};

/** @throws as RunStudy. */
StudySuggestions SuggestSettings(const Study& study);

// Evidence for settings from the markers: which marker moves with a tip, whether the object yields,
// and at which distances a long recording splits into reaches.

/** A marker fixed to a digit that is visible while the tip's marker is hidden. */
struct CompanionEvidence {
  int digit = 0;  ///< 0: thumb .. 4: little
  std::string tip, companion;
  size_t num_hidden = 0;   ///< samples in which the tip is hidden
  size_t num_bridged = 0;  ///< of these, samples with a visible companion
  double distance = 0.0;   ///< median distance between the two [m]
  double spread = 0.0;     ///< half the central 90 % range of the distance [m]
};
/** Finds companions for all digits without one whose tip is hidden in some samples. Candidates are
markers not used as tips or object, visible in at least half of these samples, nearer than 80 mm and
with a spread of the distance below 8 mm. The one with the smallest spread is chosen. */
std::vector<CompanionEvidence> FindCompanions(const Recording& recording,
                                              const MarkerConfig& markers);

/** Returns the largest variation of the distance between two object markers: the central 90 % range
over time, maximum over pairs, without the share of white noise [m]; 0 with fewer than two
markers. */
double FindYield(const PreparedRecording& recording);

/** Returns distances for cutting the recording into reaches. They lie at a quarter and a half of
the range from the usual distance at the object (the 10 % quantile) to the usual distance away from
it (90 %). Nothing when this yields fewer than three reaches. */
std::optional<CutConfig> FindCut(const PreparedRecording& recording);

}  // namespace graspbench
