/** @file
A session of 100,000 judged trials, one of many objects, a long script of the shell, many grasps of
others: how much memory and page they take. The 100,000 trials are real ones multiplied under the
ids of a plan, because to simulate them takes hours. */

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <map>
#include <tuple>

#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"
#include "datasets/records/trial_record.h"
#include "datasets/session/session_store.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** Runs the program, which must end with 0. @returns the most memory it held [bytes]. */
long MeasureMemory(const std::vector<std::string>& arguments) {
  const pid_t child = Start(arguments);
  int status = 0;
  struct rusage usage {};
  ::wait4(child, &status, 0, &usage);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << arguments[0];
  return usage.ru_maxrss * 1024;
}

/** Finishes the session in `large` with the results and judgements of `small`, cell by cell. */
void MultiplyRecords(const fs::path& small, const fs::path& large) {
  const Session from = LoadSession(small);
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<TrialRecord>> cells;
  for (const TrialRecord& record : from.records) {
    cells[{record.plan.hand, record.plan.object, record.plan.grasp}].push_back(record);
  }
  const Session to = LoadSession(large);
  std::string lines[2], judgements[2];
  for (size_t i = 0; i < to.plan.size(); ++i) {
    const PlannedTrial& planned = to.plan[i];
    const auto& records = cells.at({planned.hand, planned.object, planned.grasp});
    TrialRecord record = records[static_cast<size_t>(planned.trial) % records.size()];
    record.plan = planned;
    lines[i % 2] += FormatJournalLine(record) + "\n";
    if (record.judgement) {
      judgements[i % 2] += FormatJudgementLine(planned.id, *record.judgement) + "\n";
    }
  }
  for (const int worker : {0, 1}) {
    AppendFile(FindJournal(large / "journal", worker, "")).Append(lines[worker]);
    if (judgements[worker].empty()) continue;
    fs::create_directories(large / "judge");
    AppendFile(FindJournal(large / "judge", worker, "")).Append(judgements[worker]);
  }
}

class Scale : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("scale_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }
  fs::path folder_;
};

TEST_F(Scale, AHundredThousandJudgedTrialsTakeThreeHundredMegabytesAndAPageOfTen) {
  const std::string small = (folder_ / "small").string(), large = (folder_ / "large").string();
  const std::vector<std::string> session = {"run", "--object", "can,golf_ball,pencil", "--out"};
  const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = session;
    arguments.push_back(out);
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(WaitFor(Start(arguments)), 0);
  };
  run(small, {"--trials", "4"});
  ASSERT_EQ(WaitFor(Start({"judge", small})), 0);
  run(large, {"--trials", "16667", "--plan-only"});
  MultiplyRecords(small, large);
  constexpr long kMost = 300'000'000;
  EXPECT_LE(MeasureMemory({"export", large}), kMost);
  EXPECT_LE(MeasureMemory({"report", large}), kMost);
  EXPECT_LE(MeasureMemory({"run", "--resume", "--out", large}), kMost);
  EXPECT_LE(fs::file_size(fs::path(large) / "report" / "index.html"), 10'000'000u);
}

/** Of 10,000 objects; 1,000 are tried, because each needs a distance field of its own. */
TEST_F(Scale, AThousandObjectsTakeATenthOfAGigabyteMoreThanTwo) {
  std::string names;
  for (int i = 0; i < 1000; ++i) {
    const fs::path object = folder_ / "objects" / ("block" + std::to_string(i));
    fs::create_directories(object);
    const double side = 0.03 + 1e-6 * i;
    WriteFile(object / "block.obj", FormatObj(MakeRoundedBox({side, side, 0.05}, 0.003), 1e3));
    WriteFile(object / "object.yaml",
              "name: block\nmesh: block.obj\nmesh_unit: mm\nmass_kg: 0.05\n"
              "friction_static: 0.5\nfriction_dynamic: 0.4\n");
    names += (i > 0 ? "," : "") + object.string();
  }
  const std::string two = names.substr(0, names.find(',', names.find(',') + 1));
  const auto measure = [&](const std::string& objects, const std::string& out) {
    return MeasureMemory({"run", "--hand", "tum", "--trials", "1", "--grasp", "predicted",
                          "--object", objects, "--out", (folder_ / out).string()});
  };
  const long few = measure(two, "two"), many = measure(names, "thousand");
  EXPECT_LE(many - few, 100'000'000) << few << " and " << many;
}

/** A tenth of the work takes as much memory as all of it: what grows with work is a leak. */
TEST_F(Scale, TwentyThousandCommandsOfTheShellTakeAsMuchAsTwoThousand) {
  const std::vector<std::string> cheap = {"step", "scene",  "contacts", "step",  "step",
                                          "diff", "joints", "history",  "reset", "step"};
  const std::vector<std::string> dear = {"undo", "redo", "run"};  // one each of a hundred
  const auto measure = [&](int num_commands) {
    std::string typed = "set -e off\nhand tum\nobject golf_ball\n";
    for (int i = 0; i < num_commands; ++i) {
      const size_t in_hundred = static_cast<size_t>(i) % 100;
      const std::string& command = in_hundred < 97 ? cheap[in_hundred % 10] : dear[in_hundred - 97];
      typed +=
          (in_hundred % 10 == 0 ? "set model.mass_scale 1." + std::to_string(i % 300) : command) +
          "\n";
    }
    WriteFile(folder_ / "typed", typed);
    return MeasureMemory({"shell", (folder_ / "typed").string()});
  };
  const long few = measure(2000), many = measure(20000);
  EXPECT_LE(many - few, 10'000'000) << few << " and " << many;
}

TEST_F(Scale, FiveThousandGraspsOfOthersTakeLittleMoreThanFiveHundred) {
  const std::string gripper = (folder_ / "gripper").string();
  ASSERT_EQ(WaitFor(Start({"new", "hand", gripper})), 0);
  const auto measure = [&](int num_grasps) {
    std::string grasps =
        "format: isaac_grasp\nformat_version: 1.0\nobject_frame: toy_cube\ngripper_frame: palm\n"
        "grasps:\n";
    for (int i = 0; i < num_grasps; ++i) {
      grasps +=
          "  g" + std::to_string(i) +
          ": {confidence: 1.0, position: [0, 0, -0.07], orientation: {w: 1, xyz: [0, 0, 0]},\n"
          "    pregrasp_cspace_position: {thumb_joint: 0.1, index_joint: 0.1},\n"
          "    cspace_position: {thumb_joint: " +
          std::to_string(0.4 + 1e-4 * (i % 2000)) + ", index_joint: 0.6}}\n";
    }
    const fs::path file = folder_ / (std::to_string(num_grasps) + ".yaml");
    WriteFile(file, grasps);
    return MeasureMemory({"grasps", "judge", file.string(), "--hand-frame", "palm",
                          "--object-frame", "mesh", "--hand", gripper, "--profile", "own", "--out",
                          (folder_ / std::to_string(num_grasps)).string()});
  };
  const long few = measure(500), many = measure(5000);
  EXPECT_LE(many - few, 100'000'000) << few << " and " << many;
}

}  // namespace
}  // namespace graspbench
