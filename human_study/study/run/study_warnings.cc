#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

constexpr double kNearlyAll = 0.8, kManyFrozen = 0.2;
constexpr int kEnoughTrials = 5;
constexpr size_t kEnoughSamples = 100;
constexpr double kManySpikes = 0.001, kSameRate = 1.02;
constexpr double kDelay = 0.225;  // of a Butterworth of second order, times its cut-off
constexpr size_t kEnoughSpikes = 20;

/** How often a digit has no contact in the included trials, of one object or (empty) of all, and
what is most often said of it. */
struct Untouched {
  int num_trials = 0, num_missing = 0;
  std::string most_often;
};

Untouched CountUntouched(const StudyResult& result, const std::string& digit,
                         const std::string& object) {
  Untouched counted;
  std::map<std::string, int> reasons;
  int most = 0;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept() || (!object.empty() && trial.object != object)) continue;
    for (const DigitContactEvents& contact : trial.analysis->contacts) {
      if (contact.digit != digit) continue;
      ++counted.num_trials;
      if (contact.contact.IsFound() || IsUnresolved(contact.contact)) continue;
      ++counted.num_missing;
      const std::string& reason = contact.contact.missing;
      const int count = ++reasons[reason.substr(0, reason.find_first_of("0123456789"))];
      if (count <= most) continue;
      most = count;
      counted.most_often = reason;
    }
  }
  return counted;
}

bool IsNearlyAll(const Untouched& counted) {
  return counted.num_trials >= kEnoughTrials &&
         counted.num_missing >= kNearlyAll * counted.num_trials;
}

StudyWarning MakeNeverTouching(const StudyResult& result, const std::string& digit,
                               const std::string& object, const Untouched& counted) {
  const bool has_shape = !result.study.objects.empty();
  return {
      "digit_never_touches",
      fmt::format("the {} touches in {} of {} trials{} only ({}); {}its marker may be another "
                  "one, stuck, or not on the fingertip. Mend that, or leave the digit out of "
                  "markers",
                  NameOfDigit(digit), counted.num_trials - counted.num_missing, counted.num_trials,
                  object.empty() ? "" : " of object \"" + object + "\"", counted.most_often,
                  has_shape ? "the object's centre or size in objects.csv may be wrong "
                              "(without centre_x_m .. it is the middle of its markers), or "
                            : "")};
}

std::vector<StudyWarning> FindNeverTouching(const StudyResult& result) {
  std::vector<StudyWarning> warnings;
  std::set<std::string> objects;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.object.empty()) objects.insert(trial.object);
  }
  for (const std::string& digit : result.digits) {
    if (const Untouched all = CountUntouched(result, digit, ""); IsNearlyAll(all)) {
      warnings.push_back(MakeNeverTouching(result, digit, "", all));
      continue;
    }
    for (const std::string& object : objects) {
      const Untouched counted = CountUntouched(result, digit, object);
      if (IsNearlyAll(counted)) {
        warnings.push_back(MakeNeverTouching(result, digit, object, counted));
      }
    }
  }
  return warnings;
}

std::vector<StudyWarning> FindSpikes(const StudyResult& result) {
  const double share =
      static_cast<double>(result.num_spikes) / static_cast<double>(result.num_samples);
  if (!(share >= kManySpikes) || result.num_spikes < kEnoughSpikes) return {};
  return {{"spikes",
           fmt::format("{} samples ({:.2f} %) are where no marker gets to and back between two "
                       "frames; they count as missing and are bridged as gaps. Look for "
                       "reflections and exchanged labels",
                       result.num_spikes, 100.0 * share)}};
}

std::vector<StudyWarning> FindFilteredExports(const StudyResult& result) {
  std::vector<double> cutoffs;
  for (const StudyTrial& trial : result.trials) {
    if (trial.analysis && !std::isnan(trial.analysis->low_pass)) {
      cutoffs.push_back(trial.analysis->low_pass);
    }
  }
  if (cutoffs.empty()) return {};
  const double cutoff = CalcMedian(cutoffs);
  return {
      {"filtered_export",
       fmt::format("the recordings of {} of {} trials were low-passed at about {:.0f} Hz before "
                   "they were exported: the cameras' noise above it is gone. A filter that ran "
                   "with the recording makes every instant some {:.0f} ms late, any filter "
                   "makes uncertainties too small. Export the unfiltered coordinates",
                   cutoffs.size(), result.trials.size(), cutoff, MsFromS(kDelay / cutoff))}};
}

std::vector<StudyWarning> FindExchangedThumbs(const StudyResult& result) {
  constexpr int kFew = 3, kOneIn = 5;
  int count = 0;
  for (const StudyTrial& trial : result.trials) {
    count += trial.analysis && trial.analysis->may_be_exchanged;
  }
  if (count < kFew || kOneIn * count < static_cast<int>(result.trials.size())) return {};
  return {{"thumb_exchanged",
           fmt::format("in {} of {} trials the thumb's marker is farther from the wrist than the "
                       "index's, which opposes the other digits: look whether markers.thumb and "
                       "markers.index are exchanged",
                       count, result.trials.size())}};
}

std::vector<StudyWarning> FindTwoRates(const StudyResult& result) {
  if (!(result.highest_rate > kSameRate * result.lowest_rate)) return {};
  return {{"two_rates",
           fmt::format("recordings have {:.6g} to {:.6g} samples a second; contacts of slower ones "
                       "are known less well. If they should be equal, check the rate of each file: "
                       "frames that were lost and time stamps spread evenly over the rest look "
                       "like this, and times are then wrong",
                       result.lowest_rate, result.highest_rate)}};
}

std::vector<StudyWarning> FindLostFrames(const StudyResult& result) {
  const auto count = std::count_if(result.trials.begin(), result.trials.end(),
                                   [](const auto& t) { return t.removed_code == "frame_jump"; });
  if (count == 0) return {};
  return {{"frames_lost",
           fmt::format("{} of {} trials are removed because frames are missing that their time "
                       "stamps do not show. Losses at rest leave no trace, so the other trials of "
                       "this system may have some, too: compare the number of frames with the "
                       "length of each recording",
                       count, result.trials.size())}};
}

std::vector<StudyWarning> FindManyFrozen(const StudyResult& result) {
  const double share =
      static_cast<double>(result.num_frozen) / static_cast<double>(result.num_samples);
  if (!(share >= kManyFrozen) || result.num_frozen < kEnoughSamples) return {};
  return {{"frozen_samples",
           fmt::format("{:.0f} % of all samples repeat the one before exactly and count as "
                       "missing, as of a tracker that holds the last place of a hidden marker; if "
                       "these markers were at rest, say cleaning: {{drop_frozen: false}}",
                       100.0 * share)}};
}

/** Median over the trials in which a digit is seen in the hold; NaN below a few. */
double FindMarkerHeight(const StudyResult& result, const std::string& digit) {
  std::vector<double> heights;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.analysis) continue;
    for (const DigitContactEvents& contact : trial.analysis->contacts) {
      if (contact.digit != digit || std::isnan(contact.hold_distance)) continue;
      heights.push_back(contact.hold_distance);
    }
  }
  return heights.size() < static_cast<size_t>(kEnoughTrials) ? std::nan("") : CalcMedian(heights);
}

/** Markers that do not all sit alike: a nail is some 6 mm farther from the skin than a pad's side.
*/
std::vector<StudyWarning> FindUnevenMarkers(const StudyResult& result) {
  constexpr double kUneven = 3e-3;  // [m]
  std::vector<double> heights, known;
  for (int digit = 0; digit < PerDigit<double>::kNumDigits; ++digit) {
    heights.push_back(FindMarkerHeight(result, IdOfDigit(digit)));
    if (!std::isnan(heights.back())) known.push_back(heights.back());
  }
  if (known.size() < 3) return {};
  const double usual = CalcMedian(known);
  std::string uneven, offsets;
  for (int digit = 0; digit < PerDigit<double>::kNumDigits; ++digit) {
    if (std::isnan(heights[static_cast<size_t>(digit)])) continue;
    const double given = result.study.config.pad_offsets[digit];
    offsets += fmt::format("{}{}: {:.4f}", offsets.empty() ? "" : ", ", NameOfDigit(digit),
                           heights[static_cast<size_t>(digit)] + (std::isnan(given) ? 0.0 : given));
    if (std::abs(heights[static_cast<size_t>(digit)] - usual) < kUneven) continue;
    uneven += fmt::format("{}the {} {:.1f} mm", uneven.empty() ? "" : ", ", NameOfDigit(digit),
                          MmFromM(heights[static_cast<size_t>(digit)] - usual));
  }
  if (uneven.empty()) return {};
  return {{"uneven_markers",
           fmt::format("in the hold not all markers are as far from the surface, in the median of "
                       "the trials; farther than usual: {}. If markers sit on nails or elsewhere, "
                       "say pad_offsets_m: {{{}}}; otherwise that digit may not touch",
                       uneven, offsets)}};
}

}  // namespace

std::vector<StudyWarning> FindWarnings(const StudyResult& result) {
  std::vector<StudyWarning> warnings;
  for (const auto find : {FindNeverTouching, FindManyFrozen, FindSpikes, FindFilteredExports,
                          FindTwoRates, FindLostFrames, FindExchangedThumbs, FindUnevenMarkers}) {
    const std::vector<StudyWarning> found = find(result);
    warnings.insert(warnings.end(), found.begin(), found.end());
  }
  return warnings;
}

}  // namespace graspbench
