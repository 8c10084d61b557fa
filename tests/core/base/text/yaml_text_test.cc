#include "core/base/text/yaml_text.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

namespace graspbench {
namespace {

TEST(QuoteYaml, QuotesNames) {
  EXPECT_EQ(QuoteYaml("a \"b\" \\ ü: #"), R"("a \"b\" \\ ü: #")");
  EXPECT_EQ(QuoteYaml("a\xff"), "\"a\ufffd\"");
}

TEST(FormatYamlWord, LeavesWordsAlone) {
  for (const char* word : {"golf_ball", "new-target", "TH", "rh_FFJ1.2"}) {
    EXPECT_EQ(FormatYamlWord(word), word);
  }
}

// The reader of another hand is the judge, as a value, in a list and as a key.
TEST(FormatYamlWord, IsReadAsTheSameText) {
  for (const std::string text :
       {"",         "a: b",       "a #b", "- a", "=1+1",     "*a",  "&a",  "!a",   "{a",
        "[a]",      "a]",         "a, b", "%a",  "@a",       "`a",  "'a",  "\"a",  "a\nb: c",
        "\x1b[31m", "null",       "Null", "~",   "true",     "No",  "1.5", "0x1f", "1e3",
        ".nan",     "2026-01-01", "a\\",  " a ", "\u202eab", "---", "..."}) {
    const std::string word = FormatYamlWord(text);
    const YAML::Node node = YAML::Load("{" + word + ": [" + word + ", " + word + "]}");
    ASSERT_EQ(node.size(), 1u) << word;
    EXPECT_EQ(node.begin()->first.as<std::string>(), text);
    EXPECT_EQ(node.begin()->second[1].as<std::string>(), text);
    EXPECT_FALSE(node.begin()->second[0].IsNull()) << word;
    EXPECT_EQ(YAML::Load("a: " + word)["a"].as<std::string>(), text);
  }
}

}  // namespace
}  // namespace graspbench
