/** @file
Seven shards of every kind of session, worked on in random order and merged in another, are one
run, byte for byte but for journals and what names them. */

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/base/random.h"
#include "tests/sessions/test_folder.h"
#include "tests/support/store_results.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

constexpr int kNumShards = 7;

struct Kind {
  std::string name;
  std::vector<std::string> command;  ///< SESSION: a folder with a finished session
  std::string place;                 ///< of the store that is dealt, from that folder; a pattern
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

class ShardedKindsSlow : public testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    Run({"run", "--hand", "tum,shadow", "--object", "golf_ball,tea_light", "--trials", "3", "--out",
         (top_ / "begun").string()});
  }
  static void Run(const std::vector<std::string>& line) {
    const int code = WaitFor(Start(line));
    ASSERT_TRUE(code == 0 || code == 4) << code << " of " << line[0];
  }
  /** The kind's command in a folder of its own. @returns the store's folder. */
  fs::path RunKind(const std::string& name, bool plan_only) {
    const fs::path folder = top_ / name;
    const bool is_new = GetParam().place.empty();
    if (!is_new) fs::copy(top_ / "begun", folder, fs::copy_options::recursive);
    std::vector<std::string> line = GetParam().command;
    std::replace(line.begin(), line.end(), std::string("SESSION"), folder.string());
    if (plan_only && line[0] != "judge") line.push_back("--plan-only");
    if (!plan_only || line[0] != "judge") Run(line);
    if (GetParam().place.size() < 2) return folder;
    for (const auto& entry : fs::directory_iterator(folder / GetParam().place)) return entry.path();
    ADD_FAILURE() << "nothing in " << folder / GetParam().place;
    return folder;
  }
  const TestFolder own_{"shards_" + GetParam().name};
  const fs::path& top_ = own_.path();
};

TEST_P(ShardedKindsSlow, AreOneRun) {
  RunKind("whole", false);
  const fs::path planned = RunKind("planned", true);
  std::vector<int> order(kNumShards);
  std::iota(order.begin(), order.end(), 1);
  RandomStream random("shards " + GetParam().name, "order");
  const auto shuffle = [&] {
    for (size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[static_cast<size_t>(random.NextIndex(static_cast<int>(i)))]);
    }
  };
  shuffle();
  for (const int number : order) {
    const fs::path machine = top_ / ("machine" + std::to_string(number));
    fs::copy(planned, machine, fs::copy_options::recursive);
    std::vector<std::string> line = {"work", machine.string(), "--shard",
                                     std::to_string(number) + "/" + std::to_string(kNumShards)};
    if (GetParam().command[0] == "judge") line.push_back("--judge");
    Run(line);
  }
  shuffle();
  std::vector<std::string> merge = {"merge", planned.string()};
  for (const int number : order) {
    merge.push_back((top_ / ("machine" + std::to_string(number))).string());
  }
  Run(merge);
  Run({"verify", planned.string()});
  // The command itself finds nothing left to do, and makes what it makes of the whole.
  std::vector<std::string> again = GetParam().command;
  std::replace(again.begin(), again.end(), std::string("SESSION"), (top_ / "planned").string());
  if (again[0] == "run") again = {"report", planned.string()};
  if (again[0] == "sweep") again.push_back("--resume");
  Run(again);
  ExpectSameResults(top_ / "whole", top_ / "planned");
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ShardedKindsSlow,
    testing::Values(Kind{"run",
                         {"run", "--hand", "tum,shadow", "--object", "golf_ball,tea_light",
                          "--trials", "4", "--out", "SESSION"},
                         ""},
                    Kind{"judge", {"judge", "SESSION"}, "."},
                    Kind{"sensitivity",
                         {"sensitivity", "SESSION", "--set", "model.mass_scale=2", "--set",
                          "model.joint_error_scale=0"},
                         "sensitivity"},
                    Kind{"numerics", {"check-numerics", "SESSION", "--trials", "1"}, "numerics"},
                    Kind{
                        "delay", {"simultaneity", "SESSION", "--delay", "--trials", "1"}, "delays"},
                    Kind{"thresholds", {"threshold", "SESSION", "--trials", "1"}, "thresholds"},
                    Kind{"basin",
                         {"basin", "--hand", "tum", "--object", "golf_ball", "--samples", "16",
                          "--out", "SESSION"},
                         ""},
                    Kind{"sweep",
                         {"sweep", "--hand", "tum", "--object", "golf_ball,tea_light", "--trials",
                          "2", "--factor", "model.mass_scale=1,2", "--factor", "delay.last=0,0.1",
                          "--out", "SESSION"},
                         ""}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace graspbench
