#include "reports/page/html.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include "core/base/random.h"

namespace graspbench {
namespace {

constexpr char kReplacement[] = "\xEF\xBF\xBD";

TEST(Html, TextCannotBecomeMarkup) {
  EXPECT_EQ(Text("</script><img onerror='x'>").markup(),
            "&lt;/script&gt;&lt;img onerror=&#39;x&#39;&gt;");
  EXPECT_EQ(Text("a & b ]]> \"c\"").markup(), "a &amp; b ]]&gt; &quot;c&quot;");
}

TEST(Html, AnAttributeCannotBeLeft) {
  EXPECT_EQ(Element("p", {{"title", "\" onclick=\"x"}}, "").markup(),
            "<p title=\"&quot; onclick=&quot;x\"></p>");
}

TEST(Html, GoodUtf8Stays) {
  EXPECT_EQ(Text("Röthling × 漢字 🖐").markup(), "Röthling × 漢字 🖐");
}

TEST(Html, BadBytesAreReplacedOneByOne) {
  const std::string r = kReplacement;
  EXPECT_EQ(Text("a\xff"
                 "b")
                .markup(),
            "a" + r + "b");
  EXPECT_EQ(Text("\xc3").markup(), r);                          // cut off
  EXPECT_EQ(Text("\xc0\xbc").markup(), r + r);                  // an overlong "<"
  EXPECT_EQ(Text("\xe0\x80\xbc").markup(), r + r + r);          // and a longer one
  EXPECT_EQ(Text("\xed\xa0\x80").markup(), r + r + r);          // a surrogate
  EXPECT_EQ(Text("\xf4\x90\x80\x80").markup(), r + r + r + r);  // beyond U+10FFFF
}

TEST(Html, ControlsAndDirectionMarksAreReplaced) {
  const std::string r = kReplacement;
  EXPECT_EQ(Text(std::string("a\0b\x1b[31m", 8)).markup(), "a" + r + "b" + r + "[31m");
  EXPECT_EQ(Text("can\u202Egpj").markup(), "can" + r + "gpj");
  EXPECT_EQ(Text("\u2066x\u2069\u200F").markup(), r + "x" + r + r);
  EXPECT_EQ(Text("line\n\ttab").markup(), "line\n\ttab");
}

TEST(Html, AnyBytesGiveOneWellFormedElement) {
  RandomStream stream("html", "bytes");
  for (int round = 0; round < 2000; ++round) {
    std::string bytes;
    const int length = stream.NextIndex(40);
    for (int i = 0; i < length; ++i) {
      // Mostly the characters that matter, now and then any byte.
      bytes += stream.NextIndex(3) == 0 ? static_cast<char>(stream.NextIndex(256))
                                        : "<>&\"'/=- a]"[stream.NextIndex(11)];
    }
    const std::string markup = Element("p", {{"title", bytes}}, bytes).markup();
    tinyxml2::XMLDocument document;
    ASSERT_EQ(document.Parse(markup.data(), markup.size()), tinyxml2::XML_SUCCESS) << markup;
    const tinyxml2::XMLElement* p = document.RootElement();
    EXPECT_EQ(p->FirstChildElement(), nullptr) << markup;
    EXPECT_EQ(p->NextSibling(), nullptr) << markup;
    EXPECT_EQ(p->FirstAttribute()->Next(), nullptr) << markup;
  }
}

TEST(Html, VoidElementsAreClosedInTheirTag) {
  EXPECT_EQ(Element("img", {{"alt", "x"}}).markup(), "<img alt=\"x\"/>");
  EXPECT_EQ(Element("td", {}).markup(), "<td></td>");
}

TEST(Html, DataUrisFollowRfc4648) {
  // The RFC's own examples (section 10).
  EXPECT_EQ(MakeDataUri("t/x", ""), "data:t/x;base64,");
  EXPECT_EQ(MakeDataUri("t/x", "f"), "data:t/x;base64,Zg==");
  EXPECT_EQ(MakeDataUri("t/x", "fo"), "data:t/x;base64,Zm8=");
  EXPECT_EQ(MakeDataUri("t/x", "foo"), "data:t/x;base64,Zm9v");
  EXPECT_EQ(MakeDataUri("t/x", "foobar"), "data:t/x;base64,Zm9vYmFy");
  EXPECT_EQ(MakeDataUri("t/x", "\xff\xfe\xfd"), "data:t/x;base64,//79");
}

}  // namespace
}  // namespace graspbench
