#pragma once
/** @file
Prepares a recording for analysis: selects the study's markers, cleans and resamples them to one
even clock, and cuts the recording into reaches. */

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

/** A role in the study's marker map for which a recording has no marker. */
struct MissingMarker {
  int digit = -1;    ///< 0..4; -1: wrist or object
  std::string text;  ///< labels expected, and labels in the recording
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
  size_t num_frozen = 0;       ///< samples made invalid because they repeat the previous one
  size_t num_spikes = 0;       ///< samples made invalid as spikes (InvalidateSpikes)
  std::vector<FrameLoss> frame_losses;      ///< hidden by an even clock
  std::vector<ExchangedMarkers> exchanges;  ///< in the order of time (exchanged_labels.h)
  double low_pass = NAN;  ///< cut-off of a filter before the export [Hz]; NaN: none seen
  std::vector<MissingMarker> missing;
};

/** Positions of the trials in a study's plain tables; each table is searched once. */
class StudyTables {
 public:
  /** Finds the rows for a row of trials.csv; nothing if it names no trial of a table, or one that
  does not exist. */
  std::optional<TableRows> Find(const Study& study, const PlannedReach& planned);

 private:
  std::map<std::string, std::unordered_map<std::string, TableRows>> tables_;  // by file
};

/** Loads the recording of a row of trials.csv with the settings of study.yaml. @throws as
LoadRecording. */
Recording LoadPlanned(const Study& study, const PlannedReach& planned, StudyTables& tables);

/** Renames markers, removes frozen samples and spikes, resamples an uneven clock at its median
rate, and fills short gaps.
@throws Error(kFormat) when a marker has no length unit, the recording has no clock or a rate below
10 Hz, or two digits have equal positions throughout. */
PreparedRecording PrepareRecording(const Recording& recording, const StudyConfig& config);

/** Part of a recording, both ends included [s]. */
struct Reach {
  double begin = 0.0;
  double end = 0.0;
};

/** Computes, for each sample, the distance between the centroids of the fingertips and of the
object's markers [m]; NaN where either is not visible. */
std::vector<double> CalcHandDistances(const PreparedRecording& recording);

/** Finds the reaches of a long recording. The hand is at the object from the sample where it is
nearer than `near` until it is farther than `far`; a reach extends from the farthest point before
that to the farthest point after it, where the next reach begins. Samples without the object or any
fingertip are skipped. */
std::vector<Reach> FindReaches(const PreparedRecording& recording, const CutConfig& cut);

/** Makes the input of the analysis. @param object  null: shape unknown.
@throws Error(kFormat, kRange) when the part cannot be analysed, with a message for the user. */
ReachTrial MakeReachTrial(const PreparedRecording& recording, const Reach& part,
                          const StudyConfig& config, const StudyObject* object);

}  // namespace graspbench
