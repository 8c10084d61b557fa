#include "datasets/analysis/campaign/thesis_claims.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/paired_decision.h"
#include "core/statistics/summary.h"
#include "datasets/analysis/simultaneity_summary.h"

namespace graspbench {

namespace {

double FindContact(const TrialResult& result, const std::string& digit) {
  for (const DigitContact& contact : result.contacts) {
    if (contact.digit == digit) return contact.time;
  }
  return std::nan("");
}

}  // namespace

double CalcContactGap(const CellSummary& cell, const std::string& digit_a,
                      const std::string& digit_b) {
  std::vector<double> gaps;
  for (const TrialRecord* record : cell.records) {
    const double gap =
        std::abs(FindContact(record->result, digit_a) - FindContact(record->result, digit_b));
    if (std::isfinite(gap)) gaps.push_back(gap);
  }
  return CalcMean(gaps);
}

std::map<std::string, int> CountFirstTouches(const CellSummary& cell) {
  std::map<std::string, int> counts;
  for (const TrialRecord* record : cell.records) {
    const DigitContact* first = nullptr;
    for (const DigitContact& contact : record->result.contacts) {
      if (std::isfinite(contact.time) && (!first || contact.time < first->time)) first = &contact;
    }
    if (first) ++counts[first->digit];
  }
  return counts;
}

std::string FindFirstDigit(const CellSummary& cell) {
  const std::map<std::string, int> counts = CountFirstTouches(cell);
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? "" : most->first;
}

ThumbPlace CalcThumbPlace(const CellSummary& cell, const Hand& hand, const GraspObject& object) {
  std::vector<double> heights, angles;
  const auto thumb = std::find_if(hand.digits.begin(), hand.digits.end(),
                                  [](const Digit& digit) { return digit.is_thumb; });
  for (const TrialRecord* record : cell.records) {
    for (const SceneSnapshot& snapshot : record->result.snapshots) {
      if (snapshot.moment != Moment::kClosed || thumb == hand.digits.end()) continue;
      if (snapshot.q.size() != hand.num_joints()) continue;
      const Pose X_HL = CalcLinkPoses(hand, snapshot.q)[static_cast<size_t>(thumb->distal_link)];
      const Eigen::Vector3d p_OPad = snapshot.X_WO.inverse() * snapshot.X_WH * X_HL * thumb->p_LPad;
      heights.push_back(p_OPad.z() + 0.5 * object.size.z());
      const double angle = DegFromRad(std::atan2(std::abs(p_OPad.y()), std::abs(p_OPad.x())));
      angles.push_back(std::min(angle, 90.0 - angle));
    }
  }
  return {CalcMean(heights), CalcMean(angles)};
}

TapeCourse FindTapeCourse(const SceneVariants& scene) {
  constexpr double kMuchLarger = 1.5;
  TapeCourse course;
  course.always_succeeds = true;
  for (size_t v = 0; v < kNumVariants; ++v) {
    const Tally& tally = scene.cells[v]->tally;
    course.always_succeeds = course.always_succeeds && tally.successes() == tally.finished;
    course.sigma[v] = CalcCellValue(FindVariantMeasure("sigma"), *scene.cells[v]);
  }
  course.gap_before = CalcContactGap(scene.cell(kStandardGrasp), "FF", "MF");
  course.gap_after = CalcContactGap(scene.cell(kNewPreGrasp), "FF", "MF");
  course.index_is_first = FindFirstDigit(scene.cell(kStandardGrasp)) == "FF";
  course.fingers_meet = course.gap_after < course.gap_before;
  course.is_much_firmer = course.sigma[kNewPreGrasp] >= kMuchLarger * course.sigma[kStandardGrasp];
  course.is_firmer_again = course.sigma[kNewTarget] > course.sigma[kNewPreGrasp];
  return course;
}

PropellerCourse FindPropellerCourse(const SceneVariants& scene, const Hand& hand,
                                    const GraspObject& object) {
  constexpr double kClearTurnDeg = 5.0;
  constexpr double kCubeHeight = 0.031;  ///< the blades lie on the cube [m]
  PropellerCourse course;
  for (size_t v = 0; v < kNumVariants; ++v) {
    course.places[v] = CalcThumbPlace(*scene.cells[v], hand, object);
  }
  const auto& places = course.places;
  course.starts_on_blade = places[kStandardGrasp].height > kCubeHeight;
  course.moves_between_blades =
      places[kNewPreGrasp].from_blade_deg > places[kStandardGrasp].from_blade_deg + kClearTurnDeg;
  course.ends_on_cube = places[kNewTarget].height < kCubeHeight;
  return course;
}

namespace {

using Scenes = std::vector<SceneVariants>;

constexpr int kFewestScenes = 5, kFewestTrials = 100;
constexpr char kPairedDraws[] = "intervention: the same draws with both grasps";
constexpr char kMoreScenes[] = "more scenes";

std::vector<std::string> ListHandsOf(const Scenes& scenes) {
  std::vector<std::string> hands;
  for (const SceneVariants& scene : scenes) {
    if (std::find(hands.begin(), hands.end(), scene.hand) == hands.end()) {
      hands.push_back(scene.hand);
    }
  }
  return hands;
}

bool IsBelow(const Interval& interval, double value) { return interval.high < value; }
bool IsAbove(const Interval& interval, double value) { return interval.low > value; }

/** @param sign  1: the claim says more than neutral, -1: less. */
ClaimVerdict JudgeInterval(const Interval& interval, double neutral, int sign) {
  if (sign > 0 ? IsAbove(interval, neutral) : IsBelow(interval, neutral))
    return ClaimVerdict::kHolds;
  if (sign > 0 ? IsBelow(interval, neutral) : IsAbove(interval, neutral)) {
    return ClaimVerdict::kDoesNotHold;
  }
  return ClaimVerdict::kNotDecided;
}

/** Holds when all do; one that does not is enough. */
ClaimVerdict Join(ClaimVerdict a, ClaimVerdict b) {
  if (a == ClaimVerdict::kDoesNotHold || b == ClaimVerdict::kDoesNotHold)
    return ClaimVerdict::kDoesNotHold;
  return a == ClaimVerdict::kHolds && b == ClaimVerdict::kHolds ? ClaimVerdict::kHolds
                                                                : ClaimVerdict::kNotDecided;
}

std::string FormatScenes(int count) { return FormatCount(count, "scene"); }

/** Its evidence is shown and decides nothing. */
ThesisClaim MakeSimultaneity(const Campaign& campaign) {
  ThesisClaim claim = {"simultaneous",
                       "simultaneity",
                       "Good grasps touch simultaneously.",
                       "correlation within conditions",
                       "the same draws with one digit delayed: graspbench map simultaneity",
                       0.0,
                       {}};
  for (const SimultaneityRelation& row : SummariseSimultaneity(campaign.benchmark)) {
    const std::string response = row.response->shown.id;
    if (row.measure != "gft_ratio" || (response != "success" && response != "sigma_n")) continue;
    if (!row.relation || !row.relation->interval || row.relation->num_groups < kFewestScenes ||
        row.relation->num_pairs < kFewestTrials) {
      continue;
    }
    claim.evidence.push_back({row.hand,
                              response == "success" ? "GFT% with success" : "GFT% with sigma",
                              row.relation->correlation, *row.relation->interval,
                              FormatCount(row.relation->num_pairs, "trial")});
  }
  return claim;
}

ClaimEvidence MeasureStep(const char* measure, const Scenes& scenes, Variant before, Variant after,
                          const std::string& hand) {
  const StepEffect effect =
      CalcStepEffect(FindVariantMeasure(measure), scenes, before, after, hand);
  ClaimEvidence evidence;
  evidence.hand = hand;
  evidence.what = measure;
  evidence.counted = FormatScenes(effect.num_scenes);
  if (effect.num_scenes > 0) evidence.value = effect.plain_ratio();
  if (effect.ratio && effect.num_scenes >= kFewestScenes) {
    evidence.interval = {effect.ratio->interval.low, effect.ratio->interval.high};
  }
  return evidence;
}

/** A factor over all scenes and for each hand. */
ThesisClaim JudgeStep(ThesisClaim claim, const char* measure, int sign, const Scenes& scenes,
                      Variant before, Variant after) {
  std::vector<std::string> hands = ListHandsOf(scenes);
  if (hands.size() > 1) hands.insert(hands.begin(), std::string());
  claim.verdict = hands.empty() ? ClaimVerdict::kNotDecided : ClaimVerdict::kHolds;
  for (const std::string& hand : hands) {
    claim.evidence.push_back(MeasureStep(measure, scenes, before, after, hand));
    claim.verdict =
        Join(claim.verdict, JudgeInterval(claim.evidence.back().interval, claim.neutral, sign));
  }
  return claim;
}

ThesisClaim JudgeBetter(const Scenes& scenes) {
  ThesisClaim claim = JudgeStep({"better",
                                 "both steps",
                                 "Optimised grasps are better, on very different hands.",
                                 kPairedDraws,
                                 kMoreScenes,
                                 1.0,
                                 {}},
                                "breaking", 1, scenes, kStandardGrasp, kNewTarget);
  if (claim.verdict == ClaimVerdict::kHolds && ListHandsOf(scenes).size() < 2) {
    claim.verdict = ClaimVerdict::kNotDecided;
  }
  const PairedCounts counts = CountPairedSuccesses(scenes, kStandardGrasp, kNewTarget);
  if (counts.num_pairs() == 0) return claim;
  const Interval success = CalcPairedDifferenceInterval(counts);
  // As a factor of what was held before, so that it stands on the claim's axis.
  const double held = counts.both + counts.first_only;
  const double per_point = held > 0.0 ? counts.num_pairs() / held : kUnset;
  const int gained = counts.second_only - counts.first_only;
  claim.evidence.push_back(
      {"",
       "success",
       1.0 + per_point * gained / counts.num_pairs(),
       {std::max(1.0 + per_point * success.low, 0.0), 1.0 + per_point * success.high},
       FormatCount(counts.num_pairs(), "pair")});
  if (success.high < 0.0) {
    claim.verdict = ClaimVerdict::kDoesNotHold;
  } else if (claim.verdict == ClaimVerdict::kHolds && success.low < -kSuccessMargin) {
    claim.verdict = ClaimVerdict::kNotDecided;
  }
  return claim;
}

/** Of the scenes in which a new target was taken: both change, and alike. */
ThesisClaim JudgeSigma(const Scenes& scenes) {
  ThesisClaim claim = {
      "sigma", "sigma", "Sigma predicts the breaking force.", kPairedDraws, kMoreScenes, 0.5, {}};
  int num_alike = 0, num_changed = 0;
  for (const SceneVariants& scene : scenes) {
    const Json* const step = scene.scene->result.find("target_step");
    if (!scene.IsComplete() || step == nullptr || !step->value("taken", false)) {
      continue;
    }
    const auto change = [&](const char* measure) {
      const VariantMeasure& row = FindVariantMeasure(measure);
      return CalcCellValue(row, scene.cell(kNewTarget)) -
             CalcCellValue(row, scene.cell(kNewPreGrasp));
    };
    const double of_both = change("sigma") * change("breaking");
    if (!std::isfinite(of_both) || of_both == 0.0) continue;
    ++num_changed;
    num_alike += of_both > 0.0;
  }
  if (num_changed < kFewestScenes) return claim;
  const Interval interval = CalcWilsonInterval(num_alike, num_changed);
  claim.evidence.push_back({"", "both change alike", CalcShare(num_alike, num_changed), interval,
                            FormatScenes(num_changed)});
  claim.verdict = JudgeInterval(interval, claim.neutral, 1);
  return claim;
}

}  // namespace

PairedCounts CountPairedSuccesses(const Scenes& scenes, Variant a, Variant b,
                                  const std::string& hand) {
  PairedCounts counts;
  for (const SceneVariants& scene : scenes) {
    if (!scene.IsComplete() || (!hand.empty() && scene.hand != hand)) continue;
    const PairedCounts more = CountPairedSuccesses(scene, a, b);
    counts.both += more.both;
    counts.first_only += more.first_only;
    counts.second_only += more.second_only;
    counts.neither += more.neither;
  }
  return counts;
}

std::vector<ThesisClaim> JudgeThesis(const Campaign& campaign, const Scenes& scenes) {
  return {MakeSimultaneity(campaign),
          JudgeStep({"learned",
                     "step 1",
                     "A pre-grasp can be learned from which the digits touch together.",
                     kPairedDraws,
                     kMoreScenes,
                     1.0,
                     {}},
                    "GFT%", -1, scenes, kStandardGrasp, kNewPreGrasp),
          JudgeStep({"thumb",
                     "step 2",
                     "The thumb's target posture decides how firmly a grasp holds.",
                     kPairedDraws,
                     kMoreScenes,
                     1.0,
                     {}},
                    "breaking/grip", 1, scenes, kNewPreGrasp, kNewTarget),
          JudgeBetter(scenes),
          JudgeStep({"same-grip",
                     "same grip",
                     "Optimised grasps hold better with the same grip.",
                     kPairedDraws,
                     kMoreScenes,
                     1.0,
                     {}},
                    "breaking/grip", 1, scenes, kStandardGrasp, kNewTarget),
          JudgeSigma(scenes),
          {"people",
           "people",
           "People strive for simultaneous contacts.",
           "none: no human trials here",
           "recordings: graspbench study run",
           0.0,
           {}}};
}

}  // namespace graspbench
