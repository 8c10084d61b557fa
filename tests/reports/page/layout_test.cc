#include "reports/page/layout.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/base/text/json.h"
#include "core/physics/sim_config.h"
#include "datasets/journal/manifest.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {

namespace {

Html MakeParts() {
  Table table("Rates [%], all cells", {"Cell", "Rate"});
  table.AddRow({"can", "90"});
  const Html plot = MakeScroll("plot", Element("svg", {{"class", "plot"}}, "x"));
  return MakeFigure("Rates by hand.", "gaps.", plot) + table.ToHtml() +
         MakeFigure("Times.", "late ones.", plot) + table.ToHtml();
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

// A reader who opens nothing sees 1, 2, 3.
TEST(MakePage, WhatIsFoldedHasASecondNumber) {
  const auto make = [](const char* caption) { return Table(caption, {"Cell"}).ToHtml(); };
  const Html open = Element("details", {{"open", ""}}, make("Shown"));
  const std::string page =
      MakePage({"title"}, {},
               make("First") + MakeDetails("More", make("Folded") + make("Folded too")) + open +
                   MakeDetails("More", MakeDetails("Still more", make("Deep"))) + make("Last"));
  const std::pair<const char*, const char*> numbers[] = {{"first", "1."},        {"folded", "1.1."},
                                                         {"folded-too", "1.2."}, {"shown", "2."},
                                                         {"deep", "2.1."},       {"last", "3."}};
  for (const auto& [id, number] : numbers) {
    const std::string text = TextOfId(page, std::string("table-") + id);
    EXPECT_NE(text.find("Table\u00A0" + std::string(number) + " "), std::string::npos) << text;
  }
}

TEST(MakePage, WhatLooksLikeANumberedPartInATextIsNone) {
  const std::string hostile = "<figure id=\"figure-x\"><b class=\"nr\">Figure</b>";
  const std::string page = MakePage({hostile}, {}, Text(hostile) + MakeParts());
  ExpectSoundPage(page);
  EXPECT_NE(TextOfId(page, "figure-rates-by-hand").find("Figure\u00A01."), std::string::npos);
}

TEST(Table, ColumnsOfNumbersStandToTheRightAndOfWordsDoNot) {
  const std::pair<const char*, bool> cases[] = {
      {"12.5", true},       {"-0.4 (-1.2 to 0.3)", true},
      {"6 of 10", true},    {"x 1.41", true},
      {"F = 1.91", true},   {"3 ms", true},
      {"< 0.001", true},    {"1 lost while closing", false},
      {"golf_ball", false}, {"g2, clear", false}};
  for (const auto& [cell, is_number] : cases) {
    Table table("t", {{"name"}, {"value"}});
    table.AddRow({"a", cell});
    table.AddRow({"b", "n/a"});
    const std::string markup = table.ToHtml().markup();
    EXPECT_EQ(markup.find("<td class=\"number\">n/a") != markup.npos, is_number) << cell;
  }
}

TEST(MakeBibtex, GivesTheWholeEntriesAskedForAndNoOthers) {
  const std::string text = MakeBibtex({"wilson1927", "holm1979"});
  EXPECT_EQ(text.rfind("@software{graspbench,", 0), 0u);
  ExpectParts(text,
              {"The graspbench developers", "year    = {20", "commit ", "@article{wilson1927,",
               "10.1080/01621459.1927.10502953", "@article{holm1979,"});
  EXPECT_EQ(text.find("efron1987"), std::string::npos);
  int depth = 0;
  for (const char c : text) depth += c == '{' ? 1 : c == '}' ? -1 : 0;
  EXPECT_EQ(depth, 0);
  EXPECT_EQ(text.substr(text.size() - 3), "\n}\n");
}

TEST(DescribePhysics, NamesAnotherThanTheProgramsOwn) {
  const std::string now = std::to_string(kPhysicsVersion);
  EXPECT_EQ(DescribePhysics(kPhysicsVersion), "");
  EXPECT_EQ(DescribePhysics(8), "; simulated with physics 8, this graspbench has " + now);
  EXPECT_EQ(DescribePhysics(0),
            "; simulated with an unnamed physics version, this graspbench has " + now);
}

TEST(MakeJsonLd, HostileTextsStayTextsAndCannotEndTheScript) {
  PageFrame frame = {"</script><b>&", "\"sub\""};
  frame.facts = {{"Seed", "<!--"}};
  const std::string text = MakeJsonLd(frame);
  for (const char c : {'<', '>', '&'}) EXPECT_EQ(text.find(c), std::string::npos) << c;
  const Json json = Json::parse(text);
  EXPECT_EQ(json.at("name"), "</script><b>&");
  EXPECT_EQ(json.at("description"), "\"sub\"");
  EXPECT_EQ(json.at("additionalProperty").back().at("value"), "<!--");
}

TEST(DrawProvenance, StandsInThePageWithCommandFactsAndReferences) {
  PageFrame frame = {"title"};
  frame.commands = {"graspbench report DIR"};
  frame.facts = {{"Seed", "17"}};
  frame.references = {"halton1960"};
  const std::string page = MakePage(frame, {}, MakeMethodsText({"We grasped."}));
  ExpectSoundPage(page);
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const std::string text = ListText(*FindById(*document.RootElement(), "provenance"));
  ExpectParts(text, {"graspbench report DIR", "Seed 17", "Simbody", "@article{halton1960"});
}

TEST(WriteReportPage, SealsWhatItWrote) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "write_page";
  std::filesystem::remove_all(folder);
  for (const char* page : {"first", "second"}) {
    EXPECT_EQ(WriteReportPage(folder, page), folder / "report" / "index.html");
    EXPECT_EQ(ReadFile(folder / "report" / "index.html"), page);
    const Manifest manifest = LoadManifest(folder / "report");
    ASSERT_EQ(manifest.files.size(), 1u);
    EXPECT_TRUE(FindDamage(folder / "report", manifest).empty());
  }
}

const char kPage[] =
    "<html><head><meta content=\"default-src 'none'; img-src data:\"/></head>"
    "<body>x</body></html>";

TEST(PageScript, IsAllowedByItsHashAlone) {
  // printf '//<![CDATA[\nrun()\n//]]>\n' | openssl dgst -sha256 -binary | base64
  EXPECT_EQ(AddScript(kPage, {"p {}", "run()"}),
            "<html><head><meta content=\"default-src 'none'; script-src "
            "'sha256-N9PmLvIeOZH4e02Vav6i2IWVsRPDTQEmIEq4u7FFlYQ='; img-src data:\"/><style>\np "
            "{}</style>\n</head>"
            "<body>x<script>//<![CDATA[\nrun()\n//]]>\n</script>\n</body></html>");
}

TEST(PageScript, JoinsThosePermittedBefore) {
  std::string page = kPage;
  page.insert(page.find("img-src"), "script-src 'sha256-other='; ");
  page = AddScript(page, {"", "run()"});
  ExpectParts(page, {"script-src 'sha256-N9PmLvIeOZH4e02Vav6i2IWVsRPDTQEmIEq4u7FFlYQ=' "
                     "'sha256-other='; img-src"});
}

TEST(PageScript, LeavesAPageWithoutScriptAsItIs) { EXPECT_EQ(AddScript(kPage, {"a", ""}), kPage); }

TEST(PageScript, FitsTheFrameOfEveryPage) {
  const std::string page =
      AddScript(MakePage({"Title", ""}, {}, MakeParagraph("</head> default-src 'none'; </body>")),
                {"", "a < b && c"});
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  EXPECT_NE(document.RootElement()->FirstChildElement("body")->LastChildElement("script"), nullptr);
}

}  // namespace

}  // namespace graspbench
