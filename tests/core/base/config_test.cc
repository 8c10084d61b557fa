#include "core/base/config.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

struct Inner {
  double size = 0.5;
  bool is_round = false;

  template <class V>
  void Visit(V&& v) {
    v("size_m", size);
    v("is_round", is_round);
  }
};

struct Outer {
  std::string name = "thing";
  std::vector<std::string> parts = {"a", "b"};
  int count = 3;
  Inner inner;

  template <class V>
  void Visit(V&& v) {
    v("name", name);
    v("parts", parts);
    v("count", count);
    v("inner", inner);
  }
};

constexpr char kDefaults[] =
    R"({"name":"thing","parts":["a","b"],"count":3,"inner":{"size_m":0.5,"is_round":false}})";

std::string FindSettingProblem(const std::string& assignment) {
  Outer config;
  try {
    SetConfigValue(assignment, config);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUsage);
    return e.what();
  }
  return "";
}

TEST(Config, IsWrittenWithEveryDefaultInTheOrderOfTheFields) {
  EXPECT_EQ(ConfigToJson(Outer()).dump(), kDefaults);
  EXPECT_EQ(ListConfigKeys(Outer()),
            (std::vector<std::string>{"name", "parts", "count", "inner.size_m", "inner.is_round"}));
}

TEST(Config, JsonIsReadBackAsItWasWritten) {
  Outer config;
  config.name = "\"\n\u00e9";
  config.inner.size = 0.1 + 0.2;
  config.inner.is_round = true;
  config.parts = {};
  Diagnostics problems;
  const Json json = ConfigToJson(config);
  EXPECT_EQ(ConfigToJson(ConfigFromJson<Outer>(Json::parse(json.dump()), "f", problems)), json);
  EXPECT_EQ(problems.Format(), "");
}

TEST(Config, TellsEveryWrongTypeInJson) {
  Diagnostics problems;
  ConfigFromJson<Outer>(
      Json::parse(
          R"({"name":1,"parts":[2],"count":3000000000,"inner":{"size_m":"1","is_round":0}})"),
      "f", problems);
  EXPECT_EQ(problems.Format(),
            "f: error: name: expected a text\n"
            "f: error: parts: expected a list of texts\n"
            "f: error: count: expected a whole number\n"
            "f: error: inner.size_m: expected a number\n"
            "f: error: inner.is_round: expected true or false");
}

TEST(Config, SettingsReachInnerValues) {
  Outer config;
  SetConfigValue("inner.is_round=true", config);
  SetConfigValue("name=a=b", config);
  EXPECT_TRUE(config.inner.is_round);
  EXPECT_EQ(config.inner.size, 0.5);
  EXPECT_EQ(config.name, "a=b");
  EXPECT_EQ(FindSettingProblem("inner.is_round=maybe"),
            "--set \"inner.is_round=maybe\": inner, is_round: expected true or false");
  EXPECT_EQ(FindSettingProblem("inner.sise_m=1"),
            "--set \"inner.sise_m=1\": no setting \"inner.sise_m\"; did you mean "
            "\"inner.size_m\"? Known: inner.size_m, inner.is_round");
  EXPECT_EQ(FindSettingProblem("inner=1"),
            "--set \"inner=1\": no setting \"inner\". Known: inner.size_m, inner.is_round");
}

TEST(Config, DifferencesNameTheKeyAndBothValues) {
  Outer a, b;
  b.parts = {"a"};
  b.inner.size = 0.25;
  EXPECT_EQ(FindConfigDifferences(a, b), (std::vector<std::string>{R"(parts: ["a","b"] and ["a"])",
                                                                   "inner.size_m: 0.5 and 0.25"}));
  EXPECT_TRUE(FindConfigDifferences(a, a).empty());
}

TEST(Config, FindsTheLineOfAKey) {
  const YAML::Node root = YAML::Load("name: x\ninner:\n  size_m: 1\n");
  EXPECT_EQ(FindConfigLine(root, "name"), 1);
  EXPECT_EQ(FindConfigLine(root, "inner.size_m"), 3);
  EXPECT_EQ(FindConfigLine(root, "inner.is_round"), 0);
  EXPECT_EQ(FindConfigLine(root, "name.size_m"), 0);
}

}  // namespace
}  // namespace graspbench
