#include "datasets/grasps/json_values.h"

#include <gtest/gtest.h>

#include "tests/datasets/grasps/grasp_cases.h"

namespace graspbench {
namespace {

TEST(JsonValues, SayWhere) {
  EXPECT_NE(FindGraspError([] { ParseJsonObject("{\"a\": 1,}", "f"); }).find("line 1, column"),
            std::string::npos);
  EXPECT_NE(FindGraspError([] { ParseJsonObject("[1]", "f"); }).find("f holds no JSON object"),
            std::string::npos);
  EXPECT_NE(FindGraspError([] { GetJson(Json::array(), "a", "f"); }).find("\"a\" is missing"),
            std::string::npos);
  EXPECT_NE(FindGraspError([] {
              ReadJsonNumbers(Json::parse("[1, null]"), "f: x");
            }).find("f: x[1]: expected a finite number"),
            std::string::npos);
  EXPECT_EQ(ReadJsonNumbers(Json::parse("[1, 2.5]"), "x", 2), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(ReadJsonLabels(Json::parse("[true, 0, 1.0]"), "x", 3),
            (std::vector<bool>{true, false, true}));
}

}  // namespace
}  // namespace graspbench
