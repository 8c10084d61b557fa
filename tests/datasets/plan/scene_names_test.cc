#include "datasets/plan/scene_names.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"

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

class ObjectFoldersTest : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"scans/pear", "scans/banana", "scans/notes", "shapes/cone"}) {
      MakeFolder(top_.path() / name);
      if (std::string(name) == "scans/notes") continue;  // no object
      WriteFile(top_.path() / name / "object.yaml", "");
    }
  }
  std::string Path(const std::string& name) const { return (top_.path() / name).string(); }

  TemporaryFolder top_;
};

TEST_F(ObjectFoldersTest, StandForTheirObjectsByName) {
  EXPECT_EQ(ExpandObjects({Path("scans"), "can", Path("shapes/cone")}),
            (std::vector<std::string>{Path("scans/banana"), Path("scans/pear"), "can",
                                      Path("shapes/cone")}));
  for (const char* other : {"scans/notes", "nowhere"}) {  // refused where they are loaded
    EXPECT_EQ(ExpandObjects({Path(other)}), std::vector<std::string>{Path(other)});
  }
}

TEST_F(ObjectFoldersTest, AllAmongOthersIsTheCatalogue) {
  const std::vector<std::string> objects = ExpandObjects({"all", Path("scans")});
  ASSERT_EQ(objects.size(), 21u + 2u);
  EXPECT_EQ(objects.back(), Path("scans/pear"));
  EXPECT_EQ(ExpandObjects({"all"}), std::vector<std::string>{"all"});
}

TEST_F(ObjectFoldersTest, AreCountedByWhereTheyLie) {
  EXPECT_EQ(DescribeObjectNames({"all"}), "21 objects: 21 of the catalogue");
  EXPECT_EQ(DescribeObjectNames({"can", "a/scans/pear/", "cup", "b/shapes/cone/object.yaml",
                                 "a/scans/banana", "mug"}),
            "6 objects: 2 of the catalogue, 2 of the folder scans, 1 of the folder shapes, "
            "1 of the working folder");
}

}  // namespace
}  // namespace graspbench
