/** @file
A session that is killed again and again and continued each time has the same results, byte for
byte, as one that ran through, for any number of workers. */

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

#include "core/base/files.h"
#include "core/base/random.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

const std::vector<std::string> kSession = {"--object", "golf_ball,tea_light", "--trials", "8"};

pid_t Start(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {GRASPBENCH_PROGRAM, "run"});
  const pid_t child = ::fork();
  if (child != 0) return child;
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

int WaitFor(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

void ExpectSameFile(const fs::path& a, const fs::path& b) {
  EXPECT_TRUE(ReadFile(a) == ReadFile(b)) << a << " and " << b << " differ";
}

class KillAndResume : public testing::TestWithParam<int> {};

TEST_P(KillAndResume, GivesTheBytesOfAnUninterruptedRun) {
  const std::string jobs = std::to_string(GetParam());
  const fs::path folder =
      fs::path(testing::TempDir()) / ("kill_and_resume_" + jobs + "_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  const std::string whole = (folder / "whole").string(), killed = (folder / "killed").string();

  std::vector<std::string> arguments = kSession;
  arguments.insert(arguments.end(), {"--jobs", "2", "--out", whole});
  ASSERT_EQ(WaitFor(Start(arguments)), 0);

  arguments = kSession;
  arguments.insert(arguments.end(), {"--jobs", jobs, "--out", killed});
  RandomStream moments("kill " + jobs, "moment");
  constexpr int kMaxKills = 6;
  int num_kills = 0;
  for (; num_kills < kMaxKills; ++num_kills) {
    const pid_t child = Start(arguments);
    std::this_thread::sleep_for(std::chrono::duration<double>(moments.NextUniform(0.2, 1.4)));
    ::kill(child, SIGKILL);
    if (WaitFor(child) != -SIGKILL) break;  // was faster than the kill
    if (fs::exists(fs::path(killed) / "session.json")) {
      arguments = {"--resume", "--jobs", jobs, "--out", killed};
    }
  }
  EXPECT_GE(num_kills, 1);
  ASSERT_EQ(WaitFor(Start({"--resume", "--jobs", jobs, "--out", killed})), 0);

  for (const char* file :
       {"session.json", "plan.jsonl", "export/trials.csv", "report/index.html"}) {
    ExpectSameFile(fs::path(whole) / file, fs::path(killed) / file);
  }
  if (!HasFailure()) fs::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Jobs, KillAndResume, testing::Values(1, 2, 4));

}  // namespace
}  // namespace graspbench
