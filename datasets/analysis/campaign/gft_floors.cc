#include "datasets/analysis/campaign/gft_floors.h"

#include "core/base/text/text.h"
#include "core/grasp/gft_floor.h"
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

}  // namespace graspbench
