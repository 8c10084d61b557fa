#include <cmath>

#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"

namespace graspbench {
namespace {

Html DrawLearningCurve(const std::vector<LearningPoint>& points) {
  LinePlot plot;
  plot.text = {"Success by session",
               "Success rates of the sessions, with 95 % intervals as a band."};
  plot.x_axis = "session, in the order of the table";
  plot.y_axis = "success [%]";
  LinePlot::Series rate, best;
  rate.label = "success";
  best.label = "best so far";
  for (size_t i = 0; i < points.size(); ++i) {
    const auto number = static_cast<double>(i + 1);
    const double percent = 100.0 * points[i].rate;
    rate.x.push_back(number);
    rate.y.push_back(percent);
    rate.low.push_back(100.0 * points[i].interval.low);
    rate.high.push_back(100.0 * points[i].interval.high);
    best.x.push_back(number);
    best.y.push_back(i == 0 ? percent : std::fmax(percent, best.y.back()));
  }
  plot.series = {rate, best};
  return MakeFigure(
      plot.text.title + ".",
      "sessions whose band does not overlap that of the first; the best of many is partly chance.",
      MakeScroll(plot.text.title, DrawLinePlot(plot)));
}

Html DrawLearningTable(const std::vector<LearningPoint>& points) {
  return MakeTable("Sessions, each compared with the first on the same draws.",
                   ShowTable(ListLearningColumns(), points));
}

}  // namespace

std::string MakeLearningPage(const std::vector<LearningPoint>& points) {
  const std::vector<PageSection<std::vector<LearningPoint>>> sections = {
      {"curve", "Curve", DrawLearningCurve}, {"sessions", "Sessions", DrawLearningTable}};
  PageFrame frame = {"Learning", std::to_string(points.size()) + " sessions"};
  frame.commands = {"graspbench learning FOLDER --out DIR"};
  frame.references = {"wilson1927"};
  return MakeSectionedPage(frame, sections, points);
}

}  // namespace graspbench
