// Files that numpy 1.24 wrote, with numbers drawn at random; what they hold is known from outside.
#include <gtest/gtest.h>

#include "datasets/grasps/grasp_files.h"
#include "tests/datasets/grasps/grasp_cases.h"

namespace graspbench {
namespace {

TEST(DexgraspbenchGrasps, OneGraspOfBodex) {
  const std::vector<ForeignGrasp> grasps = ReadGraspCase("dexgraspbench", "good_bodex.npy");
  ASSERT_EQ(grasps.size(), 1u);
  const ForeignGrasp& grasp = grasps.front();
  EXPECT_EQ(grasp.format, "dexgraspbench");
  EXPECT_EQ(grasp.source, "good_bodex.npy");
  EXPECT_EQ(grasp.object, "assets/object/DGN_2k/processed_data/core_bottle_1a7");
  EXPECT_EQ(grasp.scale, static_cast<double>(0.06f));
  EXPECT_FALSE(grasp.label);
  EXPECT_TRUE(grasp.assumptions.empty());
  ASSERT_EQ(grasp.stages.size(), 3u);
  EXPECT_EQ(grasp.stages[0].name, "pregrasp");
  EXPECT_EQ(grasp.stages[1].name, "grasp");
  EXPECT_EQ(grasp.stages[2].name, "squeeze");
  ASSERT_EQ(grasp.joint_names.size(), 22u);
  EXPECT_EQ(grasp.joint_names[0], "FFJ4");
  EXPECT_EQ(grasp.joint_names[12], "LFJ5");
  EXPECT_EQ(grasp.joint_names[21], "THJ1");
  const GraspStage& stage = grasp.stages[1];
  EXPECT_EQ(stage.joints[0], 0.052285827696323395);
  EXPECT_EQ(stage.joints[2], stage.joints[3]);  // BODex couples J1 to J2
  EXPECT_EQ(stage.joints[21], 0.1371411234140396);
  // The object stands at (0.1, 0.2, 0.3), unturned.
  EXPECT_EQ(grasp.X_WO.translation(), Eigen::Vector3d(0.1f, 0.2f, 0.3f));
  EXPECT_NEAR(stage.X_OR.translation().x(), -0.1525757610797882 - 0.1f, 1e-15);
  EXPECT_NEAR(stage.X_OR.translation().z(), -0.14954501390457153 - 0.3f, 1e-15);
}

TEST(DexgraspbenchGrasps, ArraysOfDexonomy) {
  const std::vector<ForeignGrasp> grasps = ReadGraspCase("dexgraspbench", "good_dexonomy.npy");
  ASSERT_EQ(grasps.size(), 3u);
  EXPECT_EQ(grasps[0].object, "assets/object/sem_Mug_8a/mesh/simplified.obj");
  EXPECT_EQ(grasps[2].scale, 0.08);
  EXPECT_EQ(grasps[0].label, true);
  EXPECT_EQ(grasps[1].label, false);
  EXPECT_EQ(grasps[2].index, 2);
  const GraspStage& squeeze = grasps[1].stages[2];
  EXPECT_EQ(squeeze.X_OR.translation().x(), 0.13018597615415733);
  EXPECT_EQ(squeeze.joints[21], 0.8862474749707205);
  EXPECT_NE(squeeze.joints[2], squeeze.joints[3]);  // J1 is free
}

}  // namespace
}  // namespace graspbench
