#include "datasets/plan/frozen_folder.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

const StoreKind kKind = {"experiment",
                         "experiment.json",
                         4,
                         "graspbench try",
                         "try anew into another folder",
                         {"experiment.json"},
                         {},
                         {},
                         {}};

class FrozenFolderTest : public testing::Test {
 protected:
  /** The kind and text of what LoadFrozen throws. */
  std::pair<ErrorKind, std::string> FindFault() const {
    try {
      LoadFrozen(kKind, folder_.path());
    } catch (const Error& error) {
      return {error.kind(), error.what()};
    }
    ADD_FAILURE() << "nothing was thrown";
    return {ErrorKind::kUnsupported, ""};
  }
  std::filesystem::path file() const { return folder_.path() / kKind.file; }

  TemporaryFolder folder_;
};

TEST_F(FrozenFolderTest, GivesBackWhatWasFrozenInTheSameOrder) {
  EXPECT_FALSE(HasFrozen(kKind, folder_.path()));
  const Json config = {{"z", 0.1}, {"a", {1, 2, 3}}};
  WriteFrozen(kKind, folder_.path(), config);
  EXPECT_TRUE(HasFrozen(kKind, folder_.path()));
  EXPECT_EQ(LoadFrozen(kKind, folder_.path()).config.dump(), config.dump());
}

TEST_F(FrozenFolderTest, SaysWhatIsMissingDamagedOrOfAnotherVersion) {
  EXPECT_EQ(FindFault().first, ErrorKind::kNotFound);
  const std::string folder = folder_.path().string();
  EXPECT_EQ(FindFault().second, "no experiment in \"" + folder +
                                    "\" (experiment.json is not there); graspbench try --out " +
                                    folder + " starts one");
  WriteFile(folder_.path() / "manifest.json", "somebody else's");
  EXPECT_EQ(FindFault().first, ErrorKind::kNotFound);
  EXPECT_EQ(FindFault().second, "no experiment in \"" + folder +
                                    "\" (experiment.json is not there); graspbench try --out "
                                    "NEW_FOLDER starts one");
  Manifest study;
  study.kind = "study";
  WriteManifest(folder_.path(), study);
  EXPECT_EQ(FindFault().second, "no experiment in \"" + folder +
                                    "\" (experiment.json is not there; it holds the result "
                                    "\"study\"); the tables of a study are in its folder");
  std::filesystem::remove(folder_.path() / "manifest.json");
  WriteFrozen(kKind, folder_.path(), {{"a", 1}});
  std::filesystem::remove(file());
  EXPECT_EQ(FindFault().first, ErrorKind::kFormat);
  EXPECT_TRUE(Has(FindFault().second, "experiment.json\" is missing, which the manifest"));
  WriteFile(file(), R"({"schema":5,"program_version":"9.9.9","config":{}})");
  EXPECT_EQ(FindFault().first, ErrorKind::kVersion);
  EXPECT_TRUE(Has(FindFault().second, "has schema 5"));
  EXPECT_TRUE(Has(FindFault().second,
                  "reads schema 4; use graspbench 9.9.9 for it, or try anew "
                  "into another folder"));
  for (const char* text : {"{\"schema\":4,", "{\"config\":{}}", "[]"}) {
    WriteFile(file(), text);
    EXPECT_EQ(FindFault().first, ErrorKind::kFormat) << text;
    EXPECT_TRUE(Has(FindFault().second, "experiment.json\" is damaged: "));
  }
}

}  // namespace
}  // namespace graspbench
