#include <cmath>

#include "core/base/text/text.h"
#include "datasets/analysis/argument/argument_evidence.h"
#include "datasets/analysis/campaign/headrooms.h"
#include "reports/campaign/campaign_section.h"

namespace graspbench {
namespace {

struct Step {
  const char* name;
  Variant before, after;
};
constexpr Step kSteps[] = {{"Step 1, new pre-grasp", kStandardGrasp, kNewPreGrasp},
                           {"Step 2, new target grasp", kNewPreGrasp, kNewTarget},
                           {"Both steps", kStandardGrasp, kNewTarget}};

std::string FormatMeasure(const VariantMeasure& measure, double value) {
  return FormatFixed(measure.unit * value, measure.decimals);
}

std::string FormatRatio(const StepEffect& effect) {
  if (!effect.ratio) return FormatFixed(effect.plain_ratio(), 2);
  const auto& interval = effect.ratio->interval;
  return FormatWithRange(effect.ratio->estimate, interval.low, interval.high, 2);
}

Html DrawEffects(const CampaignData& data, const std::string& hand, const std::string& name) {
  Table table(name + ": medians over the scenes, before and after.",
              {"Step",
               "Measure",
               {"Scenes", "in which both variants have a value"},
               "Before",
               "After",
               {"After / before",
                "ratio of the medians with 95 % bootstrap interval over scenes; none if the value "
                "never changes"},
               {"Worse", "scenes whose value is worse after the step"}});
  for (const Step& step : kSteps) {
    for (const VariantMeasure& measure : ListVariantMeasures()) {
      const StepEffect effect = CalcStepEffect(measure, data.scenes, step.before, step.after, hand);
      if (effect.num_scenes == 0) continue;
      table.AddRow(
          {step.name, measure.name, effect.num_scenes, FormatMeasure(measure, effect.median_before),
           FormatMeasure(measure, effect.median_after), FormatRatio(effect),
           std::to_string(effect.worse.size()) + " (" + FormatPercent(effect.share_worse()) + ")"});
    }
  }
  return table.ToHtml();
}

std::string DescribeLower(const CampaignData& data, const Step& step) {
  const auto lower = ListSignificantlyLower(data.scenes, step.before, step.after);
  std::string text = std::string(step.name) + ": success is significantly lower in " +
                     FormatCount(static_cast<int>(lower.size()), "scene");
  for (size_t i = 0; i < lower.size(); ++i) {
    text += (i == 0 ? ": " : "; ") + data.NameOfScene(*lower[i].scene) + " (" +
            std::to_string(lower[i].counts.first_only) + " of " +
            FormatCount(lower[i].counts.num_pairs(), "pair") + " lost, " +
            std::to_string(lower[i].counts.second_only) + " gained)";
  }
  return text + ".";
}

/** Describes GFT% before and after step 1 with the object exactly at its expected pose. */
Html DescribeWithoutVariation(const CampaignData& data) {
  const GftWithoutVariation gft = CalcGftWithoutVariation(data.scenes);
  if (gft.num_scenes == 0) return {};
  return MakeParagraph(
      "The object position and the joint errors vary between trials, and no pre-grasp can "
      "compensate for unknown variation. Without variation, step 1 changes the median GFT% from " +
      FormatPercent(gft.median_before) + " to " + FormatPercent(gft.median_after) + " (" +
      FormatCount(gft.num_scenes, "scene") +
      " in which all digits touch before and after). Without scatter the floor is 0.");
}

constexpr Variant kFloorVariants[] = {kStandardGrasp, kNewPreGrasp};

/** Tabulates GFT% and its lower bound for the two variants of step 1, one row per scene. */
Html DrawFloorTable(const CampaignData& data) {
  std::vector<Column> columns = {"Scene"};
  for (const Variant variant : kFloorVariants) {
    const std::string name = Capitalise(WordsOf(variant));
    columns.push_back({name + ": GFT% [%]", "median of the benchmark's trials"});
    columns.push_back("Floor [%]");
    columns.push_back("GFT% / floor");
  }
  Table table("GFT% of step 1 and its floor, scene by scene.", columns);
  const VariantMeasure& gft = FindVariantMeasure("GFT%");
  for (const SceneVariants& scene : data.scenes) {
    if (!scene.IsComplete()) continue;
    std::vector<Cell> row = {data.NameOfScene(scene)};
    for (const Variant variant : kFloorVariants) {
      const double ratio = CalcCellValue(gft, scene.cell(variant));
      const Answer<double> floor = CalcGftFloorOf(scene.cell(variant).records);
      row.push_back(FormatMeasure(gft, ratio));
      row.push_back(floor ? FormatMeasure(gft, *floor) : "no floor: " + floor.reason());
      row.push_back(floor && *floor > 0.0 ? FormatFixed(ratio / *floor, 2) : "-");
    }
    table.AddRow(row);
  }
  return MakeDetails("GFT% and its floor, scene by scene", table.ToHtml());
}

/** Tabulates changes of GFT in ms in the fresh check trials of step 1, for the pre-grasp alone and
for the checked result, which may delay digits. */
Html DrawPreGraspTimes(const CampaignData& data) {
  std::vector<FromFolder<SceneRecord>> scenes;
  for (const SceneRecord& scene : data.campaign.scenes) {
    scenes.push_back({"", {scene.config, scene.result, {}, {}}});
  }
  const std::vector<ArgumentNumber> numbers = ListPreGraspNumbers(scenes);
  if (numbers.empty()) return {};
  return MakeParagraph(
             "Step 1 has two results: a learned pre-grasp, and closing delays at the start of "
             "closure. Both are given in ms, because GFT% also falls if only the closing time "
             "grows.") +
         MakeTable(
             "Pre-grasp and closing delays: change of GFT, median over scenes.",
             ShowTable(ListArgumentColumns(), numbers, {"of", "value, 95 % interval, n", "also"}));
}

Html DrawFloors(const CampaignData& data) {
  std::vector<std::string> lines;
  for (const Variant variant : kFloorVariants) {
    lines.push_back(DescribeGftFloors(CalcGftFloors(data.scenes, variant), variant) + ".");
    if (data.benchmark.hands.size() < 2) continue;
    for (const std::string& hand : data.benchmark.hands) {
      lines.push_back(data.models.NameOfHand(hand) + ", " +
                      DescribeGftFloors(CalcGftFloors(data.scenes, variant, hand), variant) + ".");
    }
  }
  return MakeParagraph(
             "The floor of GFT% is the median GFT% of the same trials after the times of each "
             "digit are shifted by their own median. It is the scatter between trials, which no "
             "pre-grasp can remove.") +
         MakeList(lines) + DrawFloorTable(data) + DrawPreGraspTimes(data);
}

/** Tabulates the start and the accepted result of step 2, one row per scene. */
Html DrawHeadroomTable(const CampaignData& data) {
  Table table("Share of the load that friction and grip allow at the object's sides, by scene.",
              {"Scene",
               {"Start: share", "of mu N - m g, in the check trials of step 2"},
               {"Allowed [N]", "mu N - m g"},
               {"Kept: share", "value of the start if the new target was rejected"},
               {"Allowed [N]", "mu N - m g"}});
  for (const SceneVariants& scene : data.scenes) {
    const Answer<SceneHeadroom> headroom = FindHeadroom(*scene.scene);
    std::vector<Cell> row = {data.NameOfScene(scene)};
    if (headroom) {
      for (const double value : {headroom->start_share, headroom->start_bound, headroom->kept_share,
                                 headroom->kept_bound}) {
        row.push_back(FormatFixed(value, 2));
      }
    } else {
      row.push_back("no figure: " + headroom.reason());
      for (int i = 0; i < 3; ++i) row.push_back("-");
    }
    table.AddRow(row);
  }
  return MakeDetails("Headroom of step 2, scene by scene", table.ToHtml());
}

Html DrawHeadrooms(const CampaignData& data) {
  std::vector<std::string> lines;
  for (const Headrooms& headrooms : ListHeadrooms(data.campaign)) {
    lines.push_back(data.models.NameOfHand(headrooms.hand) + ": " + DescribeHeadrooms(headrooms) +
                    ".");
  }
  return MakeParagraph(
             "Against a downward pull, contacts at the object's sides resist by friction only: at "
             "most friction coefficient times grip minus object weight. The share that a grasp "
             "reaches shows the headroom of another grasp with the same grip.") +
         MakeList(lines) + DrawHeadroomTable(data);
}

Html DrawEffects(const CampaignData& data) {
  const int num_complete =
      CalcStepEffect(FindVariantMeasure("success"), data.scenes, kStandardGrasp, kNewTarget)
          .num_scenes;
  if (num_complete == 0) return MakeParagraph("No scene has trials of all three variants yet.");
  Html html = MakeParagraph(
      "Each grasp was optimised for its object in simulation in two steps. Step 1 learns a "
      "pre-grasp with simultaneous contacts; step 2 optimises the target posture of the thumb for "
      "stability. All three variants were then tested on the same " +
      FormatCount(data.campaign.config.session.trials, "trial pose") +
      ", which were not used in the optimisation.");
  html += DrawEffects(data, {}, "All hands") + DescribeWithoutVariation(data) + DrawFloors(data) +
          DrawHeadrooms(data);
  if (data.benchmark.hands.size() > 1) {
    for (const std::string& hand : data.benchmark.hands) {
      html += MakeDetails(data.models.NameOfHand(hand) + " alone",
                          DrawEffects(data, hand, data.models.NameOfHand(hand)));
    }
  }
  std::vector<std::string> lines;
  for (const Step& step : kSteps) lines.push_back(DescribeLower(data, step));
  return html +
         MakeParagraph(
             "McNemar's exact test on the pairs of each scene, p < 0.05 after Holm's correction "
             "over the scenes:") +
         MakeList(lines);
}

}  // namespace

CampaignSection effects_campaign_section() {
  return {"effects", "Effects of the two steps", DrawEffects};
}

}  // namespace graspbench
