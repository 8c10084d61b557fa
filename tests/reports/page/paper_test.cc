#include "reports/page/paper.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>

#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"

namespace graspbench {
namespace {

std::string MakePageToTake() {
  IntervalPlot plot;
  plot.text = {"Changes", "One row."};
  plot.axis = "change";
  IntervalPlot::Row row;
  row.label = "mass <x>";
  row.value = 0.5;
  row.low = 0.25;
  row.high = 0.75;
  row.text = "0.5";
  row.anchor = "somewhere";
  plot.rows.push_back(row);
  Table table("Rates.", {{"Cell"}, {"Rate", Align::kNumber}});
  table.AddRow({Text("=can, \"a\""), Text("-0.5")});
  PageFrame frame = {"title"};
  frame.references = {"wilson1927"};
  return MakePage(
      frame, {},
      Element("section", {{"id", "somewhere"}},
              MakeFigure("Changes & more.", "gaps.", MakeScroll("plot", DrawIntervalPlot(plot))) +
                  MakeDetails("all", table.ToHtml()) +
                  MakeMethodsText({"We grasped.", "We lifted."})));
}

std::string Find(const std::vector<PaperFile>& files, const std::string& name) {
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const PaperFile& file) { return file.name == name; });
  return found == files.end() ? "no file " + name : found->content;
}

TEST(MakePaperFiles, AFigureStandsAloneInItsOwnColours) {
  const std::string svg = Find(MakePaperFiles(MakePageToTake()), "figures/figure-changes-more.svg");
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS) << svg;
  EXPECT_STREQ(document.RootElement()->Attribute("xmlns"), "http://www.w3.org/2000/svg");
  EXPECT_EQ(svg.find("var("), std::string::npos);
  EXPECT_EQ(svg.find("href"), std::string::npos);
  EXPECT_EQ(svg.find("dominant-baseline"), std::string::npos);
  EXPECT_NE(svg.find("dy=\"0.35em\""), std::string::npos);
  EXPECT_NE(svg.find("#0072b2"), std::string::npos) << "the first series by day";
  EXPECT_NE(svg.find("mass &lt;x&gt;"), std::string::npos);
}

TEST(MakePaperFiles, TablesAreCsvThatNoSpreadsheetRuns) {
  EXPECT_EQ(Find(MakePaperFiles(MakePageToTake()), "tables/table-rates.csv"),
            "Cell,Rate\n\"'=can, \"\"a\"\"\",-0.5\n");
}

TEST(MakePaperFiles, MethodsReferencesAndCaptionsAreText) {
  const std::vector<PaperFile> files = MakePaperFiles(MakePageToTake());
  EXPECT_EQ(Find(files, "methods.md"), "# Methods\n\nWe grasped.\n\nWe lifted.\n");
  EXPECT_NE(Find(files, "refs.bib").find("@article{wilson1927,"), std::string::npos);
  const std::string captions = Find(files, "captions.md");
  EXPECT_NE(captions.find("Figure\u00A01. Changes & more."), std::string::npos) << captions;
  EXPECT_EQ(captions.find("What to look for"), std::string::npos) << captions;
  EXPECT_NE(captions.find("(tables/table-rates.csv)"), std::string::npos) << captions;
}

}  // namespace
}  // namespace graspbench
