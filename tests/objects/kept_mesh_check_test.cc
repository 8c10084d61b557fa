#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"
#include "objects/catalogue.h"
#include "tests/core/shape/join_meshes.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class KeptMeshCheckTest : public testing::Test {
 protected:
  KeptMeshCheckTest() {
    ::setenv("XDG_CACHE_HOME", testing::TempDir().c_str(), 1);
    fs::create_directory(folder_);
    WriteFile(folder_ / "object.yaml",
              "name: crossed bars\nmesh: mesh.obj\nmesh_unit: m\nmass_kg: 0.05\n"
              "friction_static: 0.5\nfriction_dynamic: 0.4\n");
  }
  /** Of the numbers that follow from the mesh, its overlap among them. */
  std::string LoadHash() const {
    return LoadObject(folder_.string(), FieldUse::kLater)->content_hash;
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / "crossed_bars";
};

// Where two bars cross is counted once, which the second run knows from the first.
TEST_F(KeptMeshCheckTest, TheSecondRunLoadsTheSameObject) {
  const TriMesh bars = JoinMeshes(MakeRoundedBox({0.1, 0.02, 0.02}, 0.001),
                                  MakeRoundedBox({0.02, 0.1, 0.03}, 0.001), {0.02, 0.0, 0.0});
  WriteFile(folder_ / "mesh.obj", FormatObj(bars, 1.0));
  const std::string expected = LoadHash();
  const auto files = fs::directory_iterator(FindCacheRoot() / "meshes");
  const fs::path path = files->path();
  const std::string good = ReadFile(path);
  EXPECT_EQ(LoadHash(), expected);
  std::string flipped = good;
  flipped[40] = static_cast<char>(flipped[40] ^ 1);
  for (const std::string& bad : {flipped, good.substr(0, 50), std::string()}) {
    WriteFile(path, bad);
    EXPECT_EQ(LoadHash(), expected);
    EXPECT_EQ(ReadFile(path), good);
  }
}

TEST_F(KeptMeshCheckTest, WhatIsUnusableStaysSo) {
  TriMesh open = MakeRoundedBox({0.1, 0.02, 0.02}, 0.001);
  open.triangles.resize(open.triangles.size() / 2);
  WriteFile(folder_ / "mesh.obj", FormatObj(open, 1.0));
  EXPECT_THROW(LoadHash(), Error);
  EXPECT_THROW(LoadHash(), Error);
  EXPECT_FALSE(fs::exists(FindCacheRoot() / "meshes"));
}

}  // namespace
}  // namespace graspbench
