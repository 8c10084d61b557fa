/** @file
Trials that do not end in time: the others are finished, and what did not end is named. */

#include <gtest/gtest.h>

#include <algorithm>

#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"
#include "tests/sessions/test_folder.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class EndlessTrial : public testing::Test {
 protected:
  static int Call(const std::vector<std::string>& arguments) { return WaitFor(Start(arguments)); }
  static std::vector<std::string> ReadLines(const fs::path& path) {
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  const TestFolder own_{"endless_trial"};
  const fs::path& top_ = own_.path();
};

// A cube that no hand can reach around ends at once. A ball that is held for a minute in steps of a
// tenth of a millisecond takes half a minute, too long for a limit of four seconds.
TEST_F(EndlessTrial, TheOthersAreFinishedAndItIsNamed) {
  const fs::path cube = top_ / "cube", out = top_ / "out";
  fs::create_directories(cube);
  WriteFile(cube / "cube.obj", FormatObj(MakeRoundedBox({0.4, 0.4, 0.4}, 0.01), 1e3));
  WriteFile(cube / "object.yaml",
            "name: cube\nmesh: cube.obj\nmesh_unit: mm\nmass_kg: 1\n"
            "friction_static: 0.5\nfriction_dynamic: 0.4\n");
  EXPECT_EQ(Call({"run",
                  "--hand",
                  "shadow",
                  "--object",
                  "golf_ball," + cube.string(),
                  "--trials",
                  "2",
                  "--preset",
                  "firm",
                  "--set",
                  "sim.step_s=0.0001",
                  "--set",
                  "strategy.hold_time_s=60",
                  "--set",
                  "sim.steady_step_factor=1",
                  "--trial-timeout",
                  "4",
                  "--jobs",
                  "2",
                  "--out",
                  out.string()}),
            4);
  const std::vector<std::string> rows = ReadLines(out / "export" / "trials.csv");
  ASSERT_EQ(rows.size(), 5u);  // with the heading
  int num_named = 0, num_others = 0;
  for (size_t i = 1; i < rows.size(); ++i) {
    const bool is_ball = rows[i].find(",golf_ball,") != std::string::npos;
    const bool is_named =
        rows[i].find("the trial did not end within 4.0 s and was abandoned") != std::string::npos;
    EXPECT_EQ(is_ball, is_named) << rows[i];
    (is_ball ? num_named : num_others) += 1;
    if (!is_ball) continue;
    const std::string page = ReadFile(out / "report" / "index.html");
    EXPECT_NE(page.find(rows[i].substr(0, 16)), std::string::npos) << "its id is on the page";
  }
  EXPECT_EQ(num_named, 2);
  EXPECT_EQ(num_others, 2);
  EXPECT_EQ(Call({"verify", out.string()}), 0);
}

TEST_F(EndlessTrial, AGraspWhoseTestDoesNotEndStaysUnjudgedUntilItDoes) {
  const fs::path whole = top_ / "whole", hurried = top_ / "hurried";
  ASSERT_EQ(Call({"run", "--hand", "tum", "--object", "golf_ball", "--trials", "2", "--out",
                  whole.string()}),
            0);
  fs::copy(whole, hurried, fs::copy_options::recursive);
  ASSERT_EQ(Call({"judge", whole.string()}), 0);
  EXPECT_EQ(Call({"judge", hurried.string(), "--trial-timeout", "0.001"}), 4);
  EXPECT_EQ(CountLines(hurried / "judge"), 0);
  ASSERT_EQ(Call({"judge", hurried.string()}), 0);
  ExpectSameFile(whole / "export" / "trials.csv", hurried / "export" / "trials.csv");
}

// None of its trials ends in time, and still the search comes to its end and names some.
TEST_F(EndlessTrial, AnOptimisationGoesOnAfterThem) {
  const fs::path out = top_ / "out";
  const std::vector<std::string> line = {"optimise", "--hand",    "tum",
                                         "--object", "golf_ball", "--evaluations",
                                         "4",        "--out",     out.string()};
  std::vector<std::string> hurried = line;
  hurried.insert(hurried.end(), {"--trial-timeout", "0.001"});
  EXPECT_EQ(Call(hurried), 4);
  const std::vector<std::string> answers = ReadLines(out / "journal.jsonl");
  ASSERT_GE(answers.size(), 4u);
  // Not every one: a trial may fail in less.
  const bool is_any_given_up =
      std::any_of(answers.begin(), answers.end(), [](const std::string& answer) {
        return answer.find("\"outcome\":\"numerical failure\"") != std::string::npos;
      });
  EXPECT_TRUE(is_any_given_up);
  EXPECT_EQ(Call(line), 4) << "what was answered once stays answered";
  EXPECT_EQ(ReadLines(out / "journal.jsonl"), answers);
  EXPECT_EQ(Call({"verify", out.string()}), 0);
}

TEST_F(EndlessTrial, StoppingDoesNotWaitForIt) {
  const fs::path out = top_ / "out";
  const pid_t child = Start({"campaign", "--hand", "tum", "--object", "golf_ball", "--evaluations",
                             "4", "--set", "session.sim.step_s=0.0001", "--set",
                             "session.strategy.hold_time_s=60", "--out", out.string()});
  while (!fs::exists(out / "scenes" / "tum-golf_ball" / "journal.jsonl") && !HasEnded(child)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const auto start = std::chrono::steady_clock::now();
  ::kill(child, SIGTERM);
  EXPECT_EQ(WaitFor(child), 75);
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - start;
  EXPECT_LT(duration.count(), 10.0);
  EXPECT_EQ(Call({"verify", out.string()}), 0);
}

}  // namespace
}  // namespace graspbench
