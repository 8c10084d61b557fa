#include "datasets/mjcf/mjcf_export.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "tests/datasets/mjcf/best_grasp_setup.h"

namespace graspbench {
namespace {

TEST(MjcfExport, WritesTheSameBytesAgain) {
  const TrialSetup setup = MakeBestGraspSetup("tum-evolved", "toy_cube");
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "mjcf_export";
  MjcfExporter().Export(setup, folder / "a");
  MjcfExporter exporter;
  exporter.Export(setup, folder / "b");
  exporter.Export(setup, folder / "b");  // with the parts it cut before
  for (const char* file : {"scene.xml", "motion.csv"}) {
    const std::string content = ReadFile(folder / "a" / file);
    EXPECT_GT(content.size(), 1000u) << file;
    EXPECT_EQ(content, ReadFile(folder / "b" / file)) << file;
  }
}

}  // namespace
}  // namespace graspbench
