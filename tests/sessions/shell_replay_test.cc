/** @file
The log of a shell is a script: run again it gives the same bytes, also when the shell was killed. */

#include <fcntl.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/sessions/test_folder.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** Two hundred commands, some of them wrong, in trials that are short. */
std::string MakeScript() {
  std::ostringstream script;
  script << "set -e off\n";  // "frobnicate" is refused
  script << "set strategy.hold_time_s 0.2\nset strategy.lift_time_s 0.2\nset sim.step_s 0.002\n"
            "set strategy.placing_time_s 0.1\n\n# a remark\n";
  int num_lines = 7;
  for (int round = 0; num_lines < 200; ++round) {
    for (const std::string& line : {"draw " + std::to_string(round),
                                    std::string("run to closure"),
                                    "step " + std::to_string(3 + round),
                                    std::string("joints"),
                                    "joint FFq2 " + std::to_string(20 + round),
                                    std::string("goto 0.4s"),
                                    std::string("drive THq2 30"),
                                    std::string("contacts"),
                                    std::string("run"),
                                    std::string("why"),
                                    std::string("back 0.05"),
                                    std::string("stability"),
                                    std::string("undo"),
                                    std::string("frobnicate"),
                                    "move " + std::to_string(round) + " -2",
                                    "note round " + std::to_string(round),
                                    std::string("move hand 0 0 1"),
                                    std::string("timing"),
                                    std::string("undo"),
                                    std::string("diff")}) {
      if (num_lines++ < 200) script << line << "\n";
    }
  }
  return script.str();
}

class ShellReplay : public testing::Test {
 protected:
  ShellReplay() { WriteFileAtomically(top_ / "script", MakeScript()); }
  /** `graspbench shell`, with a script from stdin. */
  pid_t StartShell(const fs::path& script, const fs::path& log, const fs::path& out) const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    ::dup2(::open(script.c_str(), O_RDONLY), 0);
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
    ::dup2(::open("/dev/null", O_WRONLY), 2);
    ::execl(GRASPBENCH_PROGRAM, GRASPBENCH_PROGRAM, "shell", "--log", log.c_str(), nullptr);
    ::_exit(127);
  }
  static long CountLinesOf(const fs::path& file) {
    if (!fs::exists(file)) return 0;
    const std::string text = ReadFile(file);
    return std::count(text.begin(), text.end(), '\n');
  }

  const TestFolder own_{"shell_replay"};
  const fs::path& top_ = own_.path();
};

TEST_F(ShellReplay, ALogGivesTheSameBytes) {
  EXPECT_EQ(WaitFor(StartShell(top_ / "script", top_ / "log", top_ / "out")), 2);  // frobnicate
  ExpectSameFile(top_ / "script", top_ / "log");
  EXPECT_EQ(CountLinesOf(top_ / "log"), 200);
  EXPECT_EQ(WaitFor(StartShell(top_ / "log", top_ / "log2", top_ / "again")), 2);
  ExpectSameFile(top_ / "out", top_ / "again");
  ExpectSameFile(top_ / "log", top_ / "log2");
  EXPECT_GT(ReadFile(top_ / "out").size(), 10000u);
}

TEST_F(ShellReplay, TheLogOfAKilledShellIsWholeToTheLastCommand) {
  const std::string script = MakeScript();
  int num_kills = 0;
  for (const long at : {1, 23, 60, 117, 171}) {
    const fs::path log = top_ / ("log" + std::to_string(at)), out = top_ / "out";
    const pid_t shell = StartShell(top_ / "script", log, out);
    num_kills += KillAfter(
        shell, [&] { return CountLinesOf(log) >= at; }, 0.0);
    const std::string kept = ReadFile(log);
    ASSERT_GE(CountLinesOf(log), at);
    EXPECT_EQ(kept.back(), '\n');
    EXPECT_EQ(script.compare(0, kept.size(), kept), 0) << at;
    const fs::path again = top_ / "again";
    WaitFor(StartShell(log, top_ / ("replayed" + std::to_string(at)), again));
    const std::string before = ReadFile(out), after = ReadFile(again);
    EXPECT_EQ(after.compare(0, before.size(), before), 0) << at;  // the last one was cut short
  }
  EXPECT_GT(num_kills, 0);
}

}  // namespace
}  // namespace graspbench
