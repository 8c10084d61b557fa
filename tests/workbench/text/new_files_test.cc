#include "workbench/text/new_files.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "datasets/plan/session_config.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {
namespace {

class NewFilesTest : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / (std::string("new_files_") + GetParam());
};

TEST_P(NewFilesTest, PassTheirCheck) {
  std::filesystem::create_directories(folder_);
  for (const auto& [name, content] : MakeNewFiles(GetParam())) WriteFile(folder_ / name, content);
  EXPECT_NO_THROW(CheckNewFiles(GetParam(), folder_.string()));
}

INSTANTIATE_TEST_SUITE_P(Kinds, NewFilesTest,
                         testing::Values("session", "object", "hand", "arm", "study", "profile"),
                         [](const auto& kind) { return std::string(kind.param); });

// What is written out is what holds without the file.
TEST(NewSessionTest, HoldsEveryDefault) {
  const std::string text = MakeNewFiles("session")[0].second;
  EXPECT_EQ(ToJson(ParseSessionConfig(text, "session.yaml")), ToJson(SessionConfig()));
  for (const std::string& key : ListConfigKeys(SessionConfig())) {
    EXPECT_NE(text.find(key.substr(key.rfind('.') + 1) + ":"), std::string::npos) << key;
  }
}

TEST(NewStudyTest, NamesEveryKey) {
  const std::string text = MakeNewFiles("study")[0].second;
  for (const std::string& key : ListConfigKeys(StudyConfig())) {
    EXPECT_NE(text.find(key.substr(key.rfind('.') + 1) + ":"), std::string::npos) << key;
  }
  Diagnostics problems;
  const StudyConfig config = ParseStudyConfig(text, "study.yaml", problems);
  EXPECT_EQ(problems.Format(), "");
  EXPECT_EQ(config.cleaning.max_gap, StudyConfig().cleaning.max_gap);
}

}  // namespace
}  // namespace graspbench
