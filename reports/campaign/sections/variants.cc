#include <cmath>

#include "core/base/text.h"
#include "reports/campaign/campaign_section.h"

namespace graspbench {
namespace {

/** The three values of a scene in one cell: "0.93 / 2.90 / 7.20". */
std::string FormatThree(const VariantMeasure& measure, const SceneVariants& scene) {
  std::string text;
  for (const CellSummary* cell : scene.cells) {
    const double value = cell ? CalcCellValue(measure, *cell) : std::nan("");
    text += (text.empty() ? "" : " / ") + FormatFixed(measure.unit * value, measure.decimals);
  }
  return text;
}

Html DrawVariants(const CampaignData& data) {
  if (data.scenes.empty()) return MakeParagraph("There is nothing to show.");
  std::vector<Column> columns = {{"Scene"}, {"Grasp"}};
  for (const VariantMeasure& measure : ListVariantMeasures()) {
    columns.push_back({measure.name, Align::kNumber, measure.meaning});
  }
  Table table(
      "Standard grasp / new pre-grasp / new target grasp. Success, sigma and breaking force "
      "are means over the trials, the others medians over the trials that have them.",
      columns);
  for (const SceneVariants& scene : data.scenes) {
    std::vector<Html> row = {LinkTo(scene.key, data.NameOfScene(scene)),
                             Text(NameOfGrasp(scene.grasp))};
    for (const VariantMeasure& measure : ListVariantMeasures()) {
      row.push_back(Text(FormatThree(measure, scene)));
    }
    table.AddRow(row);
  }
  return table.ToHtml();
}

}  // namespace

CampaignSection variants_campaign_section() { return {"variants", "Scene by scene", DrawVariants}; }

}  // namespace graspbench
