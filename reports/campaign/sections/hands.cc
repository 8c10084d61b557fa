#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "reports/campaign/campaign_section.h"

namespace graspbench {
namespace {

Html DrawHands(const CampaignData& data) {
  if (data.benchmark.hands.empty()) return MakeParagraph("No scene has trials yet.");
  if (data.benchmark.hands.size() != 2) {
    return MakeParagraph("Two hands are compared; this campaign has " +
                         FormatCount(static_cast<int>(data.benchmark.hands.size()), "hand") + ".");
  }
  const std::string& hand_a = data.benchmark.hands[0];
  const std::string& hand_b = data.benchmark.hands[1];
  const std::string name_a = data.models.NameOfHand(hand_a);
  const std::string name_b = data.models.NameOfHand(hand_b);
  Table table("Medians over the objects grasped by both hands, each with its best grasp.",
              {"Measure",
               "Variant",
               "Objects",
               name_a,
               name_b,
               {name_a + " better", "number of objects with the better value"},
               {name_b + " better", "number of objects with the better value"}});
  for (const VariantMeasure& measure : ListVariantMeasures()) {
    for (int v = 0; v < kNumVariants; ++v) {
      const auto variant = static_cast<Variant>(v);
      const HandComparison found = CompareHands(measure, data.scenes, variant, hand_a, hand_b);
      if (found.num_objects == 0) continue;
      const auto format = [&](double value) {
        return Text(FormatFixed(measure.unit * value, measure.decimals));
      };
      table.AddRow({measure.name, WordsOf(variant), found.num_objects, format(found.median_a),
                    format(found.median_b), found.num_a_better, found.num_b_better});
    }
  }
  return table.ToHtml();
}

}  // namespace

CampaignSection hands_campaign_section() { return {"hands", "The two hands", DrawHands}; }

}  // namespace graspbench
