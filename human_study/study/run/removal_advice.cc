#include "human_study/study/run/removal_advice.h"

#include <algorithm>
#include <iterator>

namespace graspbench {

const RemovalAdvice& FindRemovalAdvice(const std::string& code) {
  using Curve = RemovalCurve;
  static const RemovalAdvice kAdvice[] = {
      {"left_out", Curve::kNone, "remove in trials.csv: a person left it out"},
      {"unreadable", Curve::kNone,
       "the recording itself, start_s and end_s of trials.csv, or recording.format, unit, mapping"},
      {"cutoff_too_high", Curve::kNone,
       "the cut-offs that the reason names: lower, or left out; they then follow the rate"},
      {"missing_marker", Curve::kNone, "markers: a label that this recording has"},
      {"same_recording", Curve::kNone,
       "file in trials.csv: the recording of this trial; or leave the row out"},
      {"no_reach", Curve::kNone,
       "cut.near_m and cut.far_m: distances between the middle of the fingertips and of the "
       "object's markers; recording.unit, if it is in another unit"},
      {"no_onset", Curve::kSpeed,
       "movement.rule: regression, which needs no rest before the movement; or "
       "movement.speed_threshold_m_per_s; or start_s, for a rest before it"},
      {"no_hold", Curve::kOpening,
       "hold.speed_threshold_m_per_s, below which tips hold; or end_s, for a recording that ends "
       "after the grasp"},
      {"no_opening", Curve::kOpening,
       "markers.companions and cleaning.max_gap_s: a digit is hidden during the movement"},
      {"no_contact", Curve::kOpening,
       "the marker of that digit under markers; markers.companions, if it is hidden; "
       "contact.max_pad_offset_m and max_looseness, if it does touch"},
      {"not_usable", Curve::kOpening,
       "markers.companions, if a digit is hidden; contact.max_uncertainty_s, above which a contact "
       "is not usable (0: all are)"},
      {"filled_event", Curve::kOpening, "removal.filled_event: false keeps it"},
      {"gap_event", Curve::kOpening,
       "markers.companions and cleaning.max_gap_s; removal.gap_event: false keeps it"},
      {"disagreement", Curve::kOpening, "removal.max_disagreement_s; 0 keeps it"},
      {"carried_unseen", Curve::kOpening,
       "markers.object, if the object has a marker; end_s before the lift"},
      {"other_lift_axis", Curve::kNone, "lift_off.up_x, up_y, up_z: up in the recording"},
      {"wrong_unit", Curve::kNone,
       "recording.unit, or unit of the mapping; for one digit alone its label under markers"},
      {"label_jump", Curve::kOpening,
       "the recording: markers exchanged their labels; removal.implausible: false keeps it"},
      {"frame_jump", Curve::kSpeed,
       "the recording: export it again with all frames; start_s and end_s of trials.csv, if the "
       "jump is outside the reach; removal.implausible: false keeps it"},
      {"no_movement", Curve::kSpeed, "start_s and end_s of trials.csv; markers"},
      {"far_digit", Curve::kOpening, "the marker of that digit under markers"},
      {"hand_centred", Curve::kNone, "the recording: places in a frame that stands still"},
      {"wrong_shape", Curve::kNone,
       "sizes and centre in objects.csv, pad_offsets_m; plausibility.max_hold_distance_m"},
      {"contact_after_end", Curve::kSpeed,
       "plausibility.max_contact_after_end_s; markers.wrist, if the wrong marker stops early"},
      {"closure_too_long", Curve::kOpening, "plausibility.max_closure_time_s"},
      {"detectors_disagree", Curve::kOpening,
       "contact.detector; plausibility.max_disagreement_s, above which their contacts are doubted"},
      {"moved_before_touch", Curve::kOpening,
       "objects.csv, if the shape is too small; plausibility.max_moved_before_s"},
      {"object_left_behind", Curve::kNone, "markers.object: the marker of what is carried"},
      {"thumb_not_opposed", Curve::kNone, "markers: the labels of thumb and fingers"},
  };
  static const RemovalAdvice kDoubted = {
      "", Curve::kOpening, "removal.implausible: false keeps trials that are doubted"};
  const auto* found =
      std::find_if(std::begin(kAdvice), std::end(kAdvice),
                   [&](const RemovalAdvice& advice) { return advice.code == code; });
  return found == std::end(kAdvice) ? kDoubted : *found;
}

std::string FindAdviceBeyondSettings(const std::string& code) {
  const std::string advice = FindRemovalAdvice(code).keys, separator = "; ";
  std::string kept;
  for (size_t at = 0; at < advice.size();) {
    const size_t end = std::min(advice.find(separator, at), advice.size());
    std::string part = advice.substr(at, end - at);
    if (part.rfind("or ", 0) == 0) part.erase(0, 3);
    const auto is_named = [&](const char* group) { return part.find(group) != std::string::npos; };
    const char* const settings[] = {"movement.", "hold.",         "cleaning.", "contact.",
                                    "removal.",  "plausibility.", "lift_off.", "cut."};
    if (std::none_of(std::begin(settings), std::end(settings), is_named)) {
      kept += (kept.empty() ? "" : separator) + part;
    }
    at = end + separator.size();
  }
  return kept;
}

}  // namespace graspbench
