#include "workbench/tables/foreign_grasp_tables.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"

namespace graspbench {

namespace {

ForeignGrasp MakeGrasp(double scale, std::optional<bool> label) {
  ForeignGrasp grasp;
  grasp.source = "a.npy";
  grasp.index = 3;
  grasp.format = "made";
  grasp.object = "mug";
  grasp.scale = scale;
  grasp.label = label;
  grasp.stages = {{"grasp", Pose::Identity(), {}}};
  grasp.assumptions = {"the mesh is drawn in metres"};
  return grasp;
}

TEST(ForeignGraspTables, SaysWhatIsThereAndWhatIsNot) {
  GraspCollection collection;
  collection.num_files = 3;
  collection.grasps = {MakeGrasp(0.1, true), MakeGrasp(0.2, false), MakeGrasp(0.1, std::nullopt)};
  collection.unread = {{"b.npy", "b.npy is empty"}};
  EXPECT_EQ(FormatGraspCollection(collection),
            "format  hand        object  grasps  scale       stages  labels\n"
            "made    not stated  mug          3  0.1 to 0.2  grasp   1 pass, 1 fail\n"
            "\n"
            "assumed for 3 grasps: the mesh is drawn in metres\n"
            "2 of 3 files read, 3 grasps\n"
            "not read: b.npy is empty\n");
  const Json json = MakeJson(collection);
  EXPECT_EQ(json["grasps"][1]["label"], false);
  EXPECT_TRUE(json["grasps"][2]["label"].is_null());
  EXPECT_EQ(json["unread"][0]["file"], "b.npy");
}

TEST(ForeignGraspTables, EveryGraspIsTriedOnTheHand) {
  const std::vector<UnmappedGrasp> unmapped = FindUnmapped({MakeGrasp(0.1, true)}, LoadHand("tum"));
  ASSERT_EQ(unmapped.size(), 1u);
  EXPECT_EQ(unmapped[0].name, "a.npy, grasp 3");
  EXPECT_NE(unmapped[0].reason.find("by --open"), std::string::npos);
}

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
