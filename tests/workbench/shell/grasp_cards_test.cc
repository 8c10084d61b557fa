#include "workbench/shell/grasp_cards.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace graspbench {
namespace {

class GraspCards : public testing::Test {
 protected:
  GraspCards() {
    SceneChoice choice = SceneChoice::MakeDefault();
    choice.config.strategy = StrategyConfig();  // by posture: all three digits press
    scene_.Choose(choice);
  }
  ShellScene scene_;
};

TEST_F(GraspCards, WithoutContactsThereIsNoWrenchSpace) {
  EXPECT_EQ(FormatWrenchSpace(scene_).find("no wrench space: "), 0u);
}

// Held by three digits the ball can be pulled in every direction.
TEST_F(GraspCards, AHeldBallIsInForceClosure) {
  while (scene_.Advance()) {
  }
  const std::string text = FormatWrenchSpace(scene_);
  EXPECT_EQ(text.find("no force closure"), std::string::npos) << text;
  EXPECT_NE(text.find("force +x"), std::string::npos) << text;
  EXPECT_NE(text.find("moment -z"), std::string::npos) << text;
  double epsilon = 0.0;
  std::istringstream(text.substr(text.find(' '))) >> epsilon;
  EXPECT_GT(epsilon, 0.0);
}

// The thumb has no distance to itself; closing brings the others nearer to it.
TEST_F(GraspCards, TheTargetPostureIsNarrowerThanThePreGrasp) {
  const auto read = [&](const char* posture) {
    std::istringstream lines(FormatPads(scene_, posture));
    std::vector<double> openings;
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("FF", 0) != 0 && line.rfind("MF", 0) != 0) continue;
      std::istringstream words(line);
      std::string word;
      for (int i = 0; i < 8; ++i) words >> word;  // id, place, facing, opening
      openings.push_back(std::stod(word));
    }
    return openings;
  };
  const std::vector<double> pre = read("pre"), target = read("target");
  ASSERT_EQ(pre.size(), 2u);
  ASSERT_EQ(target.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_LT(target[i], pre[i]);
    EXPECT_GT(pre[i], 40.0);  // a golf ball is 43 mm wide
  }
}

}  // namespace
}  // namespace graspbench
