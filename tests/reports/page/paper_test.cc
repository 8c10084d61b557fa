#include "reports/page/paper.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>

#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"
#include "tests/reports/report_fixture.h"

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
  Table table("Rates.", {"Cell", "Rate"});
  table.AddRow({"=can, \"a\"", "-0.5"});
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
  const std::string svg =
      Find(MakePaperFiles(MakePageToTake(), PaperParts::kAll), "figures/fig-01-changes-more.svg");
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS) << svg;
  EXPECT_STREQ(document.RootElement()->Attribute("xmlns"), "http://www.w3.org/2000/svg");
  EXPECT_EQ(svg.find("var("), std::string::npos);
  EXPECT_EQ(svg.find("href"), std::string::npos);
  EXPECT_EQ(svg.find("dominant-baseline"), std::string::npos);
  ExpectParts(svg, {"dy=\"0.35em\""});
  EXPECT_NE(svg.find("#0072b2"), std::string::npos) << "the first series by day";
  ExpectParts(svg, {"mass &lt;x&gt;"});
}

TEST(MakePaperFiles, TablesAreCsvThatNoSpreadsheetRuns) {
  EXPECT_EQ(Find(MakePaperFiles(MakePageToTake(), PaperParts::kAll), "tables/tab-01-rates.csv"),
            "Cell,Rate\n\"'=can, \"\"a\"\"\",-0.5\n");
}

TEST(MakePaperFiles, MethodsReferencesAndCaptionsAreText) {
  const std::vector<PaperFile> files = MakePaperFiles(MakePageToTake(), PaperParts::kAll);
  EXPECT_EQ(Find(files, "methods.md"), "# Methods\n\nWe grasped.\n\nWe lifted.\n");
  EXPECT_NE(Find(files, "refs.bib").find("@article{wilson1927,"), std::string::npos);
  const std::string captions = Find(files, "captions.md");
  ExpectParts(captions, {"Figure\u00A01. Changes & more."});
  EXPECT_EQ(captions.find("What to look for"), std::string::npos) << captions;
  ExpectParts(captions, {"(tables/tab-01-rates.csv, .tex)"});
}

TEST(MakePaperFiles, LatexTablesAreEscaped) {
  EXPECT_EQ(Find(MakePaperFiles(MakePageToTake(), PaperParts::kAll), "tables/tab-01-rates.tex"),
            "\\begin{tabular}{lr}\n\\toprule\nCell & Rate \\\\\n\\midrule\n"
            "=can, \"a\" & -0.5 \\\\\n\\bottomrule\n\\end{tabular}\n");
  Table table("Signs.", {"a_b"});
  table.AddRow({"5 % of {x} & \\y^2 < $3"});
  EXPECT_EQ(Find(MakePaperFiles(MakePage({"title"}, {}, table.ToHtml()), PaperParts::kAll),
                 "tables/tab-01-signs.tex"),
            "\\begin{tabular}{l}\n\\toprule\na\\_b \\\\\n\\midrule\n"
            "5 \\% of \\{x\\} \\& \\textbackslash{}y\\textasciicircum{}2 \\textless{} \\$3 \\\\\n"
            "\\bottomrule\n\\end{tabular}\n");
}

TEST(MakePaperFiles, WhatIsFoldedIsLeftOutUnlessAllIsAskedFor) {
  const std::vector<PaperFile> files = MakePaperFiles(MakePageToTake(), PaperParts::kShown);
  EXPECT_EQ(Find(files, "tables/tab-01-rates.csv"), "no file tables/tab-01-rates.csv");
  EXPECT_NE(Find(files, "figures/fig-01-changes-more.svg").find("<svg"), std::string::npos);
}

TEST(MakePaperFiles, AtMostTwelveTablesNumberedAsOnThePage) {
  Html body;
  for (int i = 0; i < 15; ++i) {
    Table table("A table with quite a long title.", {"x"});
    table.AddRow({"1"});
    body += i == 0 ? MakeDetails("more", table.ToHtml()) : table.ToHtml();
  }
  const auto count = [&](PaperParts parts) {
    const std::vector<PaperFile> files = MakePaperFiles(MakePage({"title"}, {}, body), parts);
    return std::count_if(files.begin(), files.end(), [](const PaperFile& file) {
      return file.name.size() > 4 && file.name.substr(file.name.size() - 4) == ".csv";
    });
  };
  EXPECT_EQ(count(PaperParts::kShown), 12);
  EXPECT_EQ(count(PaperParts::kAll), 15) << "versions are no table of a paper";
  const std::vector<PaperFile> files =
      MakePaperFiles(MakePage({"title"}, {}, body), PaperParts::kShown);
  EXPECT_EQ(files.front().name, "tables/tab-02-a-table-with-quite.csv");
}

}  // namespace
}  // namespace graspbench
