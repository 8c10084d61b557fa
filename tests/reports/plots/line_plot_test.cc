#include "reports/plots/line_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "reports/plots/paired_plot.h"
#include "tests/reports/drawing.h"

namespace graspbench {
namespace {

const double kMissing = std::nan("");

TEST(DrawLinePlot, AMissingValueInterruptsTheCurve) {
  LinePlot plot;
  plot.text = {"Opening", "It grows"};
  plot.series = {{"hand", {0.0, 1.0, 2.0, 3.0, 4.0}, {0.0, 1.0, kMissing, 1.0, 2.0}, {}, {}}};
  const Drawing drawing(DrawLinePlot(plot));
  const auto curves = drawing.Find("path", "curve series0");
  ASSERT_EQ(curves.size(), 1U);
  const std::string path = curves[0]->Attribute("d");
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 2);
  EXPECT_TRUE(drawing.Find("path", "band series0").empty());
}

TEST(DrawLinePlot, TheBandRunsThereAndBackAndMarksAreToScale) {
  LinePlot plot;
  plot.text = {"Fitness", "It grows"};
  plot.series = {{"es", {0.0, 10.0}, {1.0, 2.0}, {0.5, 1.5}, {1.5, 2.5}},
                 {"random", {0.0, 10.0}, {1.0, 1.2}, {}, {}}};
  plot.marks = {{0.0, "start"}, {5.0, "half"}, {10.0, "end"}};
  const Drawing drawing(DrawLinePlot(plot));
  const auto bands = drawing.Find("path", "band series0");
  ASSERT_EQ(bands.size(), 1U);
  const std::string path = bands[0]->Attribute("d");
  EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 3);
  EXPECT_EQ(path.back(), 'Z');
  const auto marks = drawing.Find("line", "mark");
  ASSERT_EQ(marks.size(), 3U);
  const double start = marks[0]->DoubleAttribute("x1"), half = marks[1]->DoubleAttribute("x1"),
               end = marks[2]->DoubleAttribute("x1");
  EXPECT_NEAR(half, 0.5 * (start + end), 0.1);
}

TEST(DrawLinePlot, LabelsOfMarksDoNotMeet) {
  LinePlot plot;
  plot.text = {"Force", "It grows"};
  plot.series = {{"thumb", {0.0, 10.0}, {1.0, 2.0}, {}, {}}};
  plot.marks = {{1.0, "stabilisation"}, {1.5, "lift-off"}, {8.0, "hold"}};
  const Drawing drawing(DrawLinePlot(plot));
  std::vector<double> rows;
  for (const auto* label : drawing.Find("text", "middle small")) {
    for (const auto& mark : plot.marks) {
      if (label->GetText() && mark.label == label->GetText())
        rows.push_back(label->DoubleAttribute("y"));
    }
  }
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_GT(rows[0], rows[1] + 10.0) << "the second stands above";
  EXPECT_EQ(rows[0], rows[2]) << "there is room for the third";
  EXPECT_TRUE(drawing.Find("line", "cursor").empty()) << "not asked for";
}

TEST(DrawLinePlot, NothingAtAllStillHasAxes) {
  LinePlot plot;
  plot.text = {"Empty", "No trial"};
  EXPECT_FALSE(Drawing(DrawLinePlot(plot)).Find("line", "grid").empty());
}

TEST(DrawIntervalPlot, EstimatesStandInTheMiddleOfTheirIntervals) {
  IntervalPlot plot;
  plot.text = {"Correlation", "sigma is above epsilon"};
  plot.rows = {{"sigma", 0.8, 0.7, 0.9, "0.80", "", 0, false},
               {"all grasps", 0.0, 0.0, 0.0, "", "", 0, true},
               {"unknown", kMissing, kMissing, kMissing, "n/a", "", 1, false}};
  const Drawing drawing(DrawIntervalPlot(plot));
  const auto points = drawing.Find("circle", "point series0");
  ASSERT_EQ(points.size(), 1U);  // neither the heading nor the missing value
  const auto intervals = drawing.Find("line", "interval");
  ASSERT_EQ(intervals.size(), 3U);
  EXPECT_NEAR(points[0]->DoubleAttribute("cx"),
              0.5 * (intervals[0]->DoubleAttribute("x1") + intervals[0]->DoubleAttribute("x2")),
              0.11);
  EXPECT_TRUE(drawing.Find("circle", "point series1").empty());
}

TEST(DrawIntervalPlot, LabelsAboveFitANarrowScreenAndMarksAreToScale) {
  IntervalPlot plot;
  plot.text = {"Change", "Two hands"};
  plot.holds_zero = false;
  plot.labels_above = true;
  plot.marks = {{0.0, "no effect"}, {2.0, "2 points"}};
  plot.rows = {{"tum: seen objects", 1.0, 0.0, 2.0, "not decided, n 105", "", 0, false}};
  const Drawing drawing(DrawIntervalPlot(plot));
  const auto marks = drawing.Find("line", "mark");
  const auto intervals = drawing.Find("line", "interval");
  ASSERT_EQ(marks.size(), 2U);
  ASSERT_EQ(intervals.size(), 3U);
  EXPECT_NEAR(marks[0]->DoubleAttribute("x1"), intervals[0]->DoubleAttribute("x1"), 0.11);
  EXPECT_NEAR(marks[1]->DoubleAttribute("x1"), intervals[0]->DoubleAttribute("x2"), 0.11);
  const auto labels = drawing.Find("text", "start");
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_LT(labels[0]->DoubleAttribute("y"), intervals[0]->DoubleAttribute("y1") - 8.0);
  EXPECT_LE(std::stod(drawing.Find("svg", "plot").at(0)->Attribute("width")), 348.0);
}

TEST(DrawIntervalPlot, EveryTrialIsATickToScale) {
  IntervalPlot plot;
  plot.text = {"GFT", "Means and trials"};
  IntervalPlot::Row row;
  row.label = "all trials";
  row.value = 2.0;
  row.low = row.high = kMissing;
  row.singles = {0.0, 2.0, kMissing, 4.0};  // a missing trial has no tick
  plot.rows = {row};
  const Drawing drawing(DrawIntervalPlot(plot));
  const auto ticks = drawing.Find("path", "single");
  ASSERT_EQ(ticks.size(), 1U);
  std::vector<double> places;
  const std::string path = ticks[0]->Attribute("d");
  for (size_t at = path.find('M'); at != std::string::npos; at = path.find('M', at + 1)) {
    places.push_back(std::stod(path.substr(at + 1)));
  }
  ASSERT_EQ(places.size(), 3U) << path;
  EXPECT_NEAR(places[2] - places[1], places[1] - places[0], 0.11);
  EXPECT_NEAR(drawing.Find("circle", "point series0")[0]->DoubleAttribute("cx"), places[1], 0.11);
}

TEST(DrawStripChart, SpansAreToScaleAndShortPhasesAreHints) {
  StripChart chart;
  chart.text = {"Contacts", "The thumb comes first"};
  chart.axis = "time [s]";
  chart.kinds = {"sticks", "slides"};
  chart.phases = {{0.0, 1.0, "closure"}, {1.0, 1.01, "stabilisation"}};
  chart.rows = {{"TH", {{0.2, 0.4, 0, "0.2 s"}, {0.4, 0.8, 1, "0.4 s"}}, {{0.2, "1", "first"}}},
                {"FF", {}, {}}};
  const Drawing drawing(DrawStripChart(chart));
  // The first of each class is the legend's.
  const auto sticks = drawing.Find("rect", "part part0"),
             slides = drawing.Find("rect", "part part1");
  ASSERT_EQ(sticks.size(), 2U);
  ASSERT_EQ(slides.size(), 2U);
  EXPECT_NEAR(slides[1]->DoubleAttribute("width"), 2.0 * sticks[1]->DoubleAttribute("width"), 0.2);
  EXPECT_NEAR(slides[1]->DoubleAttribute("x"),
              sticks[1]->DoubleAttribute("x") + sticks[1]->DoubleAttribute("width"), 0.11);
  ASSERT_EQ(drawing.Find("rect", "hover").size(), 1U);
  EXPECT_STREQ(drawing.Find("rect", "hover")[0]->FirstChildElement("title")->GetText(),
               "stabilisation");
}

TEST(DrawStripChart, MarksOfOneInstantStandSideBySide) {
  StripChart chart;
  chart.text = {"Contacts", "The thumb touches and slips at once"};
  chart.axis = "time [s]";
  chart.rows = {{"TH", {{0.2, 1.0, 0, ""}}, {{0.9, "L", ""}, {0.2, "T", ""}, {0.2, "S", ""}}}};
  chart.kinds = {"in contact"};
  std::vector<double> x;
  const Drawing drawing(DrawStripChart(chart));
  for (const auto* text : drawing.Find("text", "middle small")) {
    if (std::string("TSL").find(text->GetText()) != std::string::npos) {
      x.push_back(text->DoubleAttribute("x"));
    }
  }
  ASSERT_EQ(x.size(), 3U);
  EXPECT_GE(x[1], x[0] + 8.0);
  EXPECT_GT(x[2], x[1] + 100.0);  // where there is room it stands at its time
}

TEST(DrawPairedPlot, EachPersonIsALineAndAMissingValueInterruptsIt) {
  PairedPlot plot;
  plot.text = {"GFT", "It falls"};
  plot.conditions = {"small", "large"};
  plot.persons = {{"01", {1.0, 2.0}}, {"02", {1.0, kMissing}}, {"03", {2.0, 1.0}}};
  plot.means = {4.0 / 3.0, 1.5};
  const Drawing drawing(DrawPairedPlot(plot));
  EXPECT_EQ(drawing.Find("circle", "single").size(), 5U);
  const auto lines = drawing.Find("line", "single");
  ASSERT_EQ(lines.size(), 2U);
  const auto number = [](const auto* element, const char* name) {
    return std::stod(element->Attribute(name));
  };
  EXPECT_LT(number(lines[0], "y2"), number(lines[0], "y1")) << "more is higher";
  EXPECT_EQ(number(lines[0], "y2"), number(lines[1], "y1"));
  EXPECT_EQ(drawing.Find("line", "interval").size(), 3U);  // two means and what joins them
}

}  // namespace
}  // namespace graspbench
