#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "reports/campaign/campaign_section.h"

namespace graspbench {
namespace {

const SceneVariants* FindScene(const CampaignData& data, const std::string& hand,
                               const std::string& object) {
  for (const SceneVariants& scene : data.scenes) {
    if (scene.hand == hand && scene.object == object && scene.IsComplete()) return &scene;
  }
  return nullptr;
}

/** A variant's values of both hands on the objects that both have grasped. */
struct HandPairs {
  std::vector<double> a, b;
  int num_a_better = 0, num_b_better = 0;
};

HandPairs ListPairs(const CampaignData& data, const VariantMeasure& measure, Variant variant,
                    const std::string& hand_a, const std::string& hand_b) {
  HandPairs pairs;
  for (const std::string& object : data.benchmark.objects) {
    const SceneVariants* a = FindScene(data, hand_a, object);
    const SceneVariants* b = FindScene(data, hand_b, object);
    if (a == nullptr || b == nullptr) continue;
    const double value_a = CalcCellValue(measure, a->cell(variant));
    const double value_b = CalcCellValue(measure, b->cell(variant));
    if (!std::isfinite(value_a) || !std::isfinite(value_b)) continue;
    pairs.a.push_back(value_a);
    pairs.b.push_back(value_b);
    const double lead = measure.is_larger_better ? value_a - value_b : value_b - value_a;
    pairs.num_a_better += lead > 0.0 ? 1 : 0;
    pairs.num_b_better += lead < 0.0 ? 1 : 0;
  }
  return pairs;
}

Html Draw(const CampaignData& data) {
  if (data.benchmark.hands.size() != 2) {
    return MakeParagraph("Two hands are compared; this campaign has " +
                         FormatCount(static_cast<int>(data.benchmark.hands.size()), "hand") + ".");
  }
  const std::string& hand_a = data.benchmark.hands[0];
  const std::string& hand_b = data.benchmark.hands[1];
  const std::string name_a = data.models.NameOfHand(hand_a);
  const std::string name_b = data.models.NameOfHand(hand_b);
  const Align number = Align::kNumber;
  Table table("Medians over the objects that both hands grasped, each with its best-suited grasp.",
              {{"Measure"},
               {"Variant"},
               {"Objects", number},
               {name_a, number},
               {name_b, number},
               {name_a + " better", number, "objects on which its value is better"},
               {name_b + " better", number, "objects on which its value is better"}});
  for (const VariantMeasure& measure : ListVariantMeasures()) {
    for (int v = 0; v < kNumVariants; ++v) {
      const auto variant = static_cast<Variant>(v);
      const HandPairs pairs = ListPairs(data, measure, variant, hand_a, hand_b);
      if (pairs.a.empty()) continue;
      const auto format = [&](const std::vector<double>& values) {
        return Text(FormatFixed(measure.unit * CalcMedianOfFinite(values), measure.decimals));
      };
      table.AddRow({Text(measure.name), Text(NameOf(variant)), Text(std::to_string(pairs.a.size())),
                    format(pairs.a), format(pairs.b), Text(std::to_string(pairs.num_a_better)),
                    Text(std::to_string(pairs.num_b_better))});
    }
  }
  return MakeScroll("The two hands", table.ToHtml());
}

}  // namespace

CampaignSection hands_campaign_section() { return {"hands", "The two hands", Draw}; }

}  // namespace graspbench
