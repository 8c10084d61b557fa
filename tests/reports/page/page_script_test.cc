#include "reports/page/page_script.h"

#include <gtest/gtest.h>

#include "reports/page/layout.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

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
  EXPECT_NE(page.find("script-src 'sha256-N9PmLvIeOZH4e02Vav6i2IWVsRPDTQEmIEq4u7FFlYQ=' "
                      "'sha256-other='; img-src"),
            std::string::npos)
      << page;
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
