#include "workbench/experiments/run_record.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/files/files.h"
#include "core/base/hash.h"

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

TEST(FindMachine, SaysWhatTheSystemSays) {
  const Machine machine = FindMachine();
  char host[256] = "";
  ASSERT_EQ(::gethostname(host, sizeof host - 1), 0);
  EXPECT_EQ(machine.host, host);
  EXPECT_EQ(machine.build, CalcHashHex(ReadFile("/proc/self/exe")));
  EXPECT_EQ(machine.c_library.rfind("glibc 2.", 0), 0u);
  EXPECT_NE(ReadFile("/proc/cpuinfo").find(machine.processor), std::string::npos);
  EXPECT_NE(machine.processor_flags, CalcHashHex(""));
  EXPECT_TRUE(machine == FindMachine());
}

}  // namespace

}  // namespace graspbench
