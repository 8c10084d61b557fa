#include "workbench/manual/maker/markdown.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {
namespace {

ManualText Read(const std::string& markdown) {
  return ReadMarkdown(markdown, {"a.md", testing::TempDir(), [](const std::string& target) {
                                   if (target != "b.md") throw Error(ErrorKind::kFormat, "no page");
                                   return std::string("b.html");
                                 }});
}

std::string Complain(const std::string& markdown) {
  try {
    Read(markdown);
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Markdown, TitleSubtitleAndSections) {
  const ManualText page =
      Read("# A *title*\n\nWhat it is\nabout.\n\nFirst.\n\n## One `two`\n\nSecond.\n");
  EXPECT_EQ(page.title, "A title");
  EXPECT_EQ(page.subtitle, "What it is about.");
  ASSERT_EQ(page.sections.size(), 2U);
  EXPECT_EQ(page.sections[0].text, "What it is about. First.");
  EXPECT_EQ(page.sections[1].anchor, "one-two");
  EXPECT_EQ(page.sections[1].text, " Second.");
  EXPECT_EQ(page.body.markup(),
            "<p>First.</p><h2 id=\"one-two\">One <code>two</code></h2><p>Second.</p>");
}

TEST(Markdown, TextIsNeverMarkup) {
  EXPECT_EQ(Read("# T\n\nS\n\n`<b>` & \"a\"\n").body.markup(),
            "<p><code>&lt;b&gt;</code> &amp; &quot;a&quot;</p>");
  EXPECT_EQ(Complain("# T\n\nS\n\n<script>x</script>\n"), "a.md:5: no place for html_block");
  EXPECT_EQ(Complain("# T\n\nS\n\na <b>c</b>\n"), "a.md:5: no place for html_inline");
}

TEST(Markdown, ListsTablesAndLinks) {
  EXPECT_EQ(Read("# T\n\nS\n\n- a\n- [b](b.md)\n").body.markup(),
            "<ul><li>a</li><li><a href=\"b.html\">b</a></li></ul>");
  const std::string table =
      Read("# T\n\nS\n\n| x | y |\n| --- | --- |\n| 1 | `2` |\n").body.markup();
  EXPECT_NE(table.find("<th scope=\"col\">y</th>"), std::string::npos) << table;
  EXPECT_NE(table.find("<td class=\"prose\"><code>2</code></td>"), std::string::npos) << table;
  EXPECT_EQ(Complain("# T\n\nS\n\n[c](c.md)\n"), "a.md:5: no page");
}

TEST(Markdown, WhatIsTypedIsSetApart) {
  EXPECT_NE(Read("# T\n\nS\n\n```console\n$ run <x>\ndone\n```\n")
                .body.markup()
                .find("<pre class=\"console\"><b>$ run &lt;x&gt;\n</b>done\n</pre>"),
            std::string::npos);
}

TEST(Markdown, PicturesAreInThePage) {
  WriteFile(std::filesystem::path(testing::TempDir()) / "p.svg", "<svg/>");
  EXPECT_EQ(Read("# T\n\nS\n\n![a picture](p.svg)\n").body.markup(),
            "<p><img src=\"data:image/svg+xml;base64,PHN2Zy8+\" alt=\"a picture\"/></p>");
  EXPECT_EQ(Complain("# T\n\nS\n\n![a](none.png)\n"), "a.md:5: no picture none.png");
}

TEST(Markdown, APageBeginsWithItsTitle) {
  const std::string wanted = "a page begins with its title: # Title";
  EXPECT_EQ(Complain("Text.\n"), "a.md:1: " + wanted);
  EXPECT_EQ(Complain(""), "a.md:1: " + wanted);
  EXPECT_EQ(Complain("# T\n\nS\n\n#### deep\n"), "a.md:5: headings are of second or third order");
}

}  // namespace
}  // namespace graspbench
