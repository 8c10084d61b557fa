#include "core/hand/import/shapes/find_mesh.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/files/files.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

const std::vector<std::string> kEndings = {".obj", ".stl"};

class FindMeshTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(root_);
    for (const char* file : {"my_hand/meshes/tip.stl", "my_hand/urdf/palm.obj",
                             "my_hand/meshes/Knuckle.STL", "other/parts/nail.obj"}) {
      MakeFolder((root_ / file).parent_path());
      WriteFile(root_ / file, "x");
    }
  }
  void TearDown() override { fs::remove_all(root_); }
  /** The place found, relative to the root; for a URDF in my_hand/urdf. */
  std::string Find(const std::string& address, const std::vector<fs::path>& packages = {}) {
    const FoundMesh found = FindMesh(address, root_ / "my_hand/urdf", packages, kEndings);
    return found.path.empty() ? "" : found.path.lexically_relative(root_).string();
  }
  const fs::path root_ =
      fs::path(testing::TempDir()) / ("find_mesh_test_" + std::to_string(::getpid()));
};

TEST_F(FindMeshTest, FindsWhatPeopleWrite) {
  EXPECT_EQ(Find("palm.obj"), "my_hand/urdf/palm.obj");
  EXPECT_EQ(Find("../meshes/tip.stl"), "my_hand/meshes/tip.stl");
  EXPECT_EQ(Find("meshes/tip.stl"), "my_hand/meshes/tip.stl");
  EXPECT_EQ(Find("package://my_hand/meshes/tip.stl"), "my_hand/meshes/tip.stl");
  EXPECT_EQ(Find("model://my_hand/meshes/tip.stl"), "my_hand/meshes/tip.stl");
  EXPECT_EQ(Find("$(find my_hand)/meshes/tip.stl"), "my_hand/meshes/tip.stl");
  EXPECT_EQ(Find("file://" + (root_ / "other/parts/nail.obj").string()), "other/parts/nail.obj");
  EXPECT_EQ(Find("file:///home/me/ws/src/my_hand/meshes/tip.stl"), "my_hand/meshes/tip.stl");
  EXPECT_EQ(Find("meshes\\tip.stl"), "my_hand/meshes/tip.stl");
}

TEST_F(FindMeshTest, ARenamedPackageIsFoundByItsInside) {
  EXPECT_EQ(Find("package://my_hand_description/meshes/tip.stl"), "my_hand/meshes/tip.stl");
}

TEST_F(FindMeshTest, ThePackagePathHelps) {
  EXPECT_EQ(Find("package://parts/nail.obj"), "");
  EXPECT_EQ(Find("package://parts/nail.obj", {root_ / "other"}), "other/parts/nail.obj");
  EXPECT_EQ(Find("package://x/parts/nail.obj", {root_ / "other"}), "other/parts/nail.obj");
}

TEST_F(FindMeshTest, OtherLettersAndOtherFormats) {
  EXPECT_EQ(Find("package://my_hand/meshes/knuckle.stl"), "my_hand/meshes/Knuckle.STL");
  const FoundMesh other = FindMesh("meshes/tip.dae", root_ / "my_hand/urdf", {}, kEndings);
  EXPECT_TRUE(other.is_other);
  EXPECT_EQ(other.path, root_ / "my_hand/meshes/tip.stl");
}

TEST_F(FindMeshTest, NamesWhatItTried) {
  const FoundMesh found = FindMesh("package://p/q.obj", root_ / "my_hand/urdf", {"/pkg"}, kEndings);
  EXPECT_TRUE(found.path.empty());
  ASSERT_GE(found.tried.size(), 4u);
  EXPECT_EQ(found.tried[0], "/pkg/p/q.obj");
  EXPECT_EQ(found.tried[1], "/pkg/q.obj");
  EXPECT_EQ(found.tried[2], (root_ / "my_hand/urdf/p/q.obj").string());
}

}  // namespace
}  // namespace graspbench
