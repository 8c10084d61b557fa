#include "datasets/analysis/campaign/headrooms.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/text/text.h"
#include "core/grasp/contact_timing.h"
#include "core/optimise/learning_trial.h"
#include "core/statistics/summary.h"

namespace graspbench {

Answer<double> CalcGftFloorOf(const std::vector<const TrialRecord*>& records) {
  std::vector<std::vector<DigitContact>> trials;
  for (const TrialRecord* record : records) trials.push_back(record->result.contacts);
  return CalcGftFloor(trials);
}

GftFloors CalcGftFloors(const std::vector<SceneVariants>& scenes, Variant variant,
                        const std::string& hand) {
  GftFloors floors;
  std::vector<double> ratios, values;
  for (const SceneVariants& scene : scenes) {
    if (!scene.IsComplete() || (!hand.empty() && scene.hand != hand)) continue;
    const double ratio = CalcCellValue(FindVariantMeasure("GFT%"), scene.cell(variant));
    const Answer<double> floor = CalcGftFloorOf(scene.cell(variant).records);
    if (!floor) {
      ++floors.num_without;
      continue;
    }
    ratios.push_back(ratio);
    values.push_back(*floor);
    floors.num_near += ratio <= kNearGftFloor * *floor ? 1 : 0;
  }
  floors.num_scenes = static_cast<int>(values.size());
  floors.median_ratio = CalcMedian(ratios);
  floors.median_floor = CalcMedian(values);
  return floors;
}

std::string DescribeGftFloors(const GftFloors& floors, Variant variant) {
  const std::string name = WordsOf(variant);
  if (floors.num_scenes == 0) return name + ": no scene has a floor of GFT%";
  std::string text = name + ": GFT% " + FormatPercent(floors.median_ratio) + ", floor " +
                     FormatPercent(floors.median_floor) + " (medians); " +
                     std::to_string(floors.num_near) + " of " +
                     FormatCount(floors.num_scenes, "scene") + " reach at most " +
                     FormatFixed(kNearGftFloor, 1) + " times their floor";
  if (floors.num_without > 0) {
    text += "; " + FormatCount(floors.num_without, "scene") + " without a floor";
  }
  return text;
}

namespace {

Headrooms CalcHeadrooms(const std::vector<SceneRecord>& scenes, const std::string& hand) {
  Headrooms headrooms;
  headrooms.hand = hand;
  std::vector<double> start, kept;
  std::set<std::string> reasons;
  for (const SceneRecord& scene : scenes) {
    if (scene.config.hand != hand) continue;
    const Answer<SceneHeadroom> headroom = FindHeadroom(scene);
    if (!headroom) {
      ++headrooms.num_without;
      reasons.insert(headroom.reason());
      continue;
    }
    start.push_back(headroom->start_share);
    kept.push_back(headroom->kept_share);
  }
  headrooms.num_scenes = static_cast<int>(start.size());
  headrooms.median_start = CalcMedian(start);
  headrooms.median_kept = CalcMedianOfFinite(kept);
  for (const std::string& reason : reasons) {
    headrooms.why_without += (headrooms.why_without.empty() ? "" : "; ") + reason;
  }
  return headrooms;
}

}  // namespace

Answer<SceneHeadroom> FindHeadroom(const SceneRecord& scene) {
  if (!scene.result.is_object()) return NoAnswer{"the scene is not finished"};
  const Json* const step = scene.result.find("target_step");
  if (step == nullptr) return NoAnswer{"step 2 was not run"};
  if (!step->contains("headroom_before")) return NoAnswer{"no headroom is recorded"};
  SceneHeadroom headroom;
  const auto read = [&](const char* key, double& share, double& bound) {
    const Json& recorded = step->at(key);
    if (!recorded.is_object()) return;
    share = NumberFrom(recorded.at("share"));
    bound = NumberFrom(recorded.at("bound_n"));
  };
  read("headroom_before", headroom.start_share, headroom.start_bound);
  if (headroom.start_bound == 0.0) return NoAnswer{"friction and grip do not bear the weight"};
  if (std::isnan(headroom.start_share)) return NoAnswer{"the start held nothing"};
  const bool is_taken = step->at("taken").get<bool>();
  read(is_taken ? "headroom_after" : "headroom_before", headroom.kept_share, headroom.kept_bound);
  return headroom;
}

std::vector<Headrooms> ListHeadrooms(const Campaign& campaign) {
  std::vector<Headrooms> list;
  for (const SceneRecord& scene : campaign.scenes) {
    const auto is_listed = [&](const Headrooms& other) { return other.hand == scene.config.hand; };
    if (std::none_of(list.begin(), list.end(), is_listed)) {
      list.push_back(CalcHeadrooms(campaign.scenes, scene.config.hand));
    }
  }
  return list;
}

std::string DescribeHeadrooms(const Headrooms& headrooms) {
  const std::string without =
      FormatCount(headrooms.num_without, "scene") + " without a figure (" + headrooms.why_without;
  if (headrooms.num_scenes == 0) return "headroom not known: " + without + ")";
  const double gain = CalcMostGain(headrooms.median_start);
  std::string text = "step 2 starts from grasps that resist " +
                     FormatFixed(headrooms.median_start, 2) +
                     " of the load that friction and grip allow at an object's sides, and accepts "
                     "grasps that resist " +
                     FormatFixed(headrooms.median_kept, 2) + " (medians of " +
                     FormatCount(headrooms.num_scenes, "scene") + "): ";
  text += gain > 1.0 ? "at equal grip no side grasp is more than " + FormatFixed(gain, 2) +
                           " times as strong as the median start; a grasp that reaches beneath the "
                           "object may be"
                     : "the median start is as strong as any side grasp at equal grip";
  if (headrooms.num_without > 0) text += "; " + without;
  return text;
}

}  // namespace graspbench
