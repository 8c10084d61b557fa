#include "workbench/experiments/grasp_inputs.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
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
  EXPECT_EQ(FindObjectMesh(folder.path(), ""), fs::path());
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
    LoadGraspInputs(collection, "shadow", folder.path());
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a.npy, grasp 0"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("FFJ9"), std::string::npos) << error.what();
  }
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
