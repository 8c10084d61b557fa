#include "workbench/experiments/grasp_inputs.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/hand/load_hand.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"
#include "tests/datasets/session/fake_session.h"
#include "tests/workbench/experiments/pinch_inputs.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

TEST(GraspInputs, AMeshIsFoundByAnyEndOfItsPath) {
  const TemporaryFolder folder;
  const fs::path mesh = folder.path() / "core_mug" / "mesh" / "simplified.obj";
  MakeFolder(mesh.parent_path());
  WriteFile(mesh, "");
  WriteFile(folder.path() / "cube.obj", "");
  EXPECT_EQ(FindObjectMesh(folder.path(), "assets/object/DGN/core_mug"), mesh);
  EXPECT_EQ(FindObjectMesh(folder.path(), "/data/core_mug/mesh/simplified.obj"), mesh);
  EXPECT_EQ(FindObjectMesh(folder.path(), "core_mug/"), mesh);
  EXPECT_EQ(FindObjectMesh(folder.path(), "cube"), folder.path() / "cube.obj");
  EXPECT_EQ(FindObjectMesh(folder.path(), "../cube.obj"), folder.path() / "cube.obj");
  EXPECT_EQ(FindObjectMesh(folder.path(), "mug"), fs::path());
  const fs::path parts = folder.path() / "core-bottle-1a7" / "coacd" / "decomposed.obj";
  MakeFolder(parts.parent_path());
  WriteFile(parts, "");
  EXPECT_EQ(FindObjectMesh(folder.path(), "core-bottle-1a7"), parts);  // of DexGraspNet
  EXPECT_EQ(FindObjectMesh(folder.path(), ""), fs::path());
  // Which of two is meant, nobody can say.
  WriteFile(folder.path() / "core_mug.stl", "");
  EXPECT_THROW(FindObjectMesh(folder.path(), "core_mug"), Error);
  EXPECT_EQ(FindObjectMesh(folder.path(), "core_mug/mesh/simplified.obj"), mesh);
}

ForeignGrasp MakeForeign(const std::string& object) {
  ForeignGrasp grasp;
  grasp.source = "a.npy";
  grasp.object = object;
  grasp.scale = 0.05;
  grasp.root_link = "palm";
  grasp.joint_names = {"FFJ9"};
  grasp.stages = {{"grasp", Pose::Identity(), {0.0}}};
  return grasp;
}

TEST(GraspInputs, WhatTheHandCannotDoIsNamed) {
  const TemporaryFolder folder;
  WriteFile(folder.path() / "cube.obj", FormatObj(MakeRoundedBox({1.0, 1.0, 1.0}, 0.0), 1.0));
  GraspCollection collection;
  collection.grasps = {MakeForeign("cube")};
  try {
    LoadGraspInputs(collection, "shadow", folder.path(), {FreeSpaceProfile()});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a.npy, grasp 0"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("FFJ9"), std::string::npos) << error.what();
  }
}

/** Of the Shadow Hand, with all its joints at 0. */
ForeignGrasp MakeOpen(const Hand& hand, int index, const std::string& object) {
  ForeignGrasp grasp = MakeForeign(object);
  grasp.index = index;
  grasp.joint_names.clear();
  for (const HandJoint& joint : hand.joints) grasp.joint_names.push_back(joint.name);
  grasp.stages[0].joints.assign(hand.joints.size(), 0.0);
  return grasp;
}

TEST(GraspInputs, WhatAVerdictDependsOnIsInTheDescription) {
  const TemporaryFolder folder;
  WriteFile(folder.path() / "cube.obj", FormatObj(MakeRoundedBox({1.0, 1.0, 1.0}, 0.0), 1.0));
  const Hand hand = LoadHand("shadow");
  const auto describe = [&](const ForeignGrasp& grasp) {
    GraspCollection collection;
    collection.grasps = {grasp};
    return FormatJson(
        LoadGraspInputs(collection, "shadow", folder.path(), {FreeSpaceProfile()}).description);
  };
  const ForeignGrasp grasp = MakeOpen(hand, 0, "cube");
  ForeignGrasp moved = grasp, bent = grasp, labelled = grasp;
  moved.stages[0].X_OR.translation().x() += 1e-9;
  bent.stages[0].joints.back() += 1e-9;
  labelled.label = false;
  EXPECT_EQ(describe(grasp), describe(grasp));
  for (const ForeignGrasp& other : {moved, bent, labelled}) {
    EXPECT_NE(describe(other), describe(grasp));
  }
}

TEST(GraspInputs, AMeshThatIsOfNoUseDoesNotStopTheOthers) {
  const TemporaryFolder folder;
  WriteFile(folder.path() / "cube.obj", FormatObj(MakeRoundedBox({1.0, 1.0, 1.0}, 0.0), 1.0));
  WriteFile(folder.path() / "open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Hand hand = LoadHand("shadow");
  GraspCollection collection;
  collection.grasps = {MakeOpen(hand, 0, "open"), MakeOpen(hand, 1, "cube"),
                       MakeOpen(hand, 2, "nowhere")};
  collection.grasps.push_back(MakeOpen(hand, 3, "cube"));
  collection.grasps.back().stages[0].name = "pregrasp";
  const GraspInputs inputs =
      LoadGraspInputs(collection, "shadow", folder.path(), {FreeSpaceProfile()});
  ASSERT_EQ(inputs.grasps.size(), 1u);
  EXPECT_EQ(inputs.grasps[0].grasp.index, 1);
  ASSERT_EQ(inputs.unread.size(), 3u);
  for (const UnreadFile& file : inputs.unread) {
    EXPECT_EQ(file.reason.find(folder.path().string()), std::string::npos)
        << "a result holds no path of a machine: " << file.reason;
  }
  EXPECT_NE(inputs.unread[0].reason.find("open.obj"), std::string::npos);
  EXPECT_NE(inputs.unread[1].reason.find("no mesh for \"nowhere\""), std::string::npos);
  EXPECT_NE(inputs.unread[2].reason.find("states only the open hand"), std::string::npos);
  FreeSpaceProfile closing;
  closing.closing.to = "limits";
  const auto count = [&](const std::vector<FreeSpaceProfile>& profiles) {
    return LoadGraspInputs(collection, "shadow", folder.path(), profiles).grasps.size();
  };
  EXPECT_EQ(count({closing}), 2u) << "it closes the open hand";
  FreeSpaceProfile stated;
  stated.name = "stated";
  const GraspInputs both = LoadGraspInputs(collection, "shadow", folder.path(), {closing, stated});
  ASSERT_EQ(both.grasps.size(), 2u) << "the first profile judges it";
  EXPECT_EQ(both.grasps[1].unfit, std::set<size_t>{1});
  ASSERT_EQ(both.unread.size(), 3u);
  EXPECT_EQ(both.unread[2].name, "profile stated");
  EXPECT_EQ(both.unread[2].reason.find("does not fit 1 of 2 grasps: the file states only the open"),
            0u);
  EXPECT_THROW(FindGraspInput(both, 1), Error) << "one profile does not fit";
}

TEST(GraspInputs, TwoGraspsOfOneNameAreRefused) {
  const TemporaryFolder folder;
  WriteFile(folder.path() / "cube.obj", FormatObj(MakeRoundedBox({1.0, 1.0, 1.0}, 0.0), 1.0));
  const Hand hand = LoadHand("shadow");
  GraspCollection collection;
  collection.grasps = {MakeOpen(hand, 0, "cube"), MakeOpen(hand, 0, "cube")};
  EXPECT_THROW(LoadGraspInputs(collection, "shadow", folder.path(), {FreeSpaceProfile()}), Error);
}

// 1 mm and 1 degree: the verdict of a firm grasp stays, the course does not.
TEST(GraspInputs, DisturbancesDifferAndAreTheSameAgain) {
  const GraspInputs inputs = MakePinchInputs();
  const FreeSpaceProfile profile = MakePinchProfile();
  const auto judge = [&](int jitter) {
    return FormatJson(
        RecordToJson(JudgeGraspInput(inputs, inputs.grasps.front(), profile, jitter)));
  };
  EXPECT_EQ(judge(1), judge(1));
  EXPECT_NE(judge(1), judge(0));
  EXPECT_NE(judge(1), judge(2));
}

}  // namespace
}  // namespace graspbench
