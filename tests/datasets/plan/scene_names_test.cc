#include "datasets/plan/scene_names.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(SceneNamesTest, IdsAndNamesInAnyCase) {
  EXPECT_EQ(FindHandId("TUM"), "tum");
  EXPECT_EQ(FindHandId("Shadow Hand"), "shadow");
  EXPECT_EQ(FindHandId("TUM-Original"), "tum-original");
  EXPECT_EQ(FindObjectId("light bulb"), "light_bulb");
  EXPECT_EQ(FindObjectId("Light-Bulb"), "light_bulb");
  EXPECT_EQ(FindGraspId("power"), "g3");
  EXPECT_EQ(FindGraspId("Two Finger Pinch"), "g4");
  EXPECT_EQ(FindGraspId("G1"), "g1");
}

TEST(SceneNamesTest, WhatIsNoNameStaysAsItIs) {
  for (const char* given : {"all", "best", "mug", "things/can", "/", ""}) {
    EXPECT_EQ(FindHandId(given), given);
    EXPECT_EQ(FindObjectId(given), given);
    EXPECT_EQ(FindGraspId(given), given);
  }
}

TEST(SceneNamesTest, NamesInASessionAreReplaced) {
  SessionConfig config;
  config.hands = {"TUM Hand"};
  config.objects = {"golf ball", "cup"};
  config.grasps = {"power", "my.yaml"};
  ReplaceNames(config);
  EXPECT_EQ(config.hands, std::vector<std::string>{"tum"});
  EXPECT_EQ(config.objects, (std::vector<std::string>{"golf_ball", "cup"}));
  EXPECT_EQ(config.grasps, (std::vector<std::string>{"g3", "my.yaml"}));
}

}  // namespace
}  // namespace graspbench
