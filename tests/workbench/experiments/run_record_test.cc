#include "workbench/experiments/run_record.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"

namespace graspbench {
namespace {

class RunRecordTest : public testing::Test {
 protected:
  RunRecordTest() {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("run_record_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  Json LoadRuns() { return Json::parse(ReadFile(folder_ / "run.json")).at("runs"); }
  std::filesystem::path folder_;
};

TEST_F(RunRecordTest, RunsAreAppended) {
  AppendRunRecord(folder_, {"2026-01-31T12:00:00Z", 1.5, 2, 7, RunEnding::kInterrupted});
  AppendRunRecord(folder_, {"2026-01-31T13:00:00Z", 2.5, 4, 3, RunEnding::kFinished});
  const Json runs = LoadRuns();
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0]["ending"], "interrupted");
  EXPECT_EQ(runs[1]["trials"], 3);
  EXPECT_EQ(runs[1]["duration_s"], 2.5);
  EXPECT_FALSE(HasRunOfAnotherBuild(folder_));
}

TEST_F(RunRecordTest, ADamagedRecordIsReplaced) {
  for (const char* damaged : {"", "{", "[1]", "{\"runs\": 3}"}) {
    WriteFileAtomically(folder_ / "run.json", damaged);
    EXPECT_FALSE(HasRunOfAnotherBuild(folder_));
    AppendRunRecord(folder_, {"2026-01-31T12:00:00Z", 1.5, 2, 7, RunEnding::kFinished});
    EXPECT_EQ(LoadRuns().size(), 1u) << damaged;
  }
}

TEST_F(RunRecordTest, AnotherBuildIsNoticed) {
  WriteFileAtomically(folder_ / "run.json", R"({"runs": [{"build": "0123456789abcdef"}]})");
  EXPECT_TRUE(HasRunOfAnotherBuild(folder_));
}

TEST_F(RunRecordTest, TheClockIsUtcInIsoForm) {
  const std::string now = FormatUtcNow();
  ASSERT_EQ(now.size(), 20u) << now;
  EXPECT_EQ(now[10], 'T');
  EXPECT_EQ(now.back(), 'Z');
}

}  // namespace
}  // namespace graspbench
