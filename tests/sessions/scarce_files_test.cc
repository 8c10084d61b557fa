/** @file
Files that cannot be had: under a limit of their size, with few descriptors, without a cache, and
with a fault at one operation after another (tests/support/fail_files.cc), each command ends well or
with 5 and a sentence, and the same command without the lack gives the bytes of an undisturbed one.
*/

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>

#include "tests/sessions/test_folder.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** A command of several words, and a file that it makes; OUT stands for its folder. */
struct WritingCommand {
  const char* name;
  std::vector<std::string> line;
  const char* file;
};
void PrintTo(const WritingCommand& command, std::ostream* out) { *out << command.name; }

const WritingCommand kCommands[] = {
    {"run",
     {"run", "--hand", "tum", "--object", "golf_ball", "--trials", "2", "--jobs", "1", "--out",
      "OUT"},
     "export/trials.csv"},
    {"export", {"export", "OUT", "--records"}, "export/records.jsonl"},
    {"replay", {"replay", "IN", "--all", "--trajectory", "csv", "--out", "OUT"}, "manifest.json"},
    {"judge", {"judge", "OUT", "--jobs", "1"}, "report/index.html"},
    {"report", {"report", "OUT"}, "report/index.html"},
    {"optimise",
     {"optimise", "--hand", "tum", "--object", "golf_ball", "--step", "2", "--evaluations", "2",
      "--fitness-trials", "1", "--jobs", "1", "--out", "OUT"},
     "result.json"}};

class GRASPBENCH_SUITE : public testing::TestWithParam<WritingCommand> {
 protected:
  /** @param lack  what the program has not, called in its process. @returns as WaitFor. */
  int Run(
      std::vector<std::string> line, const fs::path& out,
      const std::function<void()>& lack = [] {}) const {
    for (std::string& word : line) {
      if (word == "OUT") word = out.string();
      if (word == "IN") word = (top_ / "in").string();
    }
    const std::string log = (top_ / "log").string();
    return WaitFor(Start(line, [&] {
      std::freopen(log.c_str(), "w", stderr);
      std::freopen("/dev/null", "w", stdout);
      lack();
    }));
  }
  /** Exit code 0, or 5 with a sentence; then the command again, which is to give what it should. */
  void EndsWell(const std::string& what, const std::function<void()>& lack) {
    const fs::path out = top_ / "out";
    const int code = Run(GetParam().line, out, lack);
    const std::string log = ReadFile(top_ / "log");
    EXPECT_TRUE(code == 0 || (code == 5 && log.find("graspbench: ") != log.npos))
        << what << ": " << code << "\n"
        << log;
    num_failed_ += code != 0;
    if (code == 0 && fs::exists(out / GetParam().file)) return Renew();
    std::vector<std::string> again = GetParam().line;
    if (again[0] == "run" && fs::exists(out / "session.json")) again.push_back("--resume");
    EXPECT_EQ(Run(again, out), 0) << what << "\n" << ReadFile(top_ / "log");
    ExpectSameFile(top_ / "whole" / GetParam().file, out / GetParam().file);
    Renew();
  }
  /** What the command begins with. */
  void Renew() {
    const fs::path out = top_ / "out";
    fs::remove_all(out);
    if (works_in_session_) fs::copy(top_ / "in", out, fs::copy_options::recursive);
  }
  void SetUp() override {
    works_in_session_ = GetParam().line[1] == "OUT";
    if (works_in_session_ || GetParam().line[1] == "IN") {
      ASSERT_EQ(Run(kCommands[0].line, top_ / "in"), 0);
    }
    if (works_in_session_) fs::copy(top_ / "in", top_ / "whole", fs::copy_options::recursive);
    ASSERT_EQ(Run(GetParam().line, top_ / "whole"), 0) << ReadFile(top_ / "log");
    Renew();
  }

  const TestFolder own_{std::string("scarce_files_") + GetParam().name};
  const fs::path& top_ = own_.path();
  bool works_in_session_ = false;
  int num_failed_ = 0;
};

TEST_P(GRASPBENCH_SUITE, LimitOfSize) {
  for (const rlim_t size : {512, 4096, 16384}) {
    EndsWell("files of " + std::to_string(size) + " bytes", [size] {
      const rlimit limit = {size, size};
      ::setrlimit(RLIMIT_FSIZE, &limit);
    });
  }
  EXPECT_GT(num_failed_, 1) << "the limit must bite";
}

TEST_P(GRASPBENCH_SUITE, FewDescriptors) {
  for (const rlim_t count : {4, 5, 6, 8, 12, 16}) {
    EndsWell(std::to_string(count) + " descriptors", [count] {
      for (int inherited = 3; inherited < 256; ++inherited) ::close(inherited);  // of who tests
      const rlimit limit = {count, count};
      ::setrlimit(RLIMIT_NOFILE, &limit);
    });
  }
  EXPECT_GT(num_failed_, 0) << "the limit must bite";
}

TEST_P(GRASPBENCH_SUITE, NoCache) {
  EndsWell("no cache", [] { ::setenv("XDG_CACHE_HOME", "/dev/null/none", 1); });
  EXPECT_EQ(num_failed_, 0) << "a cache is no need";
}

TEST_P(GRASPBENCH_SUITE, EveryOperation) {
  const fs::path count_file = top_ / "count";
  const auto fail = [&](int operation, const char* reason) {
    return [&, operation, reason] {
      const std::string faults = "at " + std::to_string(operation) + " " + reason + " out";
      ::setenv("LD_PRELOAD", GRASPBENCH_FAIL_FILES, 1);
      ::setenv("GRASPBENCH_FAULTS", faults.c_str(), 1);
      ::setenv("GRASPBENCH_COUNT", count_file.c_str(), 1);
    };
  };
  ASSERT_EQ(Run(GetParam().line, top_ / "out", fail(0, "EIO")), 0);
  const int num_operations = std::stoi(ReadFile(count_file));
  EXPECT_GT(num_operations, 20);
  Renew();
  const int step = std::max(1, num_operations / GRASPBENCH_NUM_FAULTS);
  for (const char* reason : {"EIO", "ENOSPC"}) {
    for (int operation = 1; operation <= num_operations; operation += step) {
      EndsWell(std::string(reason) + " at operation " + std::to_string(operation),
               fail(operation, reason));
    }
  }
  std::printf("%d operations, every %d. failed in two ways; %d commands ended with 5\n",
              num_operations, step, num_failed_);
  EXPECT_GT(num_failed_, 1) << "the faults must bite";
}

INSTANTIATE_TEST_SUITE_P(Commands, GRASPBENCH_SUITE,
                         testing::ValuesIn(kCommands, kCommands + GRASPBENCH_NUM_COMMANDS),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace graspbench
