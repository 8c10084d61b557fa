#include "datasets/grasps/write_grasps.h"

#include <gtest/gtest.h>

#include "tests/datasets/grasps/grasp_cases.h"

namespace graspbench {
namespace {

void ExpectSameStage(const GraspStage& a, const GraspStage& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.X_OR.matrix(), b.X_OR.matrix());
  EXPECT_EQ(a.joints, b.joints);
}

TEST(WriteGrasps, DexgraspbenchComesBackBitByBit) {
  for (const char* name : {"good_bodex.npy", "good_dexonomy.npy", "good_fortran.npy"}) {
    const std::vector<ForeignGrasp> grasps = ReadGraspCase("dexgraspbench", name);
    const WrittenGrasps written = WriteGrasps(grasps, "dexgraspbench");
    EXPECT_EQ(written.losses.size(), grasps[0].X_WO.translation().isZero() ? 0u : 1u);
    const std::vector<ForeignGrasp> again = ParseGrasps(written.bytes, name, "auto", {});
    ASSERT_EQ(again.size(), grasps.size());
    for (size_t i = 0; i < grasps.size(); ++i) {
      EXPECT_EQ(again[i].object, grasps[i].object);
      EXPECT_EQ(again[i].scale, grasps[i].scale);
      EXPECT_EQ(again[i].label, grasps[i].label);
      EXPECT_EQ(again[i].joint_names, grasps[i].joint_names);
      ASSERT_EQ(again[i].stages.size(), 3u);
      for (size_t s = 0; s < 3; ++s) ExpectSameStage(again[i].stages[s], grasps[i].stages[s]);
    }
    EXPECT_EQ(WriteGrasps(again, "dexgraspbench").bytes, written.bytes);
  }
}

TEST(WriteGrasps, IsaacComesBackBitByBitAndSaysWhatIsLost) {
  const std::vector<ForeignGrasp> grasps = ReadGraspCase("dexgraspbench", "good_dexonomy.npy");
  const WrittenGrasps written = WriteGrasps(grasps, "isaac");
  EXPECT_EQ(written.losses,
            (std::vector<std::string>{"stage squeeze", "the mesh's scale 0.08: give it by --scale",
                                      "the root's pose at pregrasp: a grasp has one pose",
                                      "the verdict but as a confidence of 1 or 0"}));
  GraspReadOptions options;
  options.hand_frame = "wrist";
  options.object_frame = "mesh";
  options.scale = 0.08;
  const std::vector<ForeignGrasp> again = ParseGrasps(written.bytes, "a.yaml", "auto", options);
  ASSERT_EQ(again.size(), grasps.size());
  for (size_t i = 0; i < grasps.size(); ++i) {
    EXPECT_EQ(again[i].joint_names, grasps[i].joint_names);
    EXPECT_EQ(again[i].stages[0].joints, grasps[i].stages[0].joints);
    ExpectSameStage(again[i].stages[1], grasps[i].stages[1]);
  }
  EXPECT_EQ(WriteGrasps(again, "isaac").bytes.size(), written.bytes.size());
}

TEST(WriteGrasps, RefusesWhatOneFileCannotHold) {
  std::vector<ForeignGrasp> grasps = ReadGraspCase("dexgraspbench", "good_dexonomy.npy");
  const auto error_of = [&](const std::string& format) {
    return FindError([&] { WriteGrasps(grasps, format); });
  };
  EXPECT_TRUE(Has(error_of("graspgen"), "cannot be written as"));
  grasps[2].object = "another";
  EXPECT_TRUE(Has(error_of("isaac"), "good_dexonomy.npy, grasp 2: is of another object"));
  grasps.resize(1);
  grasps[0].stages.pop_back();
  EXPECT_TRUE(Has(error_of("dexgraspbench"), "has no stage squeeze"));
  grasps[0].root_link = "palm";
  EXPECT_TRUE(Has(error_of("dexgraspbench"), "the root \"palm\""));
}

}  // namespace
}  // namespace graspbench
