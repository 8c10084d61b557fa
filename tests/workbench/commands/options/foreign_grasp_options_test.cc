#include "workbench/commands/options/foreign_grasp_options.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "workbench/terminal/command_line.h"

namespace graspbench {
namespace {

GraspCollection ReadWith(const std::string& words) {
  Command app;
  ForeignGraspOptions options;
  options.AddTo(app);
  const auto file = FindDataRoot() / "tests/fuzz/cases/grasps_graspgen/good_poses.json";
  EXPECT_EQ(app.Parse(SplitWords(file.string() + " " + words)).fault, "");
  return options.Read();
}

TEST(ForeignGraspOptions, GiveWhatTheFileDoesNotSay) {
  const GraspCollection collection =
      ReadWith("--hand-frame base --open left=0.04,right=-1e-3 --scale 2 --format graspgen");
  ASSERT_EQ(collection.grasps.size(), 2u);
  const ForeignGrasp& grasp = collection.grasps[0];
  EXPECT_EQ(grasp.root_link, "base");
  EXPECT_EQ(grasp.joint_names, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(grasp.stages[0].joints, (std::vector<double>{0.04, -1e-3}));
  EXPECT_EQ(grasp.scale, 2.0);
  EXPECT_EQ(ReadWith("--hand-frame base").grasps[0].scale, 0.5);
}

TEST(ForeignGraspOptions, RefuseWhatIsNoPosition) {
  for (const char* words : {"--open left", "--open left=wide", "--open left=nan"}) {
    EXPECT_THROW(ReadWith(std::string("--hand-frame base ") + words), Error) << words;
  }
  for (const char* scale : {"0", "-1", "nan", "inf"}) {
    EXPECT_THROW(ReadWith(std::string("--hand-frame base --scale ") + scale), Error) << scale;
  }
}

}  // namespace
}  // namespace graspbench
