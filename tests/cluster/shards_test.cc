/** @file
A session or campaign that several processes work on, in any order, some of them twice, some of them
killed, has the same results, byte for byte, as one that ran in a single process. */

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** Both hands and two objects, trials as short as they can be. */
std::vector<std::string> MakeSession(int trials) {
  return {"run",
          "--object",
          "golf_ball,tea_light",
          "--trials",
          std::to_string(trials),
          "--set",
          "sim.step_s=0.004",
          "--set",
          "strategy.hold_time_s=0.2"};
}

std::vector<std::string> Join(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/** Two scenes that learn as little as they can, and two searches. */
std::vector<std::string> MakeCampaign() {
  std::vector<std::string> arguments = {"campaign",
                                        "--hand",
                                        "tum",
                                        "--object",
                                        "golf_ball,tea_light",
                                        "--evaluations",
                                        "2",
                                        "--fitness-trials",
                                        "1",
                                        "--trials",
                                        GRASPBENCH_BENCHMARK_TRIALS};
  for (const char* setting :
       {"session.sim.step_s=0.004", "session.strategy.hold_time_s=0.2", "optimise.choice_trials=1",
        "optimise.check_pairs=20", "comparison.scenes=tum/tea_light",
        "comparison.methods=es,random", "comparison.seeds=1", "comparison.evaluations=3"}) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  return arguments;
}

/** Everything that is not a journal of workers, a seal of those or a clock. */
std::vector<fs::path> ListCampaignResults(const fs::path& campaign) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(campaign)) {
    const fs::path path = entry.path().lexically_relative(campaign);
    const std::string top = path.begin()->string(), name = path.filename().string();
    const std::string inner = path.parent_path().filename().string();
    const bool is_of_workers = inner == "journal" || inner == "judge" || inner == "progress" ||
                               inner == "workers" || (name == "manifest.json" && top != "scenes") ||
                               name == "run.json";
    if (entry.is_regular_file() && !is_of_workers) files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  return files;
}

int Call(const std::vector<std::string>& arguments) { return WaitFor(Start(arguments)); }

std::vector<std::string> WorkOn(const fs::path& folder, int number, int count) {
  return {"work", folder.string(), "--shard", std::to_string(number) + "/" + std::to_string(count)};
}

class GRASPBENCH_SUITE : public testing::Test {
 protected:
  GRASPBENCH_SUITE()
      : top_(fs::path(testing::TempDir()) /
             (std::string("shards_") +
              testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
              std::to_string(::getpid()))),
        random_(top_.filename().string().substr(0, 12), "shards") {
    fs::remove_all(top_);
    fs::create_directories(top_);
  }
  ~GRASPBENCH_SUITE() override {
    if (!HasFailure()) fs::remove_all(top_);
  }

  /** @param trials  of each hand and object. */
  void RunWhole(int trials) {
    trials_ = trials;
    ASSERT_EQ(Call(Join(MakeSession(trials), {"--jobs", "2", "--out", whole().string()})), 0);
  }
  fs::path MakePlan(const std::string& name) {
    const fs::path folder = top_ / name;
    EXPECT_EQ(Call(Join(MakeSession(trials_), {"--plan-only", "--out", folder.string()})), 0);
    return folder;
  }
  /** Kills workers at random points. */
  void KillSome(const fs::path& folder, int count) {
    for (int kill = 0; kill < GRASPBENCH_NUM_KILLS / 2; ++kill) {
      const int num_lines = CountLines(folder) + random_.NextIndex(8);
      KillAfter(
          Start(WorkOn(folder, 1 + random_.NextIndex(count), count)),
          [&] { return CountLines(folder) >= num_lines; }, random_.NextUniform(0.0, 0.3));
    }
  }
  std::vector<int> Shuffle(int count) {
    std::vector<int> numbers(static_cast<size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 1);
    for (int i = count - 1; i > 0; --i) {
      std::swap(numbers[static_cast<size_t>(i)],
                numbers[static_cast<size_t>(random_.NextIndex(i + 1))]);
    }
    return numbers;
  }
  /** All of it, once and for all: what a reader of the folder sees. */
  void ExpectSameResults(const fs::path& folder) {
    for (const fs::path& of : {whole(), folder}) {
      ASSERT_EQ(Call({"export", of.string(), "--records"}), 0);
    }
    for (const char* file : {"session.json", "plan.jsonl", "export/trials.csv", "export/events.csv",
                             "export/records.jsonl", "index.sqlite", "report/index.html"}) {
      ExpectSameFile(whole() / file, folder / file);
    }
    EXPECT_EQ(Call({"verify", folder.string()}), 0);
  }
  fs::path whole() const { return top_ / "whole"; }

  const fs::path top_;
  RandomStream random_;
  int trials_ = 4;
};

// Every second shard on another disk, every third on both.
TEST_F(GRASPBENCH_SUITE, InAnyOrderAndSomeTwiceGiveTheBytesOfOneRun) {
  RunWhole(13);
  for (const int count : std::vector<int>{GRASPBENCH_SHARD_COUNTS}) {
    const std::string name = std::to_string(count);
    const fs::path here = MakePlan("here" + name), there = MakePlan("there" + name);
    for (const int number : Shuffle(count)) {
      if (number % 2 == 0 || number % 3 == 0) {
        ASSERT_EQ(Call(WorkOn(there, number, count)), 0);
      }
      if (number % 2 != 0 || number % 3 == 0) {
        ASSERT_EQ(Call(WorkOn(here, number, count)), 0);
      }
    }
    const fs::path copy = top_ / ("copy" + name);
    fs::copy(there, copy, fs::copy_options::recursive);
    ASSERT_EQ(Call({"merge", here.string(), there.string()}), 0);
    ExpectSameResults(here);
    if (count != 7) continue;
    ASSERT_EQ(Call({"merge", here.string(), there.string()}), 0);  // once more changes nothing
    ExpectSameResults(here);
    ASSERT_EQ(Call({"merge", copy.string(), here.string()}), 0);  // nor does the other way round
    ExpectSameResults(copy);
  }
}

TEST_F(GRASPBENCH_SUITE, KilledAtRandomAndContinuedGiveTheBytesOfOneRun) {
  RunWhole(8);
  constexpr int kCount = 7;
  const fs::path folder = MakePlan("killed");
  int num_kills = 0;
  bool is_merged = false;
  for (int attempt = 0; attempt < 4 * GRASPBENCH_NUM_KILLS && num_kills < GRASPBENCH_NUM_KILLS;
       ++attempt) {
    const int number = 1 + random_.NextIndex(kCount);
    const int num_lines = CountLines(folder / "journal") + random_.NextIndex(3);
    num_kills += KillAfter(
        Start(WorkOn(folder, number, kCount)),
        [&] { return CountLines(folder / "journal") >= num_lines; }, random_.NextUniform(0.0, 0.3));
    if (num_kills == 0 || std::exchange(is_merged, true)) continue;
    EXPECT_EQ(Call({"merge", folder.string()}), 75);  // as it is, and the workers go on
  }
  EXPECT_GE(num_kills, GRASPBENCH_NUM_KILLS / 2);
  for (const int number : Shuffle(kCount)) ASSERT_EQ(Call(WorkOn(folder, number, kCount)), 0);
  ASSERT_EQ(Call({"merge", folder.string()}), 0);
  ExpectSameResults(folder);
}

TEST_F(GRASPBENCH_SUITE, JudgeTheBytesOfOneJudge) {
  RunWhole(2);
  ASSERT_EQ(Call({"judge", whole().string()}), 0);
  const fs::path folder = MakePlan("judged"), other = top_ / "other";
  for (const int number : Shuffle(3)) ASSERT_EQ(Call(WorkOn(folder, number, 3)), 0);
  ASSERT_EQ(Call({"merge", folder.string()}), 0);
  fs::copy(folder, other, fs::copy_options::recursive);
  const auto judge = [](const fs::path& in, int number) {
    return Join(WorkOn(in, number, 3), {"--judge"});
  };
  for (int kill = 0; kill < GRASPBENCH_NUM_KILLS; ++kill) {
    const int num_lines = CountLines(folder / "judge") + random_.NextIndex(2);
    KillAfter(
        Start(judge(folder, 1 + random_.NextIndex(3))),
        [&] { return CountLines(folder / "judge") >= num_lines; }, random_.NextUniform(0.0, 0.5));
  }
  for (const int number : {3, 1}) ASSERT_EQ(Call(judge(folder, number)), 0);
  for (const int number : {2, 3}) ASSERT_EQ(Call(judge(other, number)), 0);
  ASSERT_EQ(Call({"merge", folder.string(), other.string()}), 0);
  ExpectSameResults(folder);
}

TEST_F(GRASPBENCH_SUITE, ShardsOfTwoDealsAreHarmlessDuplicates) {
  RunWhole(trials_);
  const fs::path folder = MakePlan("mixed");
  for (const int number : {1, 2}) ASSERT_EQ(Call(WorkOn(folder, number, 2)), 0);
  ASSERT_EQ(Call(WorkOn(folder, 3, 7)), 0);
  ASSERT_EQ(Call({"merge", folder.string()}), 0);
  ExpectSameResults(folder);
}

TEST_F(GRASPBENCH_SUITE, LocalEngineWorksAndMerges) {
  RunWhole(trials_);
  const fs::path folder = MakePlan("local");
  ASSERT_EQ(Call({"submit", folder.string(), "--engine", "local", "--array", "3"}), 0);
  ExpectSameResults(folder);
}

TEST_F(GRASPBENCH_SUITE, SecondWorkerOfAShardLeaves) {
  const fs::path folder = MakePlan("twice");
  const pid_t first = Start(WorkOn(folder, 1, 1));
  while (CountLines(folder / "journal") == 0 && !HasEnded(first)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(Call(WorkOn(folder, 1, 1)), 5);
  ::kill(first, SIGTERM);
  EXPECT_EQ(WaitFor(first), 75);
  EXPECT_EQ(Call(WorkOn(folder, 1, 1)), 0);
}

TEST_F(GRASPBENCH_SUITE, TermOnSubmitEndsItsWorkers) {
  RunWhole(trials_);
  const fs::path folder = MakePlan("terminated");
  const std::vector<std::string> submit = {"submit", folder.string(), "--engine",
                                           "local",  "--array",       "4"};
  const pid_t script = Start(submit);
  while (CountLines(folder / "journal") == 0 && !HasEnded(script)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ::kill(script, SIGTERM);
  EXPECT_EQ(WaitFor(script), 75);
  const int num_lines = CountLines(folder / "journal");
  EXPECT_LT(num_lines, 4 * trials_);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(CountLines(folder / "journal"), num_lines);  // nobody works any more
  ASSERT_EQ(Call(submit), 0);
  ExpectSameResults(folder);
}

// Scenes and searches on two disks, in any order, some twice, some killed; then the benchmark.
TEST_F(GRASPBENCH_SUITE, CampaignTheBytesOfOneCampaign) {
  ASSERT_EQ(Call(Join(MakeCampaign(), {"--jobs", "1", "--out", whole().string()})), 0);
  const std::vector<fs::path> files = ListCampaignResults(whole());
  EXPECT_GT(files.size(), 20u);
  for (const int count : std::vector<int>{GRASPBENCH_CAMPAIGN_SHARD_COUNTS}) {
    const std::string name = std::to_string(count);
    const fs::path here = top_ / ("here" + name), there = top_ / ("there" + name);
    ASSERT_EQ(Call(Join(MakeCampaign(), {"--plan-only", "--out", here.string()})), 0);
    fs::copy(here, there, fs::copy_options::recursive);
    KillSome(here, count);
    for (const int number : Shuffle(count)) {
      if (number % 2 == 0) {
        ASSERT_EQ(Call(WorkOn(there, number, count)), 0);
      }
      if (number % 2 != 0) {
        ASSERT_EQ(Call(WorkOn(here, number, count)), 0);
      }
    }
    ASSERT_EQ(Call({"merge", here.string(), there.string()}), 75);  // the benchmark is to be run
    KillSome(here, count);
    for (const int number : Shuffle(count)) ASSERT_EQ(Call(WorkOn(here, number, count)), 0);
    ASSERT_EQ(Call(WorkOn(here, 1, count)), 0);
    ASSERT_EQ(Call({"merge", here.string(), there.string()}), 0);
    EXPECT_EQ(ListCampaignResults(here), files);
    for (const fs::path& file : files) ExpectSameFile(whole() / file, here / file);
    EXPECT_EQ(Call({"verify", here.string()}), 0);
  }
}

// Two machines that round differently, by a changed line of one's sentinels.
TEST_F(GRASPBENCH_SUITE, MergeNamesTheMachineWhoseSentinelsDiffer) {
  const fs::path folder = MakePlan("machines");
  const fs::path other = MakePlan("other machine");
  ASSERT_EQ(Call(WorkOn(other, 2, 3)), 0);
  for (const int number : {1, 3}) ASSERT_EQ(Call(WorkOn(folder, number, 3)), 0);
  const fs::path log = other / "workers" / "2of3-0.jsonl";
  const std::string text = ReadFile(log);
  std::string line = text.substr(0, text.find('\n'));
  const auto replace = [&line](const std::string& from, const std::string& to) {
    const size_t at = line.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    line.replace(at, line.find_first_of(",}", at + from.size()) - at, to);
  };
  replace("\"host\":", "\"host\":\"zeta\"");
  replace("\"processor_flags\":", "\"processor_flags\":\"00000000000000ff\"");
  replace("\"lift_height_m\":", "\"lift_height_m\":0.0625");
  const std::string body = line.substr(0, line.rfind(",\"xxh64\":\""));
  WriteFile(log, body + ",\"xxh64\":\"" + CalcHashHex(body) + "\"}\n");
  ASSERT_EQ(Call({"merge", folder.string(), other.string()}), 0);
  const std::string report = ReadFile(folder / "report" / "index.html");
  const size_t said = report.find("zeta (");
  ASSERT_NE(said, std::string::npos);
  EXPECT_NE(report.find("lift_height_m: 0.0625 and ", said), std::string::npos);
  EXPECT_NE(report.find("1 of ", said), std::string::npos);
}

}  // namespace
}  // namespace graspbench
