#include "datasets/grasps/grasp_files.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/datasets/grasps/grasp_cases.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

class GraspFiles : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "b");
    fs::create_directories(folder_ / "a");
  }
  void TearDown() override { fs::remove_all(folder_); }
  void Copy(const std::string& name, const std::string& to) {
    fs::copy(FindGraspCase("dexgraspbench", name), folder_ / to);
  }
  fs::path folder_ = fs::path(testing::TempDir()) / "grasp_files_test";
};

TEST_F(GraspFiles, NothingOfAFolderIsSkippedSilently) {
  Copy("good_bodex.npy", "b/0.npy");
  Copy("good_dexonomy.npy", "a/0.npy");
  Copy("bad_truncated.npy", "a/1.npy");
  WriteFile(folder_ / "notes.txt", "grasps of Tuesday");
  WriteFile(folder_ / "empty.npy", "");
  WriteFile(folder_ / ".hidden", "of the file manager");
  fs::create_symlink("nowhere", folder_ / "z.npy");
  const GraspCollection collection = ReadGraspCollection({folder_.string()}, "auto");
  EXPECT_EQ(collection.num_files, 6);
  ASSERT_EQ(collection.grasps.size(), 4u);
  EXPECT_EQ(collection.grasps[0].source, "a/0.npy");
  EXPECT_EQ(collection.grasps[2].index, 2);
  EXPECT_EQ(collection.grasps[3].source, "b/0.npy");
  ASSERT_EQ(collection.unread.size(), 4u);
  EXPECT_EQ(collection.unread[0].name, "a/1.npy");
  EXPECT_EQ(collection.unread[1].name, "empty.npy");
  EXPECT_TRUE(Has(collection.unread[1].reason, "is empty; known: dexgraspbench"));
  EXPECT_EQ(collection.unread[2].name, "notes.txt");
  EXPECT_TRUE(Has(collection.unread[2].reason, "of no known format"));
  EXPECT_EQ(collection.unread[3].name, "z.npy");
}

TEST_F(GraspFiles, OptionsAndPathsThatAreWrongStopAtOnce) {
  Copy("good_bodex.npy", "b/0.npy");
  const auto error_of = [&](const std::string& path, const std::string& format) {
    return FindError([&] { ReadGraspCollection({path}, format); });
  };
  EXPECT_TRUE(Has(error_of(folder_.string(), "dexgraspnt"), "did you mean \"dexgraspnet\""));
  EXPECT_TRUE(Has(error_of((folder_ / "c").string(), "auto"), "no such file or folder"));
  EXPECT_TRUE(Has(error_of((folder_ / "a").string(), "auto"), "a folder without files"));
}

TEST_F(GraspFiles, AFileThatNeedsAnOptionDoesNotHideTheOthers) {
  fs::copy(FindGraspCase("isaac", "good_sim.yaml"), folder_ / "a" / "0.yaml");
  // Alone it is the user's fault, among others the file's.
  EXPECT_TRUE(Has(FindError([&] { ReadGraspCollection({(folder_ / "a").string()}, "auto"); }),
                  "--hand-frame"));
  Copy("good_bodex.npy", "b/0.npy");
  const GraspCollection collection = ReadGraspCollection({folder_.string()}, "auto");
  EXPECT_EQ(collection.grasps.size(), 1u);
  ASSERT_EQ(collection.unread.size(), 1u);
  EXPECT_TRUE(Has(collection.unread[0].reason, "--hand-frame"));
}

TEST_F(GraspFiles, ALinkToItselfIsAFileThatCannotBeRead) {
  Copy("good_bodex.npy", "a/0.npy");
  fs::create_symlink("loop", folder_ / "loop");
  const GraspCollection collection = ReadGraspCollection({folder_.string()}, "auto");
  EXPECT_EQ(collection.grasps.size(), 1u);
  ASSERT_EQ(collection.unread.size(), 1u);
  EXPECT_EQ(collection.unread[0].name, "loop");
  EXPECT_EQ(collection.unread[0].reason.find(folder_.string()), std::string::npos)
      << "a result holds no path of a machine: " << collection.unread[0].reason;
}

TEST_F(GraspFiles, EveryFormatIsKnownByItsContent) {
  GraspReadOptions options;
  options.hand_frame = "hand";
  options.object_frame = "mesh";
  options.joint_names = {"left", "right"};
  for (const GraspFormat& format : ListGraspFormats()) {
    int num_good = 0;
    for (const auto& entry : fs::directory_iterator(FindGraspCase(format.id, ""))) {
      if (entry.path().filename().string().rfind("good_", 0) != 0) continue;
      ++num_good;
      const auto grasps = ReadGrasps(entry.path().string(), "auto", options);
      EXPECT_EQ(grasps.front().format, format.id) << entry.path();
    }
    EXPECT_GT(num_good, 0) << format.id;
  }
}

}  // namespace
}  // namespace graspbench
