#include "core/hand/import/guess_palm.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/hand/load_hand.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Of a hand whose thumb stands on the +x side of its palm, opposite to three fingers along z. */
Vector3d ImportNormal(const std::string& file, const std::optional<Vector3d>& given,
                      Diagnostics& problems) {
  HandSource source = MakeSourceWithoutMeshes();
  source.palm_normal = given;
  const std::filesystem::path path = std::filesystem::path(IMPORT_TEST_DATA_DIR) / file;
  const ImportedFiles imported = ImportHand(ReadFile(path), source, "", problems);
  EXPECT_EQ(problems.num_errors(), 0) << problems.Format();
  Diagnostics of_loading;
  return ParseHand(imported.files.at("hand.urdf"), imported.files.at("hand.yaml"), "x", of_loading)
      .palm_normal;
}

bool Tells(const Diagnostics& problems, const std::string& text) {
  return problems.Format().find(text) != std::string::npos;
}

TEST(GuessPalmTest, AMirroredFingerDoesNotTurnTheNormal) {
  Diagnostics problems;
  EXPECT_EQ(ImportNormal("wrong/ring_mirrored.urdf", {}, problems), Vector3d::UnitX());
}

TEST(GuessPalmTest, AGivenNormalIsTakenAndHeldAgainstTheGuess) {
  Diagnostics behind, aside, near;
  EXPECT_EQ(ImportNormal("right/opposed_three.urdf", -Vector3d::UnitX(), behind),
            -Vector3d::UnitX());
  EXPECT_TRUE(Tells(behind, "--palm-normal is 180 degrees from where the digits of \"palm\" meet"))
      << behind.Format();
  EXPECT_EQ(ImportNormal("right/opposed_three.urdf", Vector3d::UnitY(), aside), Vector3d::UnitY());
  EXPECT_TRUE(Tells(aside, "--palm-normal is 90 degrees from")) << aside.Format();
  ImportNormal("right/opposed_three.urdf", Vector3d(1, 0.5, 0.5), near);
  EXPECT_FALSE(Tells(near, "--palm-normal")) << near.Format();
}

}  // namespace
}  // namespace graspbench
