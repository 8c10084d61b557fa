#include "reports/plots/trial_plots.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/reports/drawing.h"
#include "tests/reports/made_trial.h"

namespace graspbench {
namespace {

/** The last point of a curve, in pixels. */
Eigen::Vector2d FindEnd(const tinyxml2::XMLElement& curve) {
  const std::string path = curve.Attribute("d");
  const std::string last = path.substr(path.rfind('L') + 1);
  char* y = nullptr;
  const double x = std::strtod(last.c_str(), &y);
  return {x, std::strtod(y, nullptr)};
}

TEST(TrialPlots, ShowForcesThenJointsOfEachUnit) {
  const TrialView view = MakeTrialView();
  const std::vector<Html> plots = DrawTrialPlots(*view.hand, view.traced, view.name);
  ASSERT_EQ(plots.size(), 3u);
  const char* titles[] = {"Forces on the object, Box Hand, box",
                          "Joints of the thumb, Box Hand, box",
                          "Joints of the thumb, Box Hand, box"};
  const char* axes[] = {"normal force [N]", "thumb: position [deg]", "thumb: position [mm]"};
  for (size_t i = 0; i < plots.size(); ++i) {
    const Drawing drawing(plots[i]);
    EXPECT_STREQ(drawing.svg->FirstChildElement("title")->GetText(), titles[i]);
    EXPECT_NE(plots[i].markup().find(axes[i]), std::string::npos);
    EXPECT_EQ(drawing.Find("line", "mark").size(), 3u);
    EXPECT_EQ(drawing.Find("path", "curve series0").size(), 1u);
  }
  // The thumb alone presses: no curve of the palm or the table.
  EXPECT_TRUE(Drawing(plots[0]).Find("path", "curve series1").empty());
}

TEST(TrialPlots, CurvesMarksAndCursorAreToOneScale) {
  const TrialView view = MakeTrialView();
  const Drawing drawing(DrawTrialPlots(*view.hand, view.traced, view.name)[0]);
  const auto cursor = drawing.Find("line", "cursor");
  ASSERT_EQ(cursor.size(), 1u);
  const double left = cursor[0]->DoubleAttribute("data-left"),
               width = cursor[0]->DoubleAttribute("data-width"),
               from = cursor[0]->DoubleAttribute("data-from"),
               to = cursor[0]->DoubleAttribute("data-to");
  const auto place = [&](double time) { return left + width * (time - from) / (to - from); };
  const Eigen::Vector2d end = FindEnd(*drawing.Find("path", "curve series0")[0]);
  EXPECT_NEAR(end.x(), place(2.0), 0.1);
  const auto marks = drawing.Find("line", "mark");
  const double phases[] = {0.5, 1.0, 1.51};  // since the start of placing [s]
  for (size_t m = 0; m < marks.size(); ++m) {
    EXPECT_NEAR(marks[m]->DoubleAttribute("x1"), place(phases[m]), 0.1);
  }
  const double top = cursor[0]->DoubleAttribute("y1"), bottom = cursor[0]->DoubleAttribute("y2");
  EXPECT_NEAR(end.y(), bottom - (bottom - top) * 4.0 / 4.0, 0.1);  // 2 t N of an axis up to 4
}

TEST(TrialPlots, AFileIsOneDrawingWithItsStyle) {
  const TrialView view = MakeTrialView();
  const std::string svg = MakeTrialSvg(*view.hand, view.traced, "</style><script>");
  tinyxml2::XMLDocument document;
  ParsePage(svg, document);
  const tinyxml2::XMLElement& root = *document.RootElement();
  EXPECT_STREQ(root.Attribute("xmlns"), "http://www.w3.org/2000/svg");
  EXPECT_STREQ(root.FirstChildElement("title")->GetText(), "</style><script>");
  EXPECT_NE(root.FirstChildElement("style"), nullptr);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  std::vector<const tinyxml2::XMLElement*> cursors;
  Drawing::Collect(root, "line", "cursor", cursors);
  EXPECT_EQ(cursors.size(), 3u);
  EXPECT_EQ(svg, MakeTrialSvg(*view.hand, view.traced, "</style><script>"));
}

TEST(TrialPlots, OfATrialThatCouldNotBeginThereAreNone) {
  TrialView view = MakeTrialView();
  view.traced.trace.clear();
  view.traced.result.reason = "the palm is in the object";
  EXPECT_TRUE(DrawTrialPlots(*view.hand, view.traced, view.name).empty());
  try {
    MakeTrialSvg(*view.hand, view.traced, view.name);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("the palm is in the object"), std::string::npos);
  }
}

}  // namespace
}  // namespace graspbench
