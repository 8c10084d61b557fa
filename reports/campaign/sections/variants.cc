#include <cmath>

#include "core/base/text/text.h"
#include "reports/campaign/campaign_section.h"

namespace graspbench {
namespace {

Html DrawVariants(const CampaignData& data) {
  if (data.scenes.empty()) return MakeParagraph("There is nothing to show.");
  std::vector<Column> columns = {"Scene", "Grasp", "Variant"};
  for (const VariantMeasure& measure : ListVariantMeasures()) {
    columns.push_back({measure.name, measure.meaning});
  }
  Table table(
      "All scenes with their three variants. Success, sigma and breaking force are means over "
      "trials; other columns are medians over the trials with a value. Ratios to the grip are "
      "computed per trial.",
      columns);
  for (const SceneVariants& scene : data.scenes) {
    for (int v = 0; v < kNumVariants; ++v) {
      std::vector<Cell> row = {LinkTo(scene.key, data.NameOfScene(scene)), NameOfGrasp(scene.grasp),
                               WordsOf(static_cast<Variant>(v))};
      for (const VariantMeasure& measure : ListVariantMeasures()) {
        const double value =
            scene.cells[v] ? CalcCellValue(measure, *scene.cells[v]) : std::nan("");
        row.push_back(FormatFixed(measure.unit * value, measure.decimals));
      }
      table.AddRow(row);
    }
  }
  return table.ToHtml();
}

}  // namespace

CampaignSection variants_campaign_section() { return {"variants", "Scene by scene", DrawVariants}; }

}  // namespace graspbench
