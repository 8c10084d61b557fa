#include "datasets/journal/checked_line.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

std::string FindFault(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    return std::to_string(json.at("schema").get<std::string>().size());
  } catch (const Json::exception& fault) {
    return DescribeJsonFault(fault);
  }
}

TEST(JsonFault, IsSaidInWords) {
  EXPECT_EQ(FindFault("{ bro"), "it is not valid JSON from line 1, column 3 on");
  EXPECT_EQ(FindFault("{\n"), "it is not valid JSON from line 2, column 1 on");
  EXPECT_EQ(FindFault("{\"sch\": 1}"), "its key \"schema\" is missing");
  EXPECT_EQ(FindFault("{\"schema\": 1}"), "a value is not of its type");
  EXPECT_EQ(FindFault("[]"), "a value is not of its type");
}

}  // namespace
}  // namespace graspbench
