#include "datasets/analysis/campaign/headrooms.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

/** A scene of which step 2 recorded these shares of 2 N and 2.5 N. */
SceneRecord MakeScene(const std::string& hand, double start, double after, bool is_taken) {
  SceneRecord scene;
  scene.config.hand = hand;
  scene.result = {{"target_step",
                   {{"taken", is_taken},
                    {"headroom_before", {{"bound_n", 2.0}, {"share", start}}},
                    {"headroom_after", {{"bound_n", 2.5}, {"share", after}}}}}};
  return scene;
}

TEST(Headrooms, OfAKeptStartIsTheStarts) {
  const Answer<SceneHeadroom> kept = FindHeadroom(MakeScene("tum", 0.6, 0.9, false));
  ASSERT_TRUE(kept) << kept.reason();
  EXPECT_EQ(kept->kept_share, 0.6);
  EXPECT_EQ(kept->kept_bound, 2.0);
  const Answer<SceneHeadroom> taken = FindHeadroom(MakeScene("tum", 0.6, 0.9, true));
  ASSERT_TRUE(taken) << taken.reason();
  EXPECT_EQ(taken->start_share, 0.6);
  EXPECT_EQ(taken->kept_share, 0.9);
  EXPECT_EQ(taken->kept_bound, 2.5);
}

// TUM: starts 0.5, 0.8, 1.6: median 0.8, 1 / 0.8 = 1.25; kept 0.75, 0.8, 1.6. Shadow reaches
// beneath.
TEST(Headrooms, MediansAreOfEachHandsScenes) {
  Campaign campaign;
  campaign.scenes = {MakeScene("tum", 0.5, 0.75, true), MakeScene("tum", 0.8, 0.9, false),
                     MakeScene("shadow", 1.1, 1.2, true), MakeScene("tum", 1.6, 0.1, false)};
  const std::vector<Headrooms> hands = ListHeadrooms(campaign);
  ASSERT_EQ(hands.size(), 2u);
  EXPECT_EQ(hands[0].hand, "tum");
  EXPECT_EQ(hands[0].num_scenes, 3);
  EXPECT_EQ(hands[0].median_start, 0.8);
  EXPECT_EQ(hands[0].median_kept, 0.8);
  EXPECT_EQ(DescribeHeadrooms(hands[0]),
            "step 2 starts from grasps that bear 0.80 of what friction and grip allow by an "
            "object's sides and keeps grasps that bear 0.80 (medians of 3 scenes): at equal grip "
            "no grasp by the sides is more than 1.25 times as strong as the median start; one that "
            "reaches beneath the object may be");
  EXPECT_EQ(hands[1].num_scenes, 1);
  const std::string text = DescribeHeadrooms(hands[1]);
  EXPECT_NE(text.find("(medians of 1 scene): the median start is as strong as any"),
            std::string::npos)
      << text;
}

TEST(Headrooms, WhereNothingIsKnownTheReasonStandsThere) {
  Campaign campaign;
  SceneRecord scene;
  scene.config.hand = "tum";
  campaign.scenes.push_back(scene);
  EXPECT_EQ(FindHeadroom(scene).reason(), "the scene is not finished");
  scene.result = {{"pregrasp_step", {}}};
  campaign.scenes.push_back(scene);
  EXPECT_EQ(FindHeadroom(scene).reason(), "step 2 was not run");
  scene.result = {{"target_step", {{"taken", false}}}};
  EXPECT_EQ(FindHeadroom(scene).reason(), "no headroom is recorded");
  Json& step = scene.result["target_step"];
  step["headroom_before"] = {{"bound_n", nullptr}, {"share", nullptr}};
  campaign.scenes.push_back(scene);
  EXPECT_EQ(FindHeadroom(scene).reason(), "the start held nothing");
  step["headroom_before"] = {{"bound_n", 0.0}, {"share", nullptr}};
  EXPECT_EQ(FindHeadroom(scene).reason(), "the grip does not bear the weight by friction");
  EXPECT_EQ(DescribeHeadrooms(ListHeadrooms(campaign).at(0)),
            "headroom not known: 3 scenes without a figure (step 2 was not run; the scene is not "
            "finished; the start held nothing)");
}

}  // namespace
}  // namespace graspbench
