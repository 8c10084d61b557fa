#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "reports/campaign/campaign_section.h"
#include "reports/plots/line_plot.h"

namespace graspbench {
namespace {

Html DrawScene(const std::vector<const MethodCurve*>& curves, const std::string& name) {
  LinePlot plot;
  plot.text.title = "Best fitness so far, " + name;
  plot.text.description = "Median over seeds with quartiles, one curve per method.";
  plot.x_axis = "evaluations";
  plot.y_axis = "best fitness so far";
  for (const MethodCurve* curve : curves) {
    plot.series.push_back(
        {curve->method, curve->evaluations, curve->median, curve->low, curve->high});
  }
  return MakeFigure(plot.text.title + ", median and quartiles over seeds.",
                    "curves that rise early and end high; bands that do not overlap.",
                    MakeScroll(plot.text.title, DrawLinePlot(plot)));
}

Html DrawConvergence(const CampaignData& data) {
  const std::vector<MethodCurve> curves = ListMethodCurves(data.campaign);
  if (curves.empty()) {
    return MakeParagraph(
        "No comparison of search methods is stored; graspbench campaign --compare makes one.");
  }
  Table table("Search methods at the same number of evaluations from the same start.",
              {"Scene",
               "Method",
               "Seeds",
               "Evaluations",
               {"Best fitness", "median over seeds"},
               "Quartiles",
               {"To 90 %",
                "median number of evaluations until 90 % of the way from the start to the best "
                "fitness that any run of the scene found"}});
  Html figures;
  for (size_t first = 0, last; first < curves.size(); first = last) {
    std::vector<const MethodCurve*> scene;
    for (last = first; last < curves.size() && curves[last].hand == curves[first].hand &&
                       curves[last].object == curves[first].object;
         ++last) {
      scene.push_back(&curves[last]);
    }
    const std::string name = data.models.NameOfHand(curves[first].hand) + ", " +
                             data.models.NameOfObject(curves[first].object);
    for (const MethodCurve* curve : scene) {
      if (curve->evaluations.empty()) continue;
      table.AddRow({name, curve->method, curve->num_seeds,
                    FormatFixed(curve->evaluations.back(), 0), FormatFixed(curve->final_median, 3),
                    FormatRange(curve->low.back(), curve->high.back(), 3),
                    std::isfinite(curve->median_evaluations_to_90)
                        ? FormatFixed(curve->median_evaluations_to_90, 0)
                        : std::string("never")});
    }
    figures += DrawScene(scene, name);
  }
  Html html;
  const MethodDuel duel = CompareMethods(curves, "es", "random");
  if (duel.num_scenes > 0) {
    html += MakeParagraph(
        "By the median over seeds, the evolution strategy ends above random search in " +
        std::to_string(duel.num_won) + " of " + FormatCount(duel.num_scenes, "scene") + " (" +
        FormatPercent(duel.share_won()) + ").");
  }
  return html + table.ToHtml() + figures;
}

}  // namespace

CampaignSection convergence_campaign_section() {
  return {"convergence", "Convergence of the evolution", DrawConvergence};
}

}  // namespace graspbench
