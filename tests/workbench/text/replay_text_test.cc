#include "workbench/text/replay_text.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

SessionReplay MakeReplay() {
  SessionReplay replay;
  const auto plan = [](const char* id, int trial) {
    return PlannedTrial{id, "tum", "can", "g2", trial};
  };
  replay.trials = {
      {plan("aaaa", 0), true, false, Outcome::kSuccess, std::nullopt},
      {plan("bbbb", 1), true, true, Outcome::kPushedAway, FieldDifference{"num_steps", "9", "8"}},
      {plan("cccc", 2), false, false, Outcome::kSuccess, std::nullopt}};
  replay.conditions = {8, 8, {"11", "22"}, "11", 0};
  return replay;
}

TEST(ReplayText, NamesTrialFieldAndBothValues) {
  const std::string all = FormatReplay(MakeReplay(), true);
  EXPECT_NE(all.find("aaaa tum-can-g2:0, success: re-simulation matches the record\n"), all.npos);
  const std::string text = FormatReplay(MakeReplay(), false);
  EXPECT_EQ(text.find("aaaa"), text.npos);
  EXPECT_NE(
      text.find("bbbb tum-can-g2:1, pushed away: num_steps differs: recorded 9, now 8; its line "
                "fails its checksum\n"),
      text.npos)
      << text;
  EXPECT_NE(text.find("cccc tum-can-g2:2, success: has no record"), text.npos);
  EXPECT_NE(text.find("same     1 of 3 trials\nphysics  version 8, the same\n"
                      "build    11, recorded with 11, 22\n"),
            text.npos)
      << text;
}

TEST(ReplayText, SaysThatPhysicsOrInputsAreOthers) {
  SessionReplay replay = MakeReplay();
  replay.conditions = {7, 8, {"11"}, "11", 3};
  const std::string text = FormatReplay(replay, false);
  EXPECT_NE(text.find("physics  version 8, recorded with 7: "), text.npos);
  EXPECT_NE(text.find("build    11, the same\n"), text.npos);
  EXPECT_EQ(text.find("inputs"), text.npos) << "every id changes with the physics";
  replay.conditions = {8, 8, {}, "11", 3};
  EXPECT_NE(FormatReplay(replay, false).find("hand, object or grasp of 3 trials have changed"),
            std::string::npos);
}

TEST(ReplayText, TheSameAsJson) {
  const Json json = MakeReplayJson(MakeReplay(), "s");
  EXPECT_EQ(json["num_different"], 1);
  EXPECT_EQ(json["num_missing"], 1);
  EXPECT_EQ(json["trials"][1]["difference"]["field"], "num_steps");
  EXPECT_TRUE(json["trials"][0]["difference"].is_null());
}

}  // namespace
}  // namespace graspbench
