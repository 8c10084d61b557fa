#include "workbench/shell/shell_cards.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace graspbench {

namespace {

/** The numbers of a table's column, counted in words from the left. */
std::vector<double> ReadColumn(const std::string& table, size_t column) {
  std::vector<double> values;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);  // the head
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string word;
    for (size_t i = 0; i <= column; ++i) words >> word;
    values.push_back(std::stod(word));
  }
  return values;
}

class ShellCards : public testing::Test {
 protected:
  ShellCards() { scene_.Choose(SceneChoice::MakeDefault()); }
  ShellScene scene_;
};

TEST_F(ShellCards, ContactsAddUpToTheGrip) {
  EXPECT_EQ(FormatContacts(scene_), "the hand does not touch the object\n");
  while (scene_.notes().phase < Phase::kHold) scene_.Advance();
  const std::string card = FormatContacts(scene_);
  double sum = 0.0;
  for (const double force : ReadColumn(card, 2)) sum += force;
  EXPECT_NEAR(sum, scene_.notes().report.grip_force, 0.005) << card;
  for (const double share : ReadColumn(card, 4)) EXPECT_LE(share, 100.1) << card;
}

TEST_F(ShellCards, TimingIsThatOfTheResult) {
  EXPECT_EQ(FormatTiming(scene_), "closure has not begun\n");
  while (scene_.Advance()) {
  }
  const TrialResult result = scene_.course().End();
  char expected[100];
  std::snprintf(expected, sizeof expected, "GCT %.1f ms, GFT %.1f ms", 1e3 * result.timing.gct,
                1e3 * result.timing.gft);
  EXPECT_NE(FormatTiming(scene_).find(expected), std::string::npos) << FormatTiming(scene_);
}

TEST_F(ShellCards, JointsStandWithinTheirLimits) {
  scene_.Advance();
  const std::string card = FormatJoints(scene_);
  const std::vector<double> angles = ReadColumn(card, 1);
  const Eigen::VectorXd& q = scene_.course().world().state().q;
  ASSERT_EQ(angles.size(), static_cast<size_t>(q.size()));
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    EXPECT_NEAR(angles[static_cast<size_t>(j)], q[j] * 180.0 / M_PI, 0.051) << card;
  }
}

class GraspCards : public testing::Test {
 protected:
  GraspCards() {
    SceneChoice choice = SceneChoice::MakeDefault();
    choice.config.grasps = {"g1"};
    choice.config.strategy = StrategyConfig();  // by posture: all three digits press
    scene_.Choose(choice);
  }
  ShellScene scene_;
};

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
