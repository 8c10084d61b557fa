/** @file
Every kind of command that makes a folder or works on a finished session, killed at random moments:
started again it ends with the bytes of one that was left alone, and nothing counts as damaged. */

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "core/base/random.h"
#include "tests/sessions/test_folder.h"
#include "tests/support/store_results.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

struct Command {
  std::vector<std::string> words;
  std::vector<std::string> arguments;  ///< behind the folder; TOP stands for that of the test
  const char* store = ".";             ///< what verify looks at, from the folder
};

std::ostream& operator<<(std::ostream& out, const Command& command) {
  for (const std::string& word : command.words) out << word << " ";
  return out;
}

const char kSessionFile[] = "hands: [tum]\nobjects: [golf_ball]\ntrials: 2\n";
const char kPipeline[] =
    "stages:\n"
    "  first:\n    command: run\n    inputs: {session: t.yaml}\n"
    "  second:\n    command: run\n    inputs: {session: t.yaml}\n    parameters: {seed: 7}\n";
const char kForeignGrasps[] =
    "format: isaac_grasp\nformat_version: 1.0\nobject_frame: toy_cube\ngripper_frame: palm\n"
    "grasps:\n";
/** One grasp in kForeignGrasps, of the hand that `new hand` makes. */
std::string FormatGrasp(int number) {
  return "  g" + std::to_string(number) +
         ": {confidence: 1.0, position: [0, 0, -0.07], orientation: {w: 1, xyz: [0, 0, 0]},\n"
         "    pregrasp_cspace_position: {thumb_joint: 0.1, index_joint: 0.1},\n"
         "    cspace_position: {thumb_joint: 0." +
         std::to_string(4 + number % 4) + ", index_joint: 0.6}}\n";
}

class GRASPBENCH_SUITE : public testing::TestWithParam<Command> {
 protected:
  void SetUp() override {
    WriteFile(top_ / "t.yaml", kSessionFile);
    WriteFile(top_ / "p.yaml", kPipeline);
    std::string grasps = kForeignGrasps;
    for (int i = 0; i < 8; ++i) grasps += FormatGrasp(i);
    WriteFile(top_ / "grasps.yaml", grasps);
    ASSERT_EQ(WaitFor(Start({"new", "hand", (top_ / "gripper").string()})), 0);
  }
  /** Whether the command makes its folder, and does not work in that of a session. */
  static bool IsNew() {
    const std::vector<std::string> others = {"judge",        "sensitivity", "check-numerics",
                                             "simultaneity", "export",      "report"};
    const std::vector<std::string>& words = GetParam().words;
    return words.size() > 1 || std::find(others.begin(), others.end(), words[0]) == others.end();
  }
  std::vector<std::string> MakeLine(const fs::path& folder) const {
    if (GetParam().words[0] == "run" && fs::exists(folder / "session.json")) {
      return {"run", "--resume", "--out", folder.string()};
    }
    std::vector<std::string> line = GetParam().words;
    if (IsNew()) line.push_back("--out");
    line.push_back(folder.string());
    for (std::string word : GetParam().arguments) {
      if (word.rfind("TOP/", 0) == 0) word = (top_ / word.substr(4)).string();
      line.push_back(word);
    }
    return line;
  }
  int Verify(const fs::path& folder) const {
    return WaitFor(Start({"verify", (folder / GetParam().store).string()}));
  }
  const TestFolder own_{"kill_" + GetParam().words.back()};
  const fs::path& top_ = own_.path();
};

TEST_P(GRASPBENCH_SUITE, EndsWithTheSameBytesWheneverItIsKilled) {
  using Clock = std::chrono::steady_clock;
  const fs::path begun = top_ / "begun", whole = top_ / "whole", killed = top_ / "killed";
  const auto begin = [&](const fs::path& folder) {
    fs::remove_all(folder);
    if (fs::exists(begun)) fs::copy(begun, folder, fs::copy_options::recursive);
  };
  if (!IsNew()) {
    ASSERT_EQ(WaitFor(Start({"run", "--hand", "tum", "--object", "golf_ball,tea_light", "--trials",
                             "2", "--out", begun.string()})),
              0);
  }
  begin(whole);
  const Clock::time_point start = Clock::now();
  ASSERT_EQ(WaitFor(Start(MakeLine(whole))), 0);
  const auto expect_whole = [&] {
    ExpectSameResults(whole, killed);
    EXPECT_EQ(Verify(killed), 0);
  };

  // What is killed is continued by the next attempt, until one ends: the next begins anew. When
  // even such a one was too fast, machines have become less busy, and the kills have to come
  // earlier.
  double latest = 0.9 * std::chrono::duration<double>(Clock::now() - start).count();
  RandomStream moments("kill " + GetParam().words.back(), "moment");
  constexpr int kMostAttempts = 4 * GRASPBENCH_NUM_KILLS + 20;
  int num_kills = 0;
  bool is_new = true;
  for (int attempt = 0; num_kills < GRASPBENCH_NUM_KILLS && attempt < kMostAttempts; ++attempt) {
    if (is_new) begin(killed);
    const auto is_time = [] { return true; };
    if (KillAfter(Start(MakeLine(killed)), is_time, latest * moments.NextUniform(0.0, 1.0))) {
      ++num_kills;
      is_new = false;
      if (!fs::exists(killed / GetParam().store / "manifest.json")) continue;
      const int state = Verify(killed);
      // 1: nothing is damaged, but pages are older than what was found since.
      EXPECT_TRUE(state == 0 || state == 1) << state << " after kill " << num_kills;
    } else {
      expect_whole();
      if (is_new) latest /= 2.0;
      is_new = true;
    }
  }
  EXPECT_EQ(num_kills, GRASPBENCH_NUM_KILLS);
  ASSERT_EQ(WaitFor(Start(MakeLine(killed))), 0);
  expect_whole();
}

const std::vector<Command>& ListCommands() {
  static const std::vector<Command> quick = {
      {{"judge"}, {}},
      {{"sensitivity"}, {"--set", "model.mass_scale=2", "--set", "model.joint_error_scale=0"}},
      {{"check-numerics"}, {}},
      {{"simultaneity"}, {"--delay"}},
      {{"basin"}, {"--hand", "tum", "--object", "golf_ball", "--samples", "8"}},
      {{"sweep"},
       {"--hand", "tum", "--object", "golf_ball,tea_light", "--trials", "2", "--factor",
        "model.mass_scale=1,2", "--factor", "delay.last=0,0.1", "--resume"}},
      {{"export"}, {"--records"}},
      {{"report"}, {}},
      {{"optimise"},
       {"--hand", "tum", "--object", "golf_ball", "--evaluations", "4", "--fitness-trials", "1"}},
      {{"pipeline", "run"}, {"TOP/p.yaml"}, "first"},
      {{"grasps", "judge"},
       {"TOP/grasps.yaml", "--hand-frame", "palm", "--object-frame", "mesh", "--hand",
        "TOP/gripper", "--profile", "own", "--jitter", "2"}}};
  if (GRASPBENCH_NUM_KILLS < 10) return quick;
  static const std::vector<Command> all = [] {
    std::vector<Command> commands = quick;
    commands.push_back({{"run"}, {"--hand", "tum", "--object", "golf_ball", "--trials", "6"}});
    commands.push_back({{"study", "demo"}, {"--replace"}});
    commands.push_back({{"campaign"},
                        {"--hand", "tum", "--object", "golf_ball", "--evaluations", "4",
                         "--fitness-trials", "1", "--trials", "2"}});
    commands.push_back(
        {{"map", "simultaneity"}, {"--hand", "tum", "--object", "golf_ball", "--quick"}});
    commands.push_back(
        {{"rehearse"},
         {"--hand", "tum", "--object", "golf_ball,can", "--candidates", "6", "--draws", "2"}});
    commands.push_back({{"hand", "develop"}, {"TOP/gripper", "--budget", "100"}, "development"});
    return commands;
  }();
  return all;
}

INSTANTIATE_TEST_SUITE_P(Commands, GRASPBENCH_SUITE, testing::ValuesIn(ListCommands()),
                         [](const auto& instance) {
                           std::string name;
                           for (const std::string& word : instance.param.words) {
                             name += (name.empty() ? "" : "_") + word;
                           }
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace graspbench
