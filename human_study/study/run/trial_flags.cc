#include "human_study/study/run/trial_flags.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

constexpr double kRoughTouch = 0.02;  // [s]

}  // namespace

const std::vector<TrialFlag>& TrialFlagList() {
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
      {"touch not verified",
       "neither the object's shape nor a force shows that every digit touched, rather than stopped "
       "off the surface",
       [](const A& a) { return a.num_unverified > 0; }},
      {"digit without touch", "a recorded digit never touched",
       [](const A& a) {
         return a.num_touching + a.num_unresolved < static_cast<int>(a.contacts.size());
       }},
      {"regrasp",
       "a digit touched, left its place and returned: GFT, GOT and GCT are those of its last touch",
       [](const A& a) {
         return std::any_of(a.contacts.begin(), a.contacts.end(),
                            [](const auto& digit) { return digit.regrasp.IsFound(); });
       }},
      {"may hover",
       "a digit stands more than 2 mm farther off the surface than the others in the hold, less "
       "than contact.max_pad_difference_m: it may not touch",
       [](const A& a) {
         return std::any_of(a.contacts.begin(), a.contacts.end(), [](const auto& digit) {
           return digit.contact.IsFound() && !digit.has_pad_offset && digit.stands_off > 0.002;
         });
       }},
      {"uncertain touch", "the instant of a touch is known to no better than 20 ms (95 %)",
       [](const A& a) {
         return std::any_of(a.contacts.begin(), a.contacts.end(), [](const auto& digit) {
           return digit.contact.IsFound() && digit.contact.CalcHalfWidth() > kRoughTouch;
         });
       }},
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

}  // namespace graspbench
