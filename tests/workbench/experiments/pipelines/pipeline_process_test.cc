#include "workbench/experiments/pipelines/pipeline_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

// The process is this program, which here is the tests.
TEST(PipelineProcessHelper, DISABLED_Sleeps) {
  std::this_thread::sleep_for(std::chrono::seconds(60));
}

const std::vector<std::string> kSleep = {"--gtest_also_run_disabled_tests",
                                         "--gtest_filter=PipelineProcessHelper.DISABLED_Sleeps"};

int Wait(PipelineProcess& process) {
  for (;;) {
    if (const auto code = process.Poll()) return *code;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

TEST(PipelineProcessTest, RunsInItsFolderAndKeepsWhatItPrints) {
  const TemporaryFolder temporary;
  const auto& top = temporary.path();
  PipelineProcess process({"--gtest_list_tests", "--gtest_filter=*Sleeps", "--gtest_output=json:x"},
                          top, top / "out", top / "log");
  EXPECT_EQ(Wait(process), 0);
  EXPECT_NE(ReadFile(top / "out").find("DISABLED_Sleeps"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(top / "x"));
  EXPECT_EQ(ReadFile(top / "log"), "");
}

TEST(PipelineProcessTest, EndsWhenItIsAskedAndWithItsOwner) {
  const TemporaryFolder temporary;
  const auto& top = temporary.path();
  PipelineProcess asked(kSleep, top, top / "log", top / "log");
  EXPECT_EQ(asked.Poll(), std::nullopt);
  asked.Interrupt();
  EXPECT_EQ(Wait(asked), 128 + SIGTERM);
  const auto start = std::chrono::steady_clock::now();
  { const PipelineProcess dropped(kSleep, top, top / "log", top / "log"); }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_THROW(PipelineProcess(kSleep, top, top / "no" / "log", top / "no" / "log"), Error);
}

}  // namespace
}  // namespace graspbench
