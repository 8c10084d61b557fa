/** @file
A session or campaign that is killed again and again and continued each time has the same results,
byte for byte, as one that ran through, for any number of workers. */

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

#include "core/base/random.h"
#include "tests/sessions/test_folder.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

const std::vector<std::string> kSession = {"run", "--object", "golf_ball,tea_light", "--trials",
                                           "8"};
const std::vector<std::string> kCampaign = {"campaign",
                                            "--object",
                                            "golf_ball,tea_light",
                                            "--hand",
                                            "tum",
                                            "--evaluations",
                                            "30",
                                            "--fitness-trials",
                                            "1",
                                            "--trials",
                                            "2",
                                            "--set",
                                            "optimise.choice_trials=2",
                                            "--set",
                                            "optimise.check_pairs=20",
                                            "--set",
                                            "comparison.scenes=tum/tea_light",
                                            "--set",
                                            "comparison.methods=es,cmaes",
                                            "--set",
                                            "comparison.seeds=2",
                                            "--set",
                                            "comparison.evaluations=20"};

TEST(KillAndResume, GivesTheBytesOfAnUninterruptedRunOfOtherWorkers) {
  const std::string jobs = "4";
  const TestFolder own("kill_and_resume");
  const fs::path& folder = own.path();
  const std::string whole = (folder / "whole").string(), killed = (folder / "killed").string();

  std::vector<std::string> arguments = kSession;
  arguments.insert(arguments.end(), {"--jobs", "2", "--out", whole});
  ASSERT_EQ(WaitFor(Start(arguments)), 0);

  arguments = kSession;
  arguments.insert(arguments.end(), {"--jobs", jobs, "--out", killed});
  RandomStream moments("kill " + jobs, "moment");
  const fs::path journal = fs::path(killed) / "journal";
  int num_kills = 0;
  for (int attempt = 0; attempt < 4; ++attempt) {
    const int num_lines = CountLines(journal) + 1 + moments.NextIndex(5);
    num_kills += KillAfter(
        Start(arguments), [&] { return CountLines(journal) >= num_lines; },
        moments.NextUniform(0.0, 0.1));
    arguments = {"run", "--resume", "--jobs", jobs, "--out", killed};
  }
  EXPECT_GE(num_kills, 2);
  ASSERT_EQ(WaitFor(Start(arguments)), 0);

  for (const char* file :
       {"session.json", "plan.jsonl", "export/trials.csv", "report/index.html"}) {
    ExpectSameFile(fs::path(whole) / file, fs::path(killed) / file);
  }
}

// Nobody would know what a watch waits for that only counts the trials.
TEST(KilledJudge, IsNamedByAWatch) {
  const TestFolder own("killed_judge");
  const fs::path& folder = own.path();
  const std::string session = (folder / "s").string(), told = (folder / "told").string();
  const auto fork_watch = [&] {
    return Start({"watch", session, "--interval", "0.05"},
                 [&] { EXPECT_NE(std::freopen(told.c_str(), "w", stdout), nullptr); });
  };
  ASSERT_EQ(WaitFor(Start({"run", "--hand", "tum", "--object", "golf_ball,tea_light", "--trials",
                           "6", "--out", session})),
            0);
  ASSERT_TRUE(KillAfter(
      Start({"judge", session, "--jobs", "1"}),
      [&] { return CountLines(fs::path(session) / "judge") >= 1; }, 0.0));
  for (const auto& journal : fs::directory_iterator(fs::path(session) / "judge")) {
    fs::last_write_time(journal, fs::file_time_type::clock::now() - std::chrono::minutes(1));
  }
  const pid_t watch = fork_watch();
  const std::string sentence = "; no process of this machine is working on it: graspbench judge " +
                               session + " goes on with it\n";
  const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  const auto is_told = [&] { return ReadFile(told).find(sentence) != std::string::npos; };
  while (!(fs::exists(told) && is_told()) && std::chrono::steady_clock::now() < last) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(is_told()) << ReadFile(told);
  EXPECT_FALSE(HasEnded(watch));
  ::kill(watch, SIGINT);
  EXPECT_EQ(WaitFor(watch), 0);
  ASSERT_EQ(WaitFor(Start({"judge", session})), 0);
  EXPECT_EQ(WaitFor(fork_watch()), 0);
  EXPECT_FALSE(is_told()) << ReadFile(told);
}

// A trial of minutes: a first TERM is enough, and what it leaves is a session.
TEST(Terminate, EndsInTenSecondsEvenIfATrialDoesNot) {
  const TestFolder own("terminate");
  const fs::path& folder = own.path();
  const pid_t child =
      Start({"run", "--hand", "shadow", "--object", "golf_ball", "--trials", "2", "--jobs", "2",
             "--set", "strategy.hold_time_s=60", "--set", "sim.step_s=0.0001", "--set",
             "sim.steady_step_factor=1", "--out", folder.string()});
  while (!fs::exists(folder / "session.json") && !HasEnded(child)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::seconds(2));
  ASSERT_FALSE(HasEnded(child));
  const auto start = std::chrono::steady_clock::now();
  ::kill(child, SIGTERM);
  EXPECT_EQ(WaitFor(child), 75);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  EXPECT_EQ(WaitFor(Start({"export", folder.string()})), 0);
}

/** Files below the folder that must not depend on workers and interruptions. */
std::vector<fs::path> ListResults(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path path = entry.path().lexically_relative(folder);
    const fs::path benchmark = "benchmark";
    const bool is_worker_journal =  // or what names these
        path.parent_path() == benchmark / "journal" || path.parent_path() == benchmark / "judge" ||
        path == benchmark / "manifest.json";
    if (entry.is_regular_file() && path.filename() != "run.json" && !is_worker_journal) {
      files.push_back(path);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(KillAndResumeCampaign, GivesTheBytesOfAnUninterruptedOne) {
  const TestFolder own("kill_campaign");
  const fs::path& folder = own.path();
  const fs::path whole = folder / "whole", killed = folder / "killed";
  std::vector<std::string> arguments = kCampaign;
  arguments.insert(arguments.end(), {"--jobs", "1", "--out", whole.string()});
  ASSERT_EQ(WaitFor(Start(arguments)), 0);

  arguments = kCampaign;
  arguments.insert(arguments.end(), {"--jobs", "2", "--out", killed.string()});
  RandomStream moments("kill campaign", "moment");
  int num_kills = 0;
  for (int attempt = 0; attempt < 6; ++attempt) {
    const int num_lines = CountLines(killed) + 1 + moments.NextIndex(60);
    num_kills += KillAfter(
        Start(arguments), [&] { return CountLines(killed) >= num_lines; },
        moments.NextUniform(0.0, 0.05));
  }
  EXPECT_GE(num_kills, 3);
  ASSERT_EQ(WaitFor(Start(arguments)), 0);

  const std::vector<fs::path> files = ListResults(whole);
  EXPECT_GT(files.size(), 20u);
  EXPECT_EQ(ListResults(killed), files);
  for (const fs::path& file : files) ExpectSameFile(whole / file, killed / file);
}

}  // namespace
}  // namespace graspbench
