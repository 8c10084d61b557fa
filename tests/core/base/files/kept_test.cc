#include "core/base/files/kept.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class KeptTest : public testing::Test {
 protected:
  std::optional<std::string> Read() const { return ReadKept(path_, "gbtest01", 7); }
  void KeepContent() const { Keep(path_, "gbtest01", 7, content_); }

  const fs::path folder_ = fs::path(testing::TempDir()) / "kept";
  const fs::path path_ = folder_ / "one";
  const std::string content_ = "some content\nand more";
};

TEST_F(KeptTest, WhatWasKeptIsRead) {
  EXPECT_EQ(Read(), std::nullopt);
  KeepContent();
  EXPECT_EQ(Read(), content_);
  EXPECT_EQ(ReadKept(path_, "gbtest02", 7), std::nullopt) << "another rule";
  EXPECT_EQ(ReadKept(path_, "gbtest01", 8), std::nullopt) << "another key";
}

TEST_F(KeptTest, EveryDamageIsSeenAndMended) {
  KeepContent();
  const std::string good = ReadFile(path_);
  for (size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    WriteFile(path_, bad);
    ASSERT_EQ(Read(), std::nullopt) << "bit " << bit;
  }
  for (size_t size = 0; size < good.size(); ++size) {
    WriteFile(path_, good.substr(0, size));
    ASSERT_EQ(Read(), std::nullopt) << size << " bytes";
  }
  WriteFile(path_, good + "tail");
  EXPECT_EQ(Read(), std::nullopt);
  KeepContent();
  EXPECT_EQ(ReadFile(path_), good);
}

TEST_F(KeptTest, TheFolderIsPrivateAndAForeignOneIsDoneWithout) {
  KeepContent();
  EXPECT_EQ(fs::status(folder_).permissions(), fs::perms::owner_all);
  fs::permissions(folder_, fs::perms::others_all, fs::perm_options::add);
  EXPECT_EQ(Read(), std::nullopt);
  KeepContent();
  EXPECT_EQ(fs::status(folder_).permissions(), fs::perms::owner_all);
  EXPECT_EQ(Read(), content_);

  const fs::path link = fs::path(testing::TempDir()) / "link";
  fs::create_directory_symlink(folder_, link);
  EXPECT_EQ(ReadKept(link / "one", "gbtest01", 7), std::nullopt);
}

TEST_F(KeptTest, AFolderThatCannotBeMadeIsDoneWithout) {
  WriteFile(folder_, "a file where the folder should be");
  KeepContent();
  EXPECT_EQ(Read(), std::nullopt);
}

}  // namespace
}  // namespace graspbench
