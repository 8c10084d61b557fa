/** @file
Commands under a limit of address space end well, or with 5 and a sentence: no signal, no record
that says of a trial what is true of the machine alone. */

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/base/files/files.h"
#include "tests/sessions/test_folder.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class GRASPBENCH_SUITE : public testing::TestWithParam<int> {
 protected:
  /** @param limit  of address space [MB]; 0: none.
  @returns the exit code, or the signal with a minus. */
  int Run(const std::string& arguments, int limit) const {
    const std::string bound = limit > 0 ? "ulimit -v " + std::to_string(limit * 1024) + " && " : "";
    const std::string line = "cd '" + top_.string() + "' && " + bound + "exec '" +
                             GRASPBENCH_PROGRAM + "' " + arguments + " > log 2>&1";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  /** Exit code 0, or 5 with words about memory. */
  bool EndsWell(const std::string& arguments) const {
    const int code = Run(arguments, GetParam());
    const std::string log = ReadFile(top_ / "log");
    const bool is_said = log.find("memory") != log.npos || log.find("thread") != log.npos ||
                         log.find("ulimit") != log.npos;
    EXPECT_TRUE(code == 0 || (code == 5 && is_said)) << arguments << ": " << code << "\n" << log;
    return code == 0;
  }

  const TestFolder own_{"scarce_memory_" + std::to_string(GetParam())};
  const fs::path& top_ = own_.path();
};

TEST_P(GRASPBENCH_SUITE, IsNoOutcomeOfATrial) {
  const std::string run = "run --hand tum --object can --grasp g3 --trials 2 --jobs 2 --out s";
  if (EndsWell(run)) {
    const std::string page = ReadFile(top_ / "s/report/index.html");
    EXPECT_NE(page.find("image/webp") == page.npos,
              page.find("no pictures could be drawn") == page.npos);
  }
  const bool is_begun = fs::exists(top_ / "s/session.json");
  EXPECT_EQ(Run(is_begun ? run + " --resume" : run, 0), 0) << ReadFile(top_ / "log");
  EXPECT_EQ(ReadFile(top_ / "s/export/trials.csv").find("numerical failure"), std::string::npos);
  const bool is_drawn = EndsWell("trial s tum-can-g3:0 --render trial.png");
  EndsWell("trial s tum-can-g3:0 --page trial.html");
  if (GetParam() >= 700) {
    EXPECT_TRUE(is_drawn) << "enough for a small picture";
  }
  EXPECT_EQ(Run("verify s", 0), 0) << ReadFile(top_ / "log");
}

// At 100 MB the libraries do not fit: the loader ends it with 127 and a sentence of its own.
INSTANTIATE_TEST_SUITE_P(AddressSpace, GRASPBENCH_SUITE,
                         testing::Range(150, 901, GRASPBENCH_LIMIT_STEP));

}  // namespace
}  // namespace graspbench
