#pragma once
/** @file
Synthetic studies with exactly known events, as ground truth for detectors and as examples for the
workbench.

In the object's frame, each coordinate of a digit's marker is a fifth-degree polynomial of time. The
marker is at rest at the onset and arrives at its contact point with speed v_c along the surface
normal (Smeets and Brenner 1999: perpendicular approach, the opening is a by-product of the digits'
paths). There it stops on a rigid object, or yields by `pad_compression`. After contact it moves
with the object, which is lifted along a minimum-jerk path about 200 ms after the last contact
(Johansson and Westling 1984). The wrist moves on a minimum-jerk path. Individual differences
(speed, opening, pattern of contacts) are drawn per person and per trial.

An object that is not lifted is held 200 ms longer. Then all digits release together, and hand and
digits return along the same paths, mirrored in time. Without a rest before it, the reach begins
where the hand returns from the previous one: along the same path, mirrored at the onset.

Not modelled: curved or corrected paths, tremor, slip, coloured noise, skin motion. A detector that
performs well here may perform worse on people; one that performs badly here is bad. */

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "human_study/events/reach_trial.h"
#include "human_study/recording/recording.h"

namespace graspbench {

struct SyntheticOptions {
  std::string seed = "1";
  int num_people = 3;
  int trials_per_size = 4;
  std::vector<double> diameters = {0.03, 0.045, 0.06, 0.075};  ///< of standing cylinders [m]
  int num_digits = 5;                                          ///< 2 to 5
  double rate = 200.0;                                         ///< [Hz]
  double noise = 0.0003;             ///< SD of every coordinate of every marker [m]
  double dropouts_per_second = 0.0;  ///< mean rate for every fingertip marker
  double dropout_duration = 0.05;    ///< mean [s]
  /** True GFT of every trial [s]; NaN: drawn, about 30 ms. */
  double forming_time = std::numeric_limits<double>::quiet_NaN();
  double min_contact_speed = 0.06;  ///< v_c is uniform between these [m/s]
  double max_contact_speed = 0.15;
  double pad_compression = 0.0;  ///< pad or object yields by this much after contact [m]
  double push = 0.001;           ///< the first digit pushes the object by this much [m]
  bool lifts = true;             ///< else the object is held and released, and the hand returns
  bool rests = true;             ///< before the reach; else the hand returns from the previous one
  bool has_force = false;        ///< one force channel per digit at five times the frame rate
};

/** The true events, on the recording's clock [s]. */
struct SyntheticTruth {
  double onset = 0.0;
  double movement_end = 0.0;   ///< the wrist stops
  double peak_opening = 0.0;   ///< between thumb and virtual finger
  double peak_aperture = 0.0;  ///< largest thumb-index distance of the markers [m]
  double peak_aperture_time = 0.0;
  std::vector<double> contacts;  ///< one per digit, thumb first
  double lift_off = 0.0;         ///< NaN: not lifted
  double release = 0.0;          ///< the digits release; NaN: lifted
};

struct SyntheticTrial {
  std::string person;     ///< "01"
  int trial = 0;          ///< number within the person, from 1
  double diameter = 0.0;  ///< [m]
  Recording recording;
  SyntheticTruth truth;
};

/** Ids of the digits and labels of the recordings' points. */
inline const std::vector<std::string>& SyntheticDigits() {
  static const std::vector<std::string> digits = {"TH", "FF", "MF", "RF", "LF"};
  return digits;
}
inline const std::vector<std::string>& SyntheticTipLabels() {
  static const std::vector<std::string> labels = {"thumb_tip", "index_tip", "middle_tip",
                                                  "ring_tip", "little_tip"};
  return labels;
}
inline constexpr const char* kSyntheticWristLabel = "wrist";
/** Object markers are "object_1" .. "object_3", force channels "force_TH" .. */
inline constexpr double kSyntheticObjectHeight = 0.11;  ///< [m]
inline constexpr double kSyntheticPadOffset = 0.008;    ///< marker to surface in contact [m]
/** Positions of the object's markers in O. */
std::vector<Eigen::Vector3d> SyntheticMarkerPlaces(double diameter);

/** Makes the trials, with sizes in random order within a person. Equal options give equal bits.
@throws Error(kRange) naming the option. */
std::vector<SyntheticTrial> MakeSyntheticStudy(const SyntheticOptions& options);

/** Makes the input of the analysis, with the object's shape and without pad offsets. Gaps are not
filled. */
ReachTrial MakeReachTrial(const SyntheticTrial& trial);

enum class SyntheticFormat { kC3d, kQualisysTsv };

/** "sub-01_trial-003.c3d". */
std::string SyntheticFileName(const SyntheticTrial& trial, SyntheticFormat format);

/** Writes every recording under its SyntheticFileName and truth.csv (one row per trial) into
`folder`.
@throws Error(kIo). */
void SaveSyntheticStudy(const std::vector<SyntheticTrial>& trials, SyntheticFormat format,
                        const std::filesystem::path& folder);

/** The table of truth.csv: file, person, trial, diameter_m, onset_s, .. contact_TH_s, .. */
std::string FormatTruthCsv(const std::vector<SyntheticTrial>& trials, SyntheticFormat format);
/** Makes the data dictionary of truth.csv. */
Json MakeTruthSchema();

}  // namespace graspbench
