/** @file
Files that fail at random under a command (tests/support/fail_files.cc), and commands that are
killed at random: afterwards the same command ends with the bytes of an undisturbed run. */

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "core/base/random.h"
#include "tests/sessions/test_folder.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class FailingDisk : public testing::Test {
 protected:
  /** A shell line in the test's folder; GB stands for the program. */
  pid_t Start(std::string line, int fault_seed = 0) const {
    const std::string program = std::string("'") + GRASPBENCH_PROGRAM + "'";
    line = "exec " + program + " " + line + " >>log 2>&1 </dev/null";
    const pid_t child = ::fork();
    if (child != 0) return child;
    if (::chdir(top_.c_str()) != 0) ::_exit(126);
    if (fault_seed > 0) {
      ::setenv("LD_PRELOAD", GRASPBENCH_FAIL_FILES, 1);
      ::setenv("GRASPBENCH_FAULTS",
               (std::to_string(fault_seed) + " " + fault_probability_ + " out").c_str(), 1);
    }
    ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    ::_exit(127);
  }
  static int Wait(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  int Run(const std::string& line, int fault_seed = 0) const {
    return Wait(Start(line, fault_seed));
  }

  std::string Log() const { return ReadFile(top_ / "log"); }
  void ExpectSame(const std::vector<std::string>& files) const {
    for (const std::string& file : files) {
      EXPECT_TRUE(ReadFile(top_ / "whole" / file) == ReadFile(top_ / "out" / file)) << file;
    }
  }

  const TestFolder own_{std::string("failing_disk_") +
                        testing::UnitTest::GetInstance()->current_test_info()->name()};
  const fs::path& top_ = own_.path();
  int num_failed_ = 0;
  std::string fault_probability_ = "0.03";

  /** The command fails with the environment's exit code or succeeds, then is run undisturbed. */
  void RunUnderFaults(const std::string& line, const std::string& again, int first_seed,
                      int num_attempts) {
    for (int attempt = 0; attempt < num_attempts; ++attempt) {
      const bool is_begun = fs::exists(top_ / "out" / "session.json");
      const int exit_code = Run(is_begun ? again : line, first_seed + attempt);
      EXPECT_TRUE(exit_code == 0 || exit_code == 5) << exit_code << "\n" << Log();
      num_failed_ += exit_code != 0;
    }
    const bool is_begun = fs::exists(top_ / "out" / "session.json");
    EXPECT_EQ(Run(is_begun ? again : line), 0) << Log();
    EXPECT_EQ(Run("verify out"), 0) << Log();
  }
  /** Which of its files fail depends on the order in which a program's threads write: more rounds
  than `num_rounds` where hardly a command has failed. */
  bool IsNext(int round, int num_rounds, int num_expected) const {
    return round < num_rounds || (num_failed_ <= num_expected && round < 10 * num_rounds);
  }
  /** Whole records in one file, whatever the journals are called. */
  void ExportRecords() const {
    EXPECT_EQ(Run("export whole --records"), 0) << Log();
    EXPECT_EQ(Run("export out --records"), 0) << Log();
  }
};

TEST_F(FailingDisk, SessionsAreContinuedAndJudgedToTheSameBytes) {
  const std::string session = "run --hand tum --object tennis_ball --trials 6 --jobs 2 --out ";
  ASSERT_EQ(Run(session + "whole"), 0) << Log();
  ASSERT_EQ(Run("judge whole"), 0) << Log();
  for (int round = 0; IsNext(round, 2, 4); ++round) {
    fs::remove_all(top_ / "out");
    const int seed = 1 + 20 * round;
    RunUnderFaults(session + "out", "run --resume --jobs 2 --out out", seed, 5);
    RunUnderFaults("judge out", "judge out", seed + 5, 4);
    RunUnderFaults("export out", "export out", seed + 9, 3);
    RunUnderFaults("report out", "report out", seed + 12, 3);
    ExportRecords();
    ExpectSame({"session.json", "plan.jsonl", "export/trials.csv", "export/records.jsonl",
                "export/manifest.json", "index.sqlite", "report/index.html"});
  }
  EXPECT_GT(num_failed_, 4) << "the faults must bite";
}

TEST_F(FailingDisk, ShardsAreContinuedAndMergedToTheSameBytes) {
  const std::string session = "run --hand tum --object tennis_ball --trials 6 --out ";
  ASSERT_EQ(Run(session + "whole"), 0) << Log();
  for (int round = 0; IsNext(round, 2, 4); ++round) {
    fs::remove_all(top_ / "out");
    ASSERT_EQ(Run(session + "out --plan-only"), 0) << Log();
    const int seed = 201 + 20 * round;
    for (const int shard : {1, 2}) {
      const std::string work = "work out --shard " + std::to_string(shard) + "/2";
      RunUnderFaults(work, work, seed + 5 * shard, 5);
    }
    RunUnderFaults("merge out", "merge out", seed + 15, 4);
    ExportRecords();
    ExpectSame({"session.json", "plan.jsonl", "export/trials.csv", "export/records.jsonl",
                "export/manifest.json", "index.sqlite", "report/index.html"});
  }
  EXPECT_GT(num_failed_, 4) << "the faults must bite";
}

TEST_F(FailingDisk, OptimisationsAreContinuedToTheSameBytes) {
  const std::string line = "optimise --hand tum --object golf_ball --evaluations 4 --out ";
  ASSERT_EQ(Run(line + "whole"), 0) << Log();
  for (int round = 0; IsNext(round, 2, 1); ++round) {
    fs::remove_all(top_ / "out");
    RunUnderFaults(line + "out", line + "out", 101 + 10 * round, 4);
    ExpectSame({"scene.json", "journal.jsonl", "result.json", "individuals.csv", "new-target.yaml",
                "manifest.json"});
  }
  EXPECT_GT(num_failed_, 1) << "the faults must bite";
}

TEST_F(FailingDisk, CampaignsAreContinuedToTheSameBytes) {
  const std::string line =
      "campaign --hand tum --object golf_ball --evaluations 4 --fitness-trials 1 --trials 2 "
      "--set optimise.choice_trials=2 --set optimise.check_pairs=20 --out ";
  ASSERT_EQ(Run(line + "whole"), 0) << Log();
  for (int round = 0; IsNext(round, 1, 2); ++round) {
    fs::remove_all(top_ / "out");
    RunUnderFaults(line + "out", line + "out", 301 + 10 * round, 6);
    ExpectSame({"campaign.json", "summary.csv", "scenes/tum-golf_ball/result.json",
                "scenes/tum-golf_ball/journal.jsonl", "benchmark/export/trials.csv",
                "benchmark/index.sqlite", "report/index.html", "report/manifest.json"});
  }
  EXPECT_GT(num_failed_, 2) << "the faults must bite";
}

// These are there as a whole or not at all, whichever file fails; kill_commands_test kills them.
const std::vector<std::pair<std::string, std::string>>& ListWholeResults() {
  static const std::vector<std::pair<std::string, std::string>> commands = {
      {"export base --out ", "export/trials.csv"},
      {"export base --mjcf all --out ", "manifest.json"},
      {"report base --out ", "report/index.html"},
      {"study demo --out ", "measures.csv"}};
  return commands;
}

TEST_F(FailingDisk, WholeResultsAreWrittenWholeOrNot) {
  ASSERT_EQ(Run("run --hand tum --object golf_ball --trials 1 --out base"), 0) << Log();
  fault_probability_ = "0.1";
  for (const auto& [line, file] : ListWholeResults()) {
    fs::remove_all(top_ / "whole");
    ASSERT_EQ(Run(line + "whole"), 0) << Log();
    for (int attempt = 0; attempt < 6; ++attempt) {
      const bool is_undisturbed = attempt == 5;
      fs::remove_all(top_ / "out");
      const int exit_code = Run(line + "out", is_undisturbed ? 0 : 401 + attempt);
      EXPECT_TRUE(exit_code == 0 || (exit_code == 5 && !is_undisturbed)) << Log();
      num_failed_ += exit_code != 0;
      if (!fs::exists(top_ / "out")) continue;
      EXPECT_EQ(Run("verify out"), 0) << Log();
      ExpectSame({file, "manifest.json"});
    }
  }
  EXPECT_GT(num_failed_, 6) << "the faults must bite";
}

TEST_F(FailingDisk, ARepairLosesNoLine) {
  ASSERT_EQ(Run("run --hand tum --object golf_ball --trials 4 --jobs 1 --out whole"), 0) << Log();
  const std::string text = ReadFile(top_ / "whole" / "journal" / "0.jsonl");
  const size_t end = text.find('\n') + 1;
  std::string damaged = text.substr(0, end);
  damaged[end / 2] ^= 1;
  fault_probability_ = "0.1";
  for (int attempt = 0; attempt < 12; ++attempt) {
    fs::remove_all(top_ / "out");
    fs::copy(top_ / "whole", top_ / "out", fs::copy_options::recursive);
    const fs::path journal = top_ / "out" / "journal" / "0.jsonl";
    WriteFile(journal, damaged + text.substr(end));
    num_failed_ += Run("verify out --repair", 501 + attempt) != 0;
    EXPECT_EQ(Run("verify out --repair"), 0) << Log();
    EXPECT_EQ(ReadFile(journal), text.substr(end));
    EXPECT_NE(ReadFile(journal.string() + ".damaged").find(damaged), std::string::npos);
  }
  EXPECT_GT(num_failed_, 3) << "the faults must bite";
}

}  // namespace
}  // namespace graspbench
