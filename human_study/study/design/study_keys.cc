#include "human_study/study/design/study_keys.h"

#include "core/base/config.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {
namespace {

// One line a key.
FileKeys MakeRows() {
  return {
      {"name", "", "title of the report"},
      {"task", "", "label of the Motion-BIDS derivative: letters and digits"},
      {"trials", "",
       "table with one row per trial, beside study.yaml: participant, file; if needed trial, "
       "object, "
       "table_trial (of a plain table with several), start_s, end_s, hand, remove (why it is left "
       "out) and the factors"},
      {"objects", "none",
       "table of the objects: object, shape (sphere, cylinder, box, catalogue), length_m, width_m, "
       "height_m; centre_x_m, centre_y_m, centre_z_m from the middle of its markers at rest to its "
       "centre"},
      {"hypotheses", "none", "table of what the measures are tested against"},
      {"reviews", "none", "table of contacts that a person confirmed or corrected"},
      {"robot", "none", "a session of graspbench run to stand beside the people"},
      {"factors", "none", "columns of the trials that vary within each person"},
      {"groups", "none", "columns of the trials that are the same in all trials of a person"},
      {"session", "none", "column of the trials that says which session each belongs to"},
      {"measures", "the usual ones", "ids of the measures that are tested and drawn"},
      {"markers.thumb", kRequired,
       "labels of the marker on the thumb's tip: the first that a recording has"},
      {"markers.index", "not recorded",
       "the same of the index; at least one digit beside the thumb"},
      {"markers.middle", "not recorded", "the same of the middle finger"},
      {"markers.ring", "not recorded", "the same of the ring finger"},
      {"markers.little", "not recorded", "the same of the little finger"},
      {"markers.wrist", "middle of the tips", "labels of the wrist's marker, likewise"},
      {"markers.object", "not recorded",
       "labels of the object's markers: all that a recording has"},
      {"markers.companions.thumb", "none",
       "second marker on the thumb: longer gaps of its tip are filled along it"},
      {"markers.companions.index", "none", "the same of the index"},
      {"markers.companions.middle", "none", "the same of the middle finger"},
      {"markers.companions.ring", "none", "the same of the ring finger"},
      {"markers.companions.little", "none", "the same of the little finger"},
      {"forces.thumb", "none", "analog channel of the force under the thumb"},
      {"forces.index", "none", "the same of the index"},
      {"forces.middle", "none", "the same of the middle finger"},
      {"forces.ring", "none", "the same of the ring finger"},
      {"forces.little", "none", "the same of the little finger"},
      {"pad_offsets_m.thumb", "learned from the holds", "from the marker to the skin, thumb", 0,
       0.05},
      {"pad_offsets_m.index", "learned from the holds", "the same of the index", 0, 0.05},
      {"pad_offsets_m.middle", "learned from the holds", "the same of the middle finger", 0, 0.05},
      {"pad_offsets_m.ring", "learned from the holds", "the same of the ring finger", 0, 0.05},
      {"pad_offsets_m.little", "learned from the holds", "the same of the little finger", 0, 0.05},
      {"recording.format", "by content and name", "importer that reads the recordings"},
      {"recording.unit", "as the file states", "of length, for files that state none"},
      {"recording.mapping", "none", "columns of plain tables: a file beside study.yaml"},
      {"recording.accept_truncated", "", "go on with recordings that are cut off"},
      {"cut.near_m", "",
       "fingertips this near to the object begin a trial of a long recording; 0: a row of the "
       "trials is one trial; else at least 0.001",
       0, 10},
      {"cut.far_m", "", "fingertips this far end it; larger than cut.near_m", 0},
      {"cleaning.drop_frozen", "", "repeated positions are invalid: the tracker held the last one"},
      {"cleaning.max_gap_s", "", "longer gaps stay open", 0, 5},
      {"cleaning.max_companion_gap_s", "", "the same of tips with a companion", 0, 5},
      {"cleaning.rest_share", "", "of the trial, at its start, in which the object rests", 0.01,
       0.9},
      {"movement.rule", "", "how onset and end are found"},
      {"movement.cutoff_hz", "10; at most 0.34 of the recording's rate",
       "of the zero-phase filter on the wrist", kAboveZero},
      {"movement.speed_threshold_m_per_s", "", "of the rules with a threshold", kAboveZero},
      {"movement.peak_fraction", "", "of the peak speed, of the rules with one", kAboveZero},
      {"lift_off.rule", "", "how the lift-off is found"},
      {"lift_off.cutoff_hz", "10; at most 0.34 of the recording's rate",
       "of the zero-phase filter on the object", kAboveZero},
      {"lift_off.min_rise_m", "", "an object that rises less is not lifted", kAboveZero},
      {"lift_off.rise_m", "", "rule rise: this high", kAboveZero},
      {"lift_off.speed_m_per_s", "", "rule traced_back: slower than this", kAboveZero},
      {"lift_off.displacement_m", "", "an object this far from its place has moved", kAboveZero},
      {"lift_off.up_x", "", "direction of the lift in the laboratory, x"},
      {"lift_off.up_y", "", "the same, y"},
      {"lift_off.up_z", "", "the same, z"},
      {"hold.rule", "", "how the hold is found of what is not lifted"},
      {"hold.cutoff_hz", "10; at most 0.34 of the recording's rate",
       "of the zero-phase filter on the tips", kAboveZero},
      {"hold.speed_threshold_m_per_s", "", "tips that are faster do not hold", kAboveZero},
      {"opening.measure", "", "of the hand"},
      {"opening.maximum", "", "start of the closure: largest or last"},
      {"opening.cutoff_hz", "10; at most 0.34 of the recording's rate",
       "of the zero-phase filter on the tips", kAboveZero},
      {"opening.min_prominence_m", "", "of a last maximum", kAboveZero},
      {"contact.detector", "auto",
       "the detector that is believed; auto: surface where every trial's object has a known shape, "
       "else breakpoint"},
      {"contact.cutoff_hz", "20; at most 0.34 of the recording's rate",
       "of the zero-phase filter on the tips", kAboveZero},
      {"contact.object_cutoff_hz", "15; at most 0.34 of the recording's rate",
       "of the filter on the object's pose", kAboveZero},
      {"contact.speed_threshold_m_per_s", "", "detector speed: slower against the object",
       kAboveZero},
      {"contact.max_pad_offset_m", "", "a marker held farther from the surface does not touch",
       kAboveZero},
      {"contact.max_pad_difference_m", "", "nor one so much farther than the other digits'",
       kAboveZero},
      {"contact.max_looseness", "", "nor one held so many times looser than the others",
       kAboveZero},
      {"contact.max_uncertainty_s", "", "a contact known less well is not usable; 0: all are", 0},
      {"contact.force_noise_factor", "", "detector force: above so many standard deviations",
       kAboveZero},
      {"plausibility.max_contact_after_end_s", "", "a later contact is doubted", 0},
      {"plausibility.max_closure_time_s", "", "a longer closure is doubted", 0},
      {"plausibility.max_hold_distance_m", "",
       "markers farther from the surface make the shape doubted", 0},
      {"plausibility.max_disagreement_s", "", "of the detectors, before their contacts are doubted",
       0},
      {"plausibility.max_moved_before_s", "",
       "an object that moved earlier before its first contact is doubted", 0},
      {"plausibility.min_carried_m", "", "a shorter way is no carrying", 0},
      {"plausibility.lift_axis", "", "look for other directions of the lift"},
      {"removal.missing_digit", "", "remove trials in which a recorded digit never touched"},
      {"removal.filled_event", "", "remove trials with an event decided on filled samples"},
      {"removal.gap_event", "", "remove trials with an event in a gap"},
      {"removal.max_disagreement_s", "", "remove trials whose detectors disagree by more; 0: none",
       0, 10},
      {"removal.implausible", "", "remove trials that are doubted"},
      {"multiverse.measure", "", "the main test's measure"},
      {"multiverse.onset", "", "rules of the movement's onset"},
      {"multiverse.cutoff_hz", "10, 20; at most 0.34 of the recording's rate",
       "of the contact detectors", 0.5, 1000},
      {"multiverse.detector", "all there are", "contact detectors"},
      {"multiverse.opening", "", "measures of the hand's opening"},
      {"bias_trials", "", "of each row of the bias card; 0: none", 0, 10000},
  };
}

}  // namespace

const FileKeys& ListStudyKeys() {
  static const FileKeys keys = DescribeConfig(StudyConfig(), MakeRows());
  return keys;
}

}  // namespace graspbench
