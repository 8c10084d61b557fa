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

TEST(Markdown, TextListsTablesLinksAndPicturesBecomePartsOfThePage) {
  WriteFile(std::filesystem::path(testing::TempDir()) / "p.svg", "<svg/>");
  const std::pair<const char*, const char*> cases[] = {
      {"`<b>` & \"a\"", "<p><code>&lt;b&gt;</code> &amp; &quot;a&quot;</p>"},
      {"- a\n- [b](b.md)", "<ul><li>a</li><li><a href=\"b.html\">b</a></li></ul>"},
      {"| x | y |\n| --- | --- |\n| 1 | `2` |", "<th scope=\"col\">y</th>"},
      {"| x | y |\n| --- | --- |\n| 1 | `2` |", "<td class=\"prose\"><code>2</code></td>"},
      {"```console\n$ run <x>\ndone\n```",
       "<pre class=\"console\"><b>$ run &lt;x&gt;\n</b>done\n</pre>"},
      {"![a picture](p.svg)",
       "<p><img src=\"data:image/svg+xml;base64,PHN2Zy8+\" alt=\"a picture\"/></p>"}};
  for (const auto& [markdown, markup] : cases) {
    const std::string page = Read("# T\n\nS\n\n" + std::string(markdown) + "\n").body.markup();
    EXPECT_NE(page.find(markup), page.npos) << page;
  }
}

TEST(Markdown, RowsAreFoundByTheirNames) {
  const ManualText page = Read(
      "# T\n\nS\n\n## A b\n\n| x | y |\n| --- | --- |\n| `k` | one |\n| z | two |\n\n## C\n\n"
      "| x | y |\n| --- | --- |\n| `k` | three |\n");
  ASSERT_EQ(page.rows.size(), 2u);
  EXPECT_EQ(page.rows[0].anchor, "k");
  EXPECT_EQ(page.rows[0].text, "A b k one");
  EXPECT_EQ(page.rows[1].anchor, "c.k");
  EXPECT_EQ(page.sections[1].text, "");
  EXPECT_NE(page.body.markup().find("<tr id=\"c.k\">"), std::string::npos);
}

TEST(Markdown, WhatHasNoPlaceIsNamedWithItsLine) {
  const std::string title = "a.md:1: a page begins with its title: # Title", top = "# T\n\nS\n\n";
  const std::pair<std::string, std::string> cases[] = {
      {"Text.\n", title},
      {"", title},
      {top + "<script>x</script>\n", "a.md:5: no place for html_block"},
      {top + "a <b>c</b>\n", "a.md:5: no place for html_inline"},
      {top + "[c](c.md)\n", "a.md:5: no page"},
      {top + "![a](none.png)\n", "a.md:5: no picture none.png"},
      {top + "#### deep\n", "a.md:5: headings are of second or third order"}};
  for (const auto& [markdown, fault] : cases) {
    try {
      Read(markdown);
      ADD_FAILURE() << markdown;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), fault);
    }
  }
}

}  // namespace
}  // namespace graspbench
