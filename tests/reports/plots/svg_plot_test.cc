#include "reports/plots/svg_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/reports/drawing.h"

namespace graspbench {
namespace {

TEST(DrawHeatMap, ShadesSaysAndLinks) {
  HeatMap map;
  map.text = {"Successes <b>", "What a person would say"};
  map.columns = {"TUM"};
  map.rows = {"can", "cup", "pencil"};
  map.cells = {{0.9, "9 / 10", "hint", "tum-can-g3"},
               {0.0, "0 / 10", "", "tum-cup-g3"},
               {std::nan(""), "0 / 0", "", ""}};
  const Drawing drawing(DrawHeatMap(map));
  EXPECT_STREQ(drawing.svg->FirstChildElement("title")->GetText(), "Successes <b>");
  EXPECT_STREQ(drawing.svg->FirstChildElement("desc")->GetText(), "What a person would say");
  EXPECT_STREQ(drawing.svg->Attribute("role"), "group");  // its links must stay reachable
  const auto shaded = drawing.Find("rect", "heat");
  ASSERT_EQ(shaded.size(), 1u);
  EXPECT_STREQ(shaded[0]->Attribute("fill-opacity"), "0.90");
  EXPECT_EQ(drawing.Find("rect", "heat zero").size(), 1u);
  const auto unknown = drawing.Find("rect", "heat unknown");
  ASSERT_EQ(unknown.size(), 1u);
  const auto hatch = drawing.Find("line", "hatch");
  EXPECT_GT(hatch.size(), 3u);
  for (const auto* line : hatch) {  // within the cell, rising by as much as it goes right
    const double x1 = line->DoubleAttribute("x1"), x2 = line->DoubleAttribute("x2");
    EXPECT_GE(x1, unknown[0]->DoubleAttribute("x") - 0.1);
    EXPECT_LE(x2, unknown[0]->DoubleAttribute("x") + unknown[0]->DoubleAttribute("width") + 0.1);
    EXPECT_NEAR(line->DoubleAttribute("y1") - line->DoubleAttribute("y2"), x2 - x1, 0.2);
  }
  EXPECT_EQ(ListAttribute(*drawing.svg, "href"),
            (std::vector<std::string>{"#tum-can-g3", "#tum-cup-g3"}));
  EXPECT_NE(ListText(*drawing.svg).find("9 / 10"), std::string::npos);
}

TEST(DrawHeatMap, GainsHaveTheirOwnColour) {
  HeatMap map;
  map.text = {"t", "d"};
  map.columns = {"alone"};
  map.rows = {"costs", "gains"};
  map.cells = {{0.5, "1.0", "", "", false}, {1.0, "-2.0", "", "", true}};
  const Drawing drawing(DrawHeatMap(map));
  EXPECT_EQ(drawing.Find("rect", "heat").size(), 1u);
  const auto gains = drawing.Find("rect", "heat gain");
  ASSERT_EQ(gains.size(), 1u);
  EXPECT_STREQ(gains[0]->Attribute("fill-opacity"), "1.00");
}

// Over the middle of the columns that it heads.
TEST(DrawHeatMap, AGroupStandsOnceOverItsColumns) {
  HeatMap map;
  map.text = {"t", "d"};
  map.columns = {"g1", "g2", "g3"};
  map.groups = {"TUM Hand", "TUM Hand", "Shadow Hand"};
  map.rows = {"can"};
  map.cells.resize(3);
  const Drawing drawing(DrawHeatMap(map));
  const auto heads = drawing.Find("text", "middle head");
  ASSERT_EQ(heads.size(), 5u);
  EXPECT_STREQ(heads[3]->GetText(), "TUM Hand");
  EXPECT_NEAR(2.0 * heads[3]->DoubleAttribute("x"),
              heads[0]->DoubleAttribute("x") + heads[1]->DoubleAttribute("x"), 0.2);
  EXPECT_STREQ(heads[4]->GetText(), "Shadow Hand");
  EXPECT_EQ(heads[4]->DoubleAttribute("x"), heads[2]->DoubleAttribute("x"));
  EXPECT_LT(heads[4]->DoubleAttribute("y"), heads[2]->DoubleAttribute("y"));
}

// Two hands fit a phone: 280 px beside the page's edges.
TEST(DrawHeatMap, LongHeadsWrapAndCellsAreNarrow) {
  HeatMap map;
  map.text = {"t", "d"};
  map.rows = {"voltage tester"};
  map.columns = {"TUM Hand", "Shadow Hand, developed"};
  map.cells = {{0.5, "10 / 10 g3", "", ""}, {0.5, "10 / 10 g1", "", ""}};
  const Drawing drawing(DrawHeatMap(map));
  EXPECT_LE(drawing.svg->DoubleAttribute("width"), 280.0);
  const auto heads = drawing.Find("text", "middle head");
  ASSERT_EQ(heads.size(), 4u);
  EXPECT_STREQ(heads[0]->GetText(), "TUM Hand");
  EXPECT_STREQ(heads[1]->GetText(), "Shadow");
  EXPECT_STREQ(heads[3]->GetText(), "developed");
  EXPECT_EQ(heads[0]->DoubleAttribute("y"), heads[3]->DoubleAttribute("y"));  // on the cells
  EXPECT_LT(heads[1]->DoubleAttribute("y"), heads[2]->DoubleAttribute("y"));
  EXPECT_GT(heads[1]->DoubleAttribute("y"), 0.0);
}

// Two columns under a long name, and five under a short one.
TEST(DrawHeatMap, NamesOfGroupsDoNotMeet) {
  HeatMap map;
  map.text = {"t", "d"};
  map.rows = {"can"};
  const std::string long_name = "a hand with quite a long name of its own";
  for (int i = 0; i < 7; ++i) {
    map.columns.push_back("g" + std::to_string(i));
    map.groups.push_back(i < 2 ? long_name : "TUM Hand");
    map.cells.push_back({0.5, "5 / 10", "", "anchor"});
  }
  const Drawing drawing(DrawHeatMap(map));
  std::vector<const tinyxml2::XMLElement*> groups;
  for (const auto* head : drawing.Find("text", "middle head")) {
    if (head->GetText()[0] != 'g') groups.push_back(head);
  }
  ASSERT_EQ(groups.size(), 2u);
  const double between = groups[1]->DoubleAttribute("x") - groups[0]->DoubleAttribute("x");
  EXPECT_GE(between, 0.5 * (CalcLabelWidth({long_name}) + CalcLabelWidth({"TUM Hand"})));
}

TEST(DrawRateBars, BarAndIntervalAreToScale) {
  RateBars plot;
  plot.text = {"t", "d"};
  plot.bars = {{"hand", 0.5, 0.25, 0.75, "5 of 10"}, {"other", std::nan(""), 0, 1, "0 of 0"}};
  const Drawing drawing(DrawRateBars(plot));
  EXPECT_STREQ(drawing.svg->Attribute("role"), "img");
  const auto bars = drawing.Find("rect", "bar");
  ASSERT_EQ(bars.size(), 1u);
  const double zero = bars[0]->DoubleAttribute("x");
  const double full = 2.0 * bars[0]->DoubleAttribute("width");
  const auto interval = drawing.Find("line", "interval");
  ASSERT_EQ(interval.size(), 3u);  // and its two caps
  EXPECT_NEAR(interval[0]->DoubleAttribute("x1"), zero + 0.25 * full, 0.1);
  EXPECT_NEAR(interval[0]->DoubleAttribute("x2"), zero + 0.75 * full, 0.1);
}

TEST(DrawStackedBars, PartsFillTheBarInTheOrderOfClasses) {
  StackedBars plot;
  plot.text = {"t", "d"};
  plot.classes = {{"success", "OK"}, {"slipped", "SL"}, {"dropped", "DH"}, {"lost", "LC"}};
  plot.rows = {{"can", "tum-can-g3", {6, 3, 0, 1}}, {"cup", "", {0, 0, 0, 0}}};
  const Drawing drawing(DrawStackedBars(plot));
  const auto ok = drawing.Find("rect", "part part0");
  const auto slipped = drawing.Find("rect", "part part1");
  ASSERT_EQ(ok.size(), 2u);  // the legend's and the bar's
  const double width = ok[1]->DoubleAttribute("width");
  EXPECT_NEAR(slipped[1]->DoubleAttribute("width"), width / 2.0, 0.1);
  EXPECT_NEAR(slipped[1]->DoubleAttribute("x"), ok[1]->DoubleAttribute("x") + width, 0.1);
  ExpectParts(ListText(*drawing.svg), {"OK 6", "SL 3", "LC 1", "no trial finished", "slipped: 3"});
  EXPECT_TRUE(drawing.Find("rect", "part part2").empty());  // no legend of what never occurs
}

TEST(DrawDotStrips, MarksAreToScaleAndMissingOnesAreCounted) {
  DotStrips plot;
  plot.text = {"t", "d"};
  plot.axis = "time [s]";
  plot.missing = "never";
  plot.rows = {{"thumb", {{0.2, true, "a"}, {0.4, true, "b"}, {0.9, false, "c"}}, 0.4},
               {"index", {{std::nan(""), false, "d"}}}};
  const Drawing drawing(DrawDotStrips(plot));
  const auto dots = drawing.Find("circle", "dot");
  ASSERT_EQ(dots.size(), 2u);
  EXPECT_EQ(drawing.Find("path", "cross").size(), 1u);
  const auto medians = drawing.Find("line", "median");
  ASSERT_EQ(medians.size(), 1u);  // none where nothing touched
  EXPECT_NEAR(medians[0]->DoubleAttribute("x1"), dots[1]->DoubleAttribute("cx"), 0.05);
  // 0.2 s lies as far from 0 as from 0.4 s.
  const auto grid = drawing.Find("line", "grid zero");
  const double zero = grid.at(0)->DoubleAttribute("x1");
  EXPECT_NEAR(dots[0]->DoubleAttribute("cx") - zero,
              dots[1]->DoubleAttribute("cx") - dots[0]->DoubleAttribute("cx"), 0.15);
  ExpectParts(ListText(*drawing.svg), {"1 never"});
}

TEST(DrawDotStrips, ValuesBelowZeroStayInThePlot) {
  DotStrips plot;
  plot.text = {"t", "d"};
  plot.rows = {{"thumb", {{-0.3, true, ""}, {0.2, true, ""}}}};
  const Drawing drawing(DrawDotStrips(plot));
  const double first = drawing.Find("line", "grid").at(0)->DoubleAttribute("x1");
  const double zero = drawing.Find("line", "grid zero").at(0)->DoubleAttribute("x1");
  const auto dots = drawing.Find("circle", "dot");
  EXPECT_LT(first, zero);
  EXPECT_GE(dots[0]->DoubleAttribute("cx"), first);
  EXPECT_NEAR((zero - dots[0]->DoubleAttribute("cx")) / (dots[1]->DoubleAttribute("cx") - zero),
              1.5, 0.01);
}

TEST(DrawDotStrips, NothingAtAllStillHasAnAxis) {
  DotStrips plot;
  plot.text = {"t", "d"};
  plot.rows = {{"thumb", {}}};
  const Drawing drawing(DrawDotStrips(plot));
  EXPECT_FALSE(drawing.Find("line", "grid").empty());
}

}  // namespace
}  // namespace graspbench
