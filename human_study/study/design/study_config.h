#pragma once
/** @file
study.yaml: the recordings, the roles of the markers, and all settings of the analysis.

    name: Five fingers on cylinders
    trials: trials.csv          # beside this file; one row per trial, see below
    objects: objects.csv        # optional
    hypotheses: hypotheses.csv  # optional
    reviews: reviews.csv        # optional: contacts reviewed by a person (trial_review.h)
    factors: [diameter_m]       # columns of trials.csv, varied within each person
    groups: [group]             # optional: columns that describe a person, as patient or control
    session: day                # optional: the column with the session of a trial
    markers:
      thumb: [thumb_tip, RTTI]  # the first of these labels found in a recording
      index: [index_tip, RIFT]
      object: [object_1, object_2, object_3]  # all of these labels found
      companions: {thumb: thumb_middle}  # optional: second markers, to fill longer gaps
    robot: ../results/pilot     # optional: a session of `graspbench run` to compare with

trials.csv needs the columns participant and file (relative to the folder of the recordings).
Optional are trial (label; else numbered within the person), object (of objects.csv), table_trial
(of a plain table), start_s, end_s, remove (the experimenter's reason to exclude the trial), hand,
and one column per factor. The text of `hand` replaces {hand} in the labels of markers
("{hand}_thumb"), so that both hands can be in one study; it may also be a factor.

hypotheses.csv, written before the data were seen: measure (an id of measures.csv), slope (null
value of the persons' slopes over a factor with numbers; else 0), equal_within (equivalence bound of
conditions; else equivalence is not tested). Values are in the measure's SI unit.

objects.csv: object, shape (sphere, cylinder, box or catalogue), length_m, width_m, height_m (a
sphere's and a cylinder's diameter is length_m), centre_x_m .. centre_z_m: from the centroid of the
object's markers at rest to the centre of the solid, along the laboratory's axes (else zero).

contact.detector is "auto" by default: "surface" when the object is recorded and every trial names
an object of known shape, else "breakpoint". LoadStudy decides which.

All other settings have defaults; an analysis uses `Study::config`. Lengths in metres, times in
seconds, frequencies in hertz. */

#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/file_keys.h"
#include "human_study/events/reach_trial.h"
#include "human_study/events/trial_analysis.h"
#include "human_study/statistics/measure_table.h"
#include "human_study/study/design/study_freeze.h"
#include "human_study/study/design/trial_review.h"

namespace graspbench {

/** One value for each digit, thumb first, then from radial to ulnar. */
template <class T>
struct PerDigit {
  T thumb{}, index{}, middle{}, ring{}, little{};

  static constexpr int kNumDigits = 5;
  const T& operator[](int digit) const {
    const T* values[] = {&thumb, &index, &middle, &ring, &little};
    return *values[digit];
  }
  template <class V>
  void Visit(V&& v) {
    v("thumb", thumb);
    v("index", index, "the same of the index");
    v("middle", middle, "the same of the middle finger");
    v("ring", ring, "the same of the ring finger");
    v("little", little, "the same of the little finger");
  }
};

/** "TH", "FF", "MF", "RF", "LF", as for the robot hands. */
const char* IdOfDigit(int digit);
/** "thumb", "index" and so on. */
const char* NameOfDigit(int digit);
/** The name for an id; the id itself for any other text. */
std::string NameOfDigit(const std::string& id);

struct MarkerConfig {
  PerDigit<std::vector<std::string>> tips;  ///< labels by preference; empty: not recorded
  std::vector<std::string> wrist;           ///< likewise; empty: centroid of the tips
  std::vector<std::string> object;  ///< all found in the recording are used; empty: not recorded
  /** Second markers on the digits, with whose help gaps of the tips are filled. */
  PerDigit<std::string> companions;
  /** Landmarks of the digits' joints, from the palm to the last. No event depends on them; they
  describe the posture of a digit on the object (workbench/transfer). */
  PerDigit<std::vector<std::string>> joints;

  template <class V>
  void Visit(V&& v) {
    v("thumb", tips.thumb,
      {"labels of the marker on the thumb's tip: the first that a recording has", kRequired});
    v("index", tips.index,
      {"the same of the index; at least one digit beside the thumb", "not recorded"});
    v("middle", tips.middle, {"the same of the middle finger", "not recorded"});
    v("ring", tips.ring, {"the same of the ring finger", "not recorded"});
    v("little", tips.little, {"the same of the little finger", "not recorded"});
    v("wrist", wrist, {"labels of the wrist's marker, likewise", "middle of the tips"});
    v("object", object,
      {"labels of the object's markers: all that a recording has", "not recorded"});
    v("companions", companions,
      {"second marker on the thumb: longer gaps of its tip are filled along it", "none"});
    v("joints", joints,
      {"landmarks of the thumb's joints, from the palm to the last before the tip; for grasps on "
       "robot hands (graspbench transfer)",
       "none"});
  }
};

struct RecordingConfig {
  std::string format;   ///< importer's id; empty: chosen by content and name
  std::string unit;     ///< for files that do not state one
  std::string mapping;  ///< column names of plain tables, beside study.yaml
  bool accept_truncated = false;

  template <class V>
  void Visit(V&& v) {
    v("format", format, {"importer that reads the recordings", "by content and name"});
    v("unit", unit, {"of length, for files that state none", "as the file states"});
    v("mapping", mapping, {"columns of plain tables: a file beside study.yaml", "none"});
    v("accept_truncated", accept_truncated, "go on with recordings that are cut off");
  }
};

/** Cuts a long recording into trials (prepare_recording.h). Distances are between the centroids of
the object's markers and of the fingertips. */
struct CutConfig {
  double near = 0.0;  ///< [m]; 0: a row of trials.csv is one trial
  double far = 0.0;   ///< [m]

  template <class V>
  void Visit(V&& v) {
    v("near_m", near,
      {"fingertips this near to the object begin a trial of a long recording; 0: a row of the "
       "trials is one trial; else at least 0.001",
       0, 10});
    v("far_m", far, {"fingertips this far end it; larger than cut.near_m", 0});
  }
};

struct CleaningConfig {
  bool drop_frozen = true;  ///< repeated positions are invalid: the tracker held the last one
  double max_gap = 0.1;     ///< longer gaps are not filled [s]
  double max_companion_gap = 0.3;  ///< the same for tips with a companion [s]
  double rest_share = 0.1;         ///< initial share of the trial in which the object rests

  template <class V>
  void Visit(V&& v) {
    v("drop_frozen", drop_frozen, "repeated positions are invalid: the tracker held the last one");
    v("max_gap_s", max_gap, {"longer gaps stay open", 0, 5});
    v("max_companion_gap_s", max_companion_gap, {"the same of tips with a companion", 0, 5});
    v("rest_share", rest_share,
      {"of the trial, at its start, in which the object rests", 0.01, 0.9});
  }
};

/** Rules for removing trials. Always removed are trials without recording, marker, movement, widest
opening, or contacts of the thumb and another digit. */
struct RemovalConfig {
  bool missing_digit = false;     ///< a recorded digit never touched
  bool filled_event = false;      ///< an event depends on filled samples
  bool gap_event = false;         ///< an event fell into a gap
  double max_disagreement = 0.0;  ///< between detectors, for any digit [s]; 0: no limit
  bool implausible = true;        ///< the trial is implausible (plausibility.h)
  bool regrasp = true;            ///< a digit touched, left and touched again

  template <class V>
  void Visit(V&& v) {
    v("missing_digit", missing_digit, "remove trials in which a recorded digit never touched");
    v("filled_event", filled_event, "remove trials with an event decided on filled samples");
    v("gap_event", gap_event, "remove trials with an event in a gap");
    v("max_disagreement_s", max_disagreement,
      {"remove trials whose detectors disagree by more; 0: none", 0, 10});
    v("implausible", implausible, "remove trials that are doubted");
    v("regrasp", regrasp,
      "remove trials in which a digit touches, leaves and touches again, so that first and lasting "
      "touch differ");
  }
};

/** Settings for repeating the main test under all combinations of these choices and the study's
own. */
struct MultiverseConfig {
  std::string measure = "grasp_forming_ratio";
  std::vector<std::string> onset = {"threshold", "peak_fraction"};
  std::vector<double> cutoff = {10.0, 20.0};  ///< of the contact detectors [Hz]
  std::vector<std::string> detector;          ///< empty: all detectors
  std::vector<std::string> opening = {"aperture", "virtual_finger"};
  bool is_left_out = false;  ///< only the study's own choices; not a setting

  template <class V>
  void Visit(V&& v) {
    v("measure", measure, "the main test's measure");
    v("onset", onset, "rules of the movement's onset");
    v("cutoff_hz", cutoff,
      {"cut-off of the contact detectors; unless stated, at most 0.34 of the recording's rate", 0.5,
       1000});
    v("detector", detector, {"contact detectors", "all there are"});
    v("opening", opening, "measures of the hand's opening");
  }
};

/** contact.detector: chosen from the data on the objects. */
inline constexpr const char* kAutomaticDetector = "auto";
/** Placeholder in labels of markers. */
inline constexpr const char* kHandInLabels = "{hand}";

struct StudyConfig {
  std::string name = "Reach to grasp";
  std::string task = "reachtograsp";  ///< BIDS label: letters and digits
  std::string trials = "trials.csv";
  std::string objects;
  std::string hypotheses;
  std::string reviews;
  std::string robot;
  std::vector<std::string> factors;
  std::vector<std::string> groups;    ///< columns that are the same in all trials of a person
  std::string session;                ///< column; empty: none
  std::vector<std::string> measures;  ///< ids tested and drawn; empty: the default ones
  MarkerConfig markers;
  PerDigit<std::string> forces;                              ///< labels of analog channels
  PerDigit<double> pad_offsets = {NAN, NAN, NAN, NAN, NAN};  ///< marker to skin [m]
  RecordingConfig recording;
  CutConfig cut;
  CleaningConfig cleaning;
  AnalysisOptions analysis;
  RemovalConfig removal;
  MultiverseConfig multiverse;
  int bias_trials = 40;  ///< per row of the bias card, a multiple of 20; 0: no bias card

  template <class V>
  void Visit(V&& v) {
    v("name", name, "title of the report");
    v("task", task, "label of the Motion-BIDS derivative: letters and digits");
    v("trials", trials,
      "table with one row per trial, beside study.yaml: participant, file; if needed trial, "
      "object, table_trial (of a plain table with several), start_s, end_s, hand, remove (why it "
      "is left out) and the factors");
    v("objects", objects,
      {"table of the objects: object, shape (sphere, cylinder, box, catalogue), length_m, width_m, "
       "height_m; centre_x_m, centre_y_m, centre_z_m from the middle of its markers at rest to its "
       "centre",
       "none"});
    v("hypotheses", hypotheses, {"table of what the measures are tested against", "none"});
    v("reviews", reviews, {"table of contacts that a person confirmed or corrected", "none"});
    v("robot", robot, {"a session of graspbench run to stand beside the people", "none"});
    v("factors", factors, {"columns of the trials that vary within each person", "none"});
    v("groups", groups,
      {"columns of the trials that are the same in all trials of a person", "none"});
    v("session", session, {"column of the trials that says which session each belongs to", "none"});
    v("measures", measures, {"ids of the measures that are tested and drawn", "the usual ones"});
    v("markers", markers);
    v("forces", forces, {"analog channel of the force under the thumb", "none"});
    v("pad_offsets_m", pad_offsets,
      {"from the marker to the skin, thumb", "learned from the holds", 0, 0.05});
    v("recording", recording);
    v("cut", cut);
    v("cleaning", cleaning);
    analysis.Visit(v);
    v("removal", removal);
    v("multiverse", multiverse);
    v("bias_trials", bias_trials, {"of each row of the bias card; 0: none", 0, 10000});
  }
};

/** The keys of study.yaml. */
const FileKeys& ListStudyKeys();

/** A column of a table that the user writes beside study.yaml. */
struct InputColumn {
  const char* name;
  const char* type;  ///< "string", "number"
  const char* unit;  ///< "" without
  const char* meaning;
};

/** Of trials.csv; a column per factor, group and session comes beside them. */
const std::vector<InputColumn>& ListTrialInputColumns();
/** Of objects.csv. */
const std::vector<InputColumn>& ListObjectInputColumns();
/** Of hypotheses.csv. */
const std::vector<InputColumn>& ListHypothesisInputColumns();

struct StudyObject {
  std::string id;
  std::string shape;                                 ///< as in objects.csv; empty: unknown
  Eigen::Vector3d size = Eigen::Vector3d::Zero();    ///< not for catalogue objects [m]
  SurfaceDistance distance;                          ///< in O
  Eigen::Vector3d p_MO_L = Eigen::Vector3d::Zero();  ///< from the markers' centroid to O at rest
};

/** Names of a trial and of its person, file, object and conditions. */
struct TrialNames {
  std::string participant, trial, file;
  std::string object;               ///< empty: not stated
  std::vector<std::string> levels;  ///< one per factor
  std::vector<std::string> groups;  ///< one per group factor
  std::string session;              ///< empty: none named
};

/** A row of trials.csv. */
struct PlannedReach : TrialNames {
  int line = 0;
  std::string table_trial;
  std::string hand;                                         ///< empty: none named
  double start = -std::numeric_limits<double>::infinity();  ///< [s], as end
  double end = std::numeric_limits<double>::infinity();
  std::string remove;  ///< the experimenter's reason to exclude it; empty: included
};

struct Study {
  StudyConfig config;
  StudyConfig stated;                 ///< before LoadStudy chose the detector
  std::optional<FreezeCheck> freeze;  ///< comparison of frozen and used choices
  std::string file;                   ///< study.yaml, as given
  std::filesystem::path folder;       ///< of study.yaml
  std::filesystem::path recordings;   ///< base folder of the trials' `file`
  std::vector<Factor> factors;
  std::vector<Factor> groups;         ///< factors between persons
  std::vector<std::string> sessions;  ///< in numerical order, else in order of appearance
  std::vector<StudyObject> objects;
  std::vector<Hypothesis> hypotheses;
  std::vector<ContactReview> reviews;
  std::vector<PlannedReach> trials;
  PerDigit<int> marker_lines;  ///< lines of markers.thumb, .. in study.yaml, for messages
  Diagnostics warnings;

  /** Returns null when there is no object of this id. */
  const StudyObject* FindObject(const std::string& id) const;
  /** Returns defaults when the measure has no hypothesis. */
  Hypothesis FindHypothesis(const std::string& measure) const;
};

/** Reads study.yaml and the tables beside it, without opening the recordings.
@param recordings  folder of the recordings; empty: that of study.yaml.
@param settings  such as "contact.cutoff_hz=12"; they override study.yaml.
@throws Error(kNotFound, kIo) for study.yaml itself; Error(kFormat) with every problem of all files,
each with file and line. */
Study LoadStudy(const std::filesystem::path& path, const std::filesystem::path& recordings = {},
                const std::vector<std::string>& settings = {});

/** Returns the markers of a hand: its name replaces {hand} in all labels. */
MarkerConfig MarkersOfHand(const MarkerConfig& markers, const std::string& hand);

/** Parses only the settings, from text in memory; `file` is its name in messages. Problems,
including values out of range and unknown names, are added to `problems`. */
StudyConfig ParseStudyConfig(const std::string& text, const std::string& file,
                             Diagnostics& problems, const std::vector<std::string>& settings = {});

// Adapts the cut-offs of a study to the sampling rates of its recordings. A filter needs a cut-off
// below 0.4 of the rate (butterworth.h). For a slow recording, default cut-offs are lowered to
// kMaxCutoffShare of its rate; from 58.9 Hz on, all stay at their defaults. A cut-off stated in
// study.yaml or by --set is used unchanged, or the recording is refused.
inline constexpr const char* kMultiverseCutoff = "multiverse.cutoff_hz";

/** Returns the settings for recordings with `rate` [Hz]; NaN: unchanged. */
StudyConfig FitCutoffs(StudyConfig config, double rate);

/** Describes the stated cut-offs that are too high for `rate` [Hz], with all keys; empty: none. */
std::string FindCutoffFault(const StudyConfig& config, double rate);

/** Lists lowered values for the stated cut-offs that are too high for the rate, in the form of
--set: "contact.cutoff_hz=10.2". */
std::vector<std::string> LowerStatedCutoffs(const StudyConfig& config, double rate);

}  // namespace graspbench
