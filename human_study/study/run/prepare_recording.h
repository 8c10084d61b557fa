#pragma once
/** @file
From a recording to trials: markers under the study's names, cleaned and on one even clock, then cut
into reaches. */

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "human_study/events/reach_trial.h"
#include "human_study/recording/cleaning/exchanged_labels.h"
#include "human_study/recording/cleaning/lost_frames.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/recording.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {

/** A role of the study's marker map that a recording has no marker for. */
struct MissingMarker {
  int digit = -1;    ///< 0..4; -1: wrist or object
  std::string text;  ///< what was looked for, and what the recording has
};

/** From that instant on a marker goes on where another one was, which is elsewhere or hidden. */
struct ExchangedMarkers {
  double time = 0.0;         ///< [s]
  std::string label, other;  ///< names of digits, else the recording's labels
  double distance = 0.0;     ///< of the jump [m]
};

struct PreparedRecording {
  std::vector<double> times;  ///< [s], even; all tracks have these
  std::vector<DigitTrack> digits;
  Trajectory wrist;
  std::vector<Trajectory> object_markers;
  double rate = 0.0;           ///< of the even clock [Hz]
  bool was_resampled = false;  ///< the recording's own clock is uneven
  size_t num_samples = 0;      ///< of all tracks
  size_t num_frozen = 0;       ///< samples made invalid because they repeat the one before
  size_t num_spikes = 0;       ///< .. because no marker gets there and back between two frames
  std::vector<FrameLoss> frame_losses;      ///< that an even clock hides
  std::vector<ExchangedMarkers> exchanges;  ///< in the order of time (exchanged_labels.h)
  double low_pass = NAN;  ///< cut-off of a filter before the export [Hz]; NaN: none seen
  std::vector<MissingMarker> missing;
};

/** Where the trials of a study's plain tables stand, found once a table. */
class StudyTables {
 public:
  /** Of a row of trials.csv; nothing: it names no trial of a table, or none that is there. */
  std::optional<TableRows> Find(const Study& study, const PlannedReach& planned);

 private:
  std::map<std::string, std::unordered_map<std::string, TableRows>> tables_;  // by file
};

/** The recording of a row of trials.csv, read as study.yaml says. @throws as LoadRecording. */
Recording LoadPlanned(const Study& study, const PlannedReach& planned, StudyTables& tables);

/** Renames, removes frozen samples, resamples an uneven clock at its median rate, fills short gaps.
@throws Error(kFormat) when a marker has no length unit, the recording no clock or fewer
than 10 samples a second, or two digits have the same places throughout. */
PreparedRecording PrepareRecording(const Recording& recording, const StudyConfig& config);

/** Part of a recording, both ends included [s]. */
struct Reach {
  double begin = 0.0;
  double end = 0.0;
};

/** From the middle of the fingertips to the middle of the object's markers, one a sample [m]; NaN
where either is not seen. */
std::vector<double> CalcHandDistances(const PreparedRecording& recording);

/** Finds the reaches of a long recording. The hand is at the object from the sample where it is
nearer than `near` until it is farther than `far`; a reach goes from where it was farthest before
that to where it is farthest after it, where the next one begins. Samples without the object or any
fingertip are passed over. */
std::vector<Reach> FindReaches(const PreparedRecording& recording, const CutConfig& cut);

/** @param object  null: shape not known.
@throws Error(kFormat, kRange) when the part cannot be analysed, for a person to read. */
ReachTrial MakeReachTrial(const PreparedRecording& recording, const Reach& part,
                          const StudyConfig& config, const StudyObject* object);

}  // namespace graspbench
