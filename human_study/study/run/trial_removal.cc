#include "human_study/study/run/trial_removal.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "core/base/text/delimited_text.h"
#include "core/base/units.h"
#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

namespace {

/** A number of a sentence, or what stands between two. */
struct Piece {
  std::string text;
  bool is_number = false;
  double value = 0.0;
};

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/** Behind "e-05", if that is there. */
size_t SkipExponent(const std::string& text, size_t at) {
  if (at >= text.size() || text[at] != 'e') return at;
  size_t end = at + 1;
  if (end < text.size() && (text[end] == '-' || text[end] == '+')) ++end;
  if (end >= text.size() || !IsDigit(text[end])) return at;
  while (end < text.size() && IsDigit(text[end])) ++end;
  return end;
}

/** Numbers stand by themselves; digits within a name are an ellipsis. */
std::vector<Piece> SplitNumbers(const std::string& text) {
  std::vector<Piece> pieces = {{}};
  for (size_t at = 0; at < text.size();) {
    if (!IsDigit(text[at])) {
      pieces.back().text += text[at++];
      continue;
    }
    size_t end = at;
    while (end < text.size() && (IsDigit(text[end]) || text[end] == '.')) ++end;
    if (text[end - 1] == '.') --end;  // of the sentence
    end = SkipExponent(text, end);
    const bool is_open = at == 0 || std::string(" (=").find(text[at - 1]) != std::string::npos;
    const bool is_closed =
        end == text.size() || std::string(" ,;:.)%").find(text[end]) != std::string::npos;
    const std::string number = text.substr(at, end - at);
    const std::optional<double> value = ParseFiniteNumber(number);
    if (is_open && is_closed && value) {
      pieces.push_back({number, true, *value});
      pieces.push_back({});
    } else {
      pieces.back().text += "\u2026";
    }
    at = end;
  }
  return pieces;
}

/** The text without its numbers: equal for texts that differ in them alone. */
std::string KindOf(const std::string& text) {
  std::string kind;
  for (const Piece& piece : SplitNumbers(text)) kind += piece.is_number ? "\u2026" : piece.text;
  return kind;
}

}  // namespace

Removal FindRemoval(const TrialAnalysis& analysis, const RemovalConfig& rules) {
  const auto doubt = [&](const std::vector<Doubt>& doubts) -> Removal {
    if (!rules.implausible || doubts.empty()) return {};
    return {doubts.front().code, doubts.front().text};
  };
  // What is wrong with the trial as such explains why events are missing.
  if (Removal removal = doubt(analysis.trial_doubts); !removal.text.empty()) return removal;
  if (!analysis.movement.onset.IsFound()) {
    return {"no_onset", "no onset of the movement: " + analysis.movement.onset.missing};
  }
  if (!analysis.hold.IsFound()) return {"no_hold", "no hold: " + analysis.hold.missing};
  if (!analysis.closure_start.IsFound()) {
    return {"no_opening", "no widest opening: " + analysis.closure_start.missing};
  }
  Removal missing_finger;
  int num_fingers = 0;
  for (const DigitContactEvents& digit : analysis.contacts) {
    const std::string name = NameOfDigit(digit.digit);
    if (digit.contact.IsFound()) {
      if (!digit.is_thumb) ++num_fingers;
      if (rules.max_disagreement > 0.0 && !digit.is_reviewed &&
          digit.disagreement > rules.max_disagreement) {
        return {"disagreement", "detectors disagree on the contact of the " + name};
      }
      continue;
    }
    const bool is_unresolved = IsUnresolved(digit.contact);
    if (is_unresolved && !std::isnan(digit.contact.time)) {  // bounded
      if (!digit.is_thumb) ++num_fingers;
      continue;
    }
    const Removal removal = {is_unresolved ? "not_usable" : "no_contact",
                             "no contact of the " + name + ": " + digit.contact.missing};
    if (digit.is_thumb || rules.missing_digit) return removal;
    missing_finger = removal;
  }
  if (num_fingers == 0) return missing_finger;
  if (rules.regrasp) {
    for (const DigitContactEvents& digit : analysis.contacts) {
      const Regrasp& regrasp = digit.regrasp;
      if (digit.is_reviewed || !digit.contact.IsFound() || !regrasp.IsFound()) continue;
      return {
          "regrasp",
          fmt::format("a digit touched, left by {:.0f} mm and touched again {:.0f} ms after its "
                      "first touch",
                      MmFromM(regrasp.left_by),
                      MsFromS(digit.contact.time - regrasp.first_touch.time))};
    }
  }
  if (rules.filled_event && analysis.used_filled) {
    return {"filled_event", "an event was decided on filled samples"};
  }
  if (rules.gap_event && analysis.used_gap) return {"gap_event", "an event fell into a gap"};
  return doubt(analysis.doubts);
}

std::string MergeNumbers(const std::vector<std::string>& texts) {
  const auto differs = [&](const std::string& text) { return text != texts.front(); };
  if (std::none_of(texts.begin(), texts.end(), differs)) return texts.front();
  const std::vector<Piece> first = SplitNumbers(texts.front());
  std::vector<Piece> low = first, high = first;
  for (const std::string& text : texts) {
    const std::vector<Piece> pieces = SplitNumbers(text);
    for (size_t i = 0; i < first.size(); ++i) {
      if (!first[i].is_number) continue;
      if (pieces[i].value < low[i].value) low[i] = pieces[i];
      if (pieces[i].value > high[i].value) high[i] = pieces[i];
    }
  }
  std::string merged;
  for (size_t i = 0; i < first.size(); ++i) {
    merged += low[i].text;
    if (low[i].text != high[i].text) merged += ".." + high[i].text;
  }
  return merged;
}

std::vector<RemovalGroup> GroupRemoved(const std::vector<StudyTrial>& trials) {
  std::vector<RemovalGroup> groups;
  std::vector<std::vector<std::string>> texts;
  std::map<std::string, size_t> places;  // by kind
  for (const StudyTrial& trial : trials) {
    if (trial.IsKept()) continue;
    const auto [place, is_new] = places.try_emplace(KindOf(trial.removed), groups.size());
    if (is_new) {
      groups.push_back({trial.removed_code, "", {}});
      texts.emplace_back();
    }
    groups[place->second].trials.push_back(trial.id);
    texts[place->second].push_back(trial.removed);
  }
  for (size_t i = 0; i < groups.size(); ++i) groups[i].text = MergeNumbers(texts[i]);
  std::stable_sort(groups.begin(), groups.end(),
                   [](const auto& a, const auto& b) { return a.trials.size() > b.trials.size(); });
  return groups;
}

std::vector<FindingGroup> GroupFindings(const StudyResult& result) {
  std::vector<FindingGroup> groups;
  std::vector<std::vector<std::string>> texts;
  std::map<std::pair<std::string, std::string>, size_t> places;  // by code and kind
  for (const FileFinding& entry : result.findings) {
    const ImportFinding& finding = entry.finding;
    const auto key = std::pair(finding.code, KindOf(finding.text));
    const auto [place, is_new] = places.try_emplace(key, groups.size());
    if (is_new) {
      groups.push_back({finding.code, "", 0, {}});
      texts.emplace_back();
    }
    FindingGroup& group = groups[place->second];
    texts[place->second].push_back(finding.text);
    ++group.count;
    if (group.files.empty() || group.files.back() != entry.file) group.files.push_back(entry.file);
  }
  for (size_t i = 0; i < groups.size(); ++i) groups[i].text = MergeNumbers(texts[i]);
  return groups;
}

const std::vector<TrialFlag>& TrialFlagList() {
  constexpr double kClosesOn = 8e-3;  // [m]
  using A = TrialAnalysis;
  static const std::vector<TrialFlag> flags = {
      {"filled", "an event was decided on filled samples",
       [](const A& a) { return a.used_filled; }},
      {"gap", "an event fell into a gap; its time is the gap's middle",
       [](const A& a) { return a.used_gap; }},
      {"early touch", "a digit touched before the widest opening",
       [](const A& a) { return a.timing.contact_before_start; }},
      {"two maxima", "the largest and the last maximum of the opening differ",
       [](const A& a) { return a.peak_opening.is_ambiguous; }},
      {"digit without touch", "a recorded digit never touched",
       [](const A& a) {
         return a.num_touching + a.num_unresolved < static_cast<int>(a.contacts.size());
       }},
      {"regrasp",
       "a digit touched, left its place and returned: GFT, GOT and GCT are those of its lasting "
       "touch",
       [](const A& a) {
         return std::any_of(a.contacts.begin(), a.contacts.end(),
                            [](const auto& digit) { return digit.regrasp.IsFound(); });
       }},
      {"may hover",
       "a digit stands more than 2 mm farther off the surface in the hold than it does in the "
       "person's other trials: it may not touch",
       [](const A& a) {
         return std::any_of(a.contacts.begin(), a.contacts.end(), [](const auto& digit) {
           return digit.contact.IsFound() && !digit.has_pad_offset && digit.stands_off > 0.002;
         });
       }},
      {"closes on",
       "the hand closes by more than 8 mm after the last contact, farther than skin gives way: the "
       "contact may be too early",
       [](const A& a) { return a.closes_on > kClosesOn; }},
      {"filtered export",
       "the recording was low-passed before it was exported: its instants may be late, its "
       "uncertainties are too small",
       [](const A& a) { return !std::isnan(a.low_pass); }},
      {"thumb or index",
       "the thumb's marker is farther from the wrist than the index's, which opposes the others: "
       "their labels may be exchanged",
       [](const A& a) { return a.may_be_exchanged; }},
      {"up or aside",
       "the object goes another way before it rises along the stated direction (lift_off.up_x ..): "
       "if that is not up in the recording, the lift-off is late",
       [](const A& a) { return a.goes_elsewhere_first; }},
      {"touch not told",
       "a digit touched at an instant that cannot be told: no GFT, GOT, GCT, no final opening",
       [](const A& a) { return a.num_unresolved > 0; }},
  };
  return flags;
}

std::string FormatFlags(const TrialAnalysis& analysis) {
  std::string text;
  for (const TrialFlag& flag : TrialFlagList()) {
    if (flag.is_set(analysis)) text += (text.empty() ? "" : ", ") + std::string(flag.name);
  }
  return text;
}

std::vector<FlagCount> CountFlags(const StudyResult& result) {
  std::vector<FlagCount> counts;
  for (const TrialFlag& flag : TrialFlagList()) {
    int count = 0;
    for (const StudyTrial& trial : result.trials) {
      count += trial.IsKept() && flag.is_set(*trial.analysis);
    }
    counts.push_back({&flag, count, CalcShare(count, result.CountKept())});
  }
  return counts;
}

const StudyTrial* FindGoodTrial(const StudyResult& result) {
  std::vector<double> gfts;
  for (const StudyTrial& trial : result.trials) {
    if (trial.IsKept()) gfts.push_back(trial.analysis->timing.gft);
  }
  const double median = CalcMedianOfFinite(gfts);
  const StudyTrial* good = nullptr;
  std::pair<bool, double> best;  // has a flag, distance from the median
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    const double distance = std::abs(trial.analysis->timing.gft - median);
    const std::pair<bool, double> rank = {!FormatFlags(*trial.analysis).empty(),
                                          std::isnan(distance) ? INFINITY : distance};
    if (good != nullptr && !(rank < best)) continue;
    good = &trial;
    best = rank;
  }
  return good;
}

UnverifiedTouches CountUnverified(const StudyResult& result) {
  UnverifiedTouches touches;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept() || trial.analysis->num_unverified == 0) continue;
    touches.num_contacts += trial.analysis->num_unverified;
    ++touches.num_trials;
  }
  return touches;
}

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
       "markers.companions: a digit is hidden for long where it touches"},
      {"filled_event", Curve::kOpening, "removal.filled_event: false keeps it"},
      {"gap_event", Curve::kOpening,
       "markers.companions and cleaning.max_gap_s; removal.gap_event: false keeps it"},
      {"disagreement", Curve::kOpening, "removal.max_disagreement_s; 0 keeps it"},
      {"regrasp", Curve::kOpening,
       "removal.regrasp: false keeps it: GFT is then of lasting touches, "
       "grasp_forming_time_first_s of first ones"},
      {"carried_unseen", Curve::kOpening,
       "markers.object, if the object has a marker; end_s before the lift"},
      {"other_lift_axis", Curve::kNone, "lift_off.up_x, up_y, up_z: up in the recording"},
      {"wrong_unit", Curve::kNone,
       "recording.unit, or unit of the mapping; where the file itself states a wrong one, its own "
       "(Units in line 3 of a TRC); for one digit alone its label under markers"},
      {"constant_shape", Curve::kOpening,
       "the recording: export the digits' own markers; removal.implausible: false keeps it"},
      {"label_jump", Curve::kOpening,
       "the recording: markers exchanged their labels; removal.implausible: false keeps it"},
      {"labels_exchanged", Curve::kNone,
       "the recording: the labels of the digits that the reason names, or hand in trials.csv; "
       "removal.implausible: false keeps it"},
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
