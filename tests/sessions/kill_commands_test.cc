/** @file
Every command that works on a finished session, and an optimisation, killed at random moments:
started again it ends with the bytes of one that was left alone, and nothing counts as damaged. */

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "core/base/random.h"
#include "tests/support/store_results.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

struct Command {
  std::string name;                    ///< before the folder
  std::vector<std::string> arguments;  ///< behind it
};

std::ostream& operator<<(std::ostream& out, const Command& command) { return out << command.name; }

class GRASPBENCH_SUITE : public testing::TestWithParam<Command> {
 protected:
  void SetUp() override {
    top_ = fs::path(testing::TempDir()) /
           ("kill_" + GetParam().name + "_" + std::to_string(::getpid()));
    fs::remove_all(top_);
    fs::create_directories(top_);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(top_);
  }
  /** Whether the command makes its folder, and does not work in that of a session. */
  static bool IsNew() {
    const std::string& name = GetParam().name;
    return name == "optimise" || name == "sweep" || name == "basin";
  }
  std::vector<std::string> MakeLine(const fs::path& folder) const {
    std::vector<std::string> line = {GetParam().name};
    if (IsNew()) line.push_back("--out");
    line.push_back(folder.string());
    line.insert(line.end(), GetParam().arguments.begin(), GetParam().arguments.end());
    return line;
  }
  fs::path top_;
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
    EXPECT_EQ(WaitFor(Start({"verify", killed.string()})), 0);
  };

  // What is killed is continued by the next attempt, until one ends: the next begins anew. When even
  // such a one was too fast, machines have become less busy, and the kills have to come earlier.
  double latest = 0.9 * std::chrono::duration<double>(Clock::now() - start).count();
  RandomStream moments("kill " + GetParam().name, "moment");
  constexpr int kMostAttempts = 4 * GRASPBENCH_NUM_KILLS + 20;
  int num_kills = 0;
  bool is_new = true;
  for (int attempt = 0; num_kills < GRASPBENCH_NUM_KILLS && attempt < kMostAttempts; ++attempt) {
    if (is_new) begin(killed);
    const auto is_time = [] { return true; };
    if (KillAfter(Start(MakeLine(killed)), is_time, latest * moments.NextUniform(0.0, 1.0))) {
      ++num_kills;
      is_new = false;
      if (!fs::exists(killed / "manifest.json")) continue;
      const int state = WaitFor(Start({"verify", killed.string()}));
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

INSTANTIATE_TEST_SUITE_P(
    Commands, GRASPBENCH_SUITE,
    testing::Values(Command{"judge", {}},
                    Command{"sensitivity",
                            {"--set", "model.mass_scale=2", "--set", "model.joint_error_scale=0"}},
                    Command{"check-numerics", {}}, Command{"simultaneity", {"--delay"}},
                    Command{"basin", {"--hand", "tum", "--object", "golf_ball", "--samples", "8"}},
                    Command{"sweep",
                            {"--hand", "tum", "--object", "golf_ball,tea_light", "--trials", "2",
                             "--factor", "model.mass_scale=1,2", "--factor", "delay.last=0,0.1",
                             "--resume"}},
                    Command{"export", {"--records"}}, Command{"report", {}},
                    Command{"optimise",
                            {"--hand", "tum", "--object", "golf_ball", "--evaluations", "4",
                             "--fitness-trials", "1"}}),
    [](const auto& instance) {
      std::string name = instance.param.name;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace graspbench
