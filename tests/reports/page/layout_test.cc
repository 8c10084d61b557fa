#include "reports/page/layout.h"

#include <gtest/gtest.h>

#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

Html MakeParts() {
  Table table("Rates [%], all cells", {{"Cell"}, {"Rate", Align::kNumber}});
  table.AddRow({Text("can"), Text("90")});
  const Html plot = MakeScroll("plot", Element("svg", {{"class", "plot"}}, "x"));
  return MakeFigure("Rates by hand.", "gaps.", plot) + table.ToHtml() +
         MakeFigure("Times.", "late ones.", plot) + table.ToHtml();
}

std::string TextOfId(const std::string& page, const std::string& id) {
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const tinyxml2::XMLElement* found = FindById(*document.RootElement(), id);
  return found ? ListText(*found) : "no element " + id;
}

TEST(MakePage, NumbersFiguresAndTablesInTheirOrderAndKeepsIdsApart) {
  const std::string page = MakePage({"title"}, {}, MakeParts());
  ExpectSoundPage(page);
  EXPECT_EQ(TextOfId(page, "figure-rates-by-hand").rfind("x", 0), 0u);
  EXPECT_NE(TextOfId(page, "figure-rates-by-hand").find("Figure\u00A01."), std::string::npos);
  EXPECT_NE(TextOfId(page, "figure-times").find("Figure\u00A02."), std::string::npos);
  EXPECT_NE(TextOfId(page, "table-rates-all-cells").find("Table\u00A01."), std::string::npos);
  EXPECT_NE(TextOfId(page, "table-rates-all-cells-2").find("Table\u00A02."), std::string::npos);
}

TEST(MakePage, WhatLooksLikeANumberedPartInATextIsNone) {
  const std::string hostile = "<figure id=\"figure-x\"><b class=\"nr\">Figure</b>";
  const std::string page = MakePage({hostile}, {}, Text(hostile) + MakeParts());
  ExpectSoundPage(page);
  EXPECT_NE(TextOfId(page, "figure-rates-by-hand").find("Figure\u00A01."), std::string::npos);
}

TEST(MakePage, TheSameInputGivesTheSameBytes) {
  EXPECT_EQ(MakePage({"title"}, {}, MakeParts()), MakePage({"title"}, {}, MakeParts()));
}

}  // namespace
}  // namespace graspbench
