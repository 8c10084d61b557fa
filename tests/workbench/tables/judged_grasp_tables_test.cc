#include "workbench/tables/judged_grasp_tables.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(JudgedGraspTables, ALineAProfile) {
  JudgedSummary summary;
  ProfileSummary profile;
  profile.profile = "own";
  profile.num_judged = 2;
  profile.num_passed = 1;
  profile.stages = {{"push -y", 1}};
  summary.profiles = {profile};
  const std::string text = FormatJudged(summary);
  EXPECT_NE(text.find("9.5 to 90.5 %"), std::string::npos) << text;  // Wilson's of 1 of 2
  EXPECT_NE(text.find("push -y"), std::string::npos) << text;
  const Json json = MakeJson(summary);
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0].at("passed"), 1);
  EXPECT_TRUE(json[0].at("kappa").is_null()) << "there are no labels";
}

}  // namespace
}  // namespace graspbench
