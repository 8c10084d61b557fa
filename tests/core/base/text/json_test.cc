#include "core/base/text/json.h"

#include <gtest/gtest.h>

#include <limits>

namespace graspbench {
namespace {

/** What is wrong, without the code in front of it; empty: nothing. */
template <class Use>
std::string FindFault(Use use) {
  try {
    use();
  } catch (const Json::exception& fault) {
    const std::string text = fault.what();
    return text.substr(text.find("] ") + 2);
  }
  return "";
}

// RFC 8259, sections 3 to 7.
TEST(Json, ReadsWhatTheStandardAllows) {
  const Json json = Json::parse(
      " { \"b\" : [ 1 , -2, 2.5e1, true, false, null ] "
      ",\n\"a\":{\"\":\"\\u00e4\\n\\/\\ud834\\udd1e\"} } ");
  EXPECT_EQ(json.dump(), "{\"b\":[1,-2,25.0,true,false,null],\"a\":{\"\":\"ä\\n/𝄞\"}}");
  EXPECT_EQ(json.at("b").at(1).get<int>(), -2);
  EXPECT_EQ(json.at("b")[2].get<double>(), 25.0);
  EXPECT_TRUE(json.at("b").at(3).get<bool>());
  EXPECT_TRUE(json.at("b").back().is_null());
  EXPECT_EQ(Json::parse("{\"a\":1,\"b\":2,\"a\":3}").dump(), "{\"a\":3,\"b\":2}");
  for (const char* text : {"", "{", "[1,]", "{\"a\"}", "{a:1}", "01", "1.", "+1", "nul", "\"\n\"",
                           "\"\\x\"", "\"\xff\"", "\"\\ud834\"", "[1] 2", "NaN", "'a'"}) {
    EXPECT_TRUE(Json::try_parse(text).is_discarded()) << text;
  }
  const std::string fault = FindFault([] { Json::parse("[1,\n x]"); });
  EXPECT_EQ(fault.substr(0, 36), "parse error at line 2, column 2: syn");
}

TEST(Json, WritesNumbersThatReadBackTheSame) {
  for (const double value : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, 123456789.0, -0.0}) {
    EXPECT_EQ(Json::parse(Json(value).dump()).get<double>(), value);
  }
  EXPECT_EQ(Json(0.1).dump(), "0.1");
  EXPECT_EQ(Json(2.0).dump(), "2.0");
  EXPECT_EQ(Json(2).dump(), "2");
  EXPECT_EQ(Json(1e-7).dump(), "1e-07");
  EXPECT_EQ(Json(std::numeric_limits<long>::min()).dump(), "-9223372036854775808");
  EXPECT_EQ(Json(std::numeric_limits<unsigned long>::max()).dump(), "18446744073709551615");
  EXPECT_EQ(Json(std::nan("")).dump(), "null");
  EXPECT_TRUE(JsonNumber(std::nan("")).is_null());
  EXPECT_TRUE(std::isnan(NumberFrom(nullptr)));
}

TEST(Json, WritesTextsOnOneLineAndIndented) {
  EXPECT_EQ(Json("a\"\\\b\f\n\r\t\x01\x7f").dump(), "\"a\\\"\\\\\\b\\f\\n\\r\\t\\u0001\x7f\"");
  EXPECT_EQ(FormatJson("a\xff"), "\"a\xEF\xBF\xBD\"");  // U+FFFD
  const Json json = {{"z", {1, {{"a", Json::array()}}}}, {"b", Json::object()}};
  EXPECT_EQ(FormatJson(json), "{\"z\":[1,{\"a\":[]}],\"b\":{}}");
  EXPECT_EQ(FormatJson(json, 2),
            "{\n  \"z\": [\n    1,\n    {\n      \"a\": []\n    }\n  ],\n  \"b\": {}\n}");
}

TEST(Json, BracesMakeObjectsOfPairsAndListsOfTheRest) {
  EXPECT_EQ(Json({{"a", 1}, {"b", {{"c", true}}}}).dump(), "{\"a\":1,\"b\":{\"c\":true}}");
  EXPECT_EQ(Json({"a", "b"}).dump(), "[\"a\",\"b\"]");
  EXPECT_EQ(Json({{1, 2}, {3, 4}}).dump(), "[[1,2],[3,4]]");
  EXPECT_EQ(Json({{"a", {}}}).dump(), "{\"a\":null}");
  EXPECT_EQ(Json::array({{"a", 1}}).dump(), "[[\"a\",1]]");
  EXPECT_EQ(Json(std::vector<bool>{true, false}).dump(), "[true,false]");
  EXPECT_EQ(Json(std::map<std::string, int>{{"b", 1}, {"a", 2}}).dump(), "{\"a\":2,\"b\":1}");
}

TEST(Json, ChangesInPlace) {
  Json json;
  json["list"].push_back(1);
  json["list"].push_back({{"a", 1}});
  json["list"][1]["a"] = "x";
  json.update({{"b", 2}, {"list", 3}});
  json.emplace("b", 4);
  EXPECT_EQ(json.dump(), "{\"list\":3,\"b\":2}");
  json.erase("list");
  json.erase("unknown");
  EXPECT_EQ(json, (Json{{"b", 2}}));
  json = {{"outer", {{"inner", {1}}}}};
  json = json.at("outer");  // a part of itself
  json = std::move(json["inner"]);
  EXPECT_EQ(json.dump(), "[1]");
  for (Json& item : json) item = 5;
  EXPECT_EQ(json.front(), 5);
}

TEST(Json, ComparesNumbersByValueAndObjectsInOrder) {
  EXPECT_EQ(Json::parse("[1, -1, 1.5]"), Json({1.0, -1, 1.5}));
  EXPECT_NE(Json(1), Json("1"));
  EXPECT_NE(Json(1), Json(true));
  EXPECT_NE(Json(), Json::array());
  EXPECT_NE(Json({{"a", 1}, {"b", 2}}), Json({{"b", 2}, {"a", 1}}));
}

TEST(Json, SaysWhatAValueIsNot) {
  const Json json = {{"text", "t"}, {"list", {1}}, {"number", 1.5}};
  const auto fault = [&](auto use) { return FindFault([&] { use(json); }); };
  EXPECT_EQ(fault([](const Json& j) { j.at("x"); }), "key 'x' not found");
  EXPECT_EQ(fault([](const Json& j) { j.at(0); }), "cannot use at() with object");
  EXPECT_EQ(fault([](const Json& j) { j["list"].at(1); }), "array index 1 is out of range");
  EXPECT_EQ(fault([](const Json& j) { j["list"]["x"]; }),
            "cannot use operator[] with a string argument with array");
  EXPECT_EQ(fault([](const Json& j) { j["text"].get<double>(); }),
            "type must be number, but is string");
  EXPECT_EQ(fault([](const Json& j) { j["number"].get<std::string>(); }),
            "type must be string, but is number");
  EXPECT_EQ(fault([](const Json& j) { j["list"].value("x", 1); }), "cannot use value() with array");
  EXPECT_EQ(fault([](const Json& j) { j["list"].items(); }), "type must be object, but is array");
  EXPECT_THROW(IntFrom(json["number"]), Error);
  EXPECT_THROW(IntFrom(4294967296), Error);
}

TEST(Json, ManyLevelsDoNotOverflowTheStack) {
  constexpr size_t kDepth = 1000000;
  Json json = Json::parse(std::string(kDepth, '[') + std::string(kDepth, ']'));
  const Json moved = std::move(json);
  EXPECT_EQ(moved.size(), 1u);
}

}  // namespace
}  // namespace graspbench
