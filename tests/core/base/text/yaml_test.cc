#include "core/base/text/yaml.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/base/files/files.h"

namespace graspbench {
namespace {

class YamlTest : public testing::Test {
 protected:
  std::string Write(const std::string& text) {
    // Tests run in parallel: a file of its own for each.
    const auto path = std::filesystem::path(testing::TempDir()) /
                      testing::UnitTest::GetInstance()->current_test_info()->name();
    WriteFileAtomically(path, text);
    return path.string();
  }
  Diagnostics problems_;
};

TEST_F(YamlTest, ReadsValuesAndKeepsDefaults) {
  const std::string path = Write("mass_kg: 0.5\nsize_m: [1, 2, 3]\n");
  YamlMap map(LoadYaml(path, problems_), "f", "object", problems_);
  double mass = 0.0, density = 7.0;
  Eigen::Vector3d size;
  map.Read("mass_kg", mass);
  map.Read("density", density, Needed::kNo);
  map.Read("size_m", size);
  map.FinishKnownKeys();
  EXPECT_EQ(problems_.num_errors(), 0) << problems_.Format();
  EXPECT_EQ(mass, 0.5);
  EXPECT_EQ(density, 7.0);
  EXPECT_EQ(size, Eigen::Vector3d(1, 2, 3));
}

// YAML takes what follows " #" for a comment.
TEST_F(YamlTest, AKeyWithoutValueIsTold) {
  const std::string path = Write("name: ball\ncolour: #ff00ff\n");
  YamlMap map(LoadYaml(path, problems_), "o.yaml", "object", problems_);
  std::string name, colour = "red";
  map.Read("name", name);
  map.Read("colour", colour, Needed::kNo);
  EXPECT_EQ(problems_.num_errors(), 1);
  EXPECT_NE(
      problems_.Format().find("o.yaml:2: error: object, colour: the value is missing; one that "
                              "begins with # needs quotes"),
      std::string::npos)
      << problems_.Format();
}

TEST_F(YamlTest, ReportsEveryProblemWithItsLine) {
  const std::string path = Write("mass_kg: heavy\nsize_m: [1, .nan, 3]\nmu_statc: 0.3\n");
  YamlMap map(LoadYaml(path, problems_), "o.yaml", "object", problems_);
  double mass = 0.0, mu = 0.0;
  Eigen::Vector3d size;
  map.Read("mass_kg", mass);
  map.Read("size_m", size);
  map.Read("mu_static", mu);
  map.FinishKnownKeys();
  EXPECT_EQ(problems_.Format(),
            "o.yaml:1: error: object, mass_kg: expected a finite number\n"
            "o.yaml:2: error: object, size_m: expected three finite numbers in brackets\n"
            "o.yaml:1: error: object: the key \"mu_static\" is missing\n"
            "o.yaml:3: error: object: unknown key \"mu_statc\"; did you mean \"mu_static\"? "
            "Known: mass_kg, size_m, mu_static");
}

TEST_F(YamlTest, AKeyGivenTwiceIsToldWithItsLine) {
  YamlMap map(ParseYaml("size: 1\nsize: 2\n", "o.yaml", problems_), "o.yaml", "object", problems_);
  double size = 0.0;
  map.Read("size", size);
  map.FinishKnownKeys();
  EXPECT_EQ(problems_.Format(), "o.yaml:2: error: object: \"size\" is given twice");
}

TEST_F(YamlTest, WhatIsNestedTooDeepIsToldSo) {
  const std::string deep = "a:\n  " + std::string(10000, '[') + std::string(10000, ']');
  EXPECT_TRUE(ParseYaml(deep, "o.yaml", problems_).IsNull());
  const std::string text = problems_.Format();
  EXPECT_EQ(text.find("o.yaml:2: error: nested deeper than "), 0u) << text;
  EXPECT_NE(text.find(" levels; expected fewer"), std::string::npos) << text;
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
