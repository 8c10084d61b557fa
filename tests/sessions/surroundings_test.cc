/** @file
What surrounds the program changes no byte of its results: another language, a calendar that leaps
(tests/support/jump_clock.cc), a folder for temporary files that takes nothing, a second process on
the same folder, a file system without locks, a disk whose reads fail in passing, the longest names.
Signals that were ignored stay so; others end a command with 75. A umask that forbids everything
ends one with 5 and a sentence. */

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "tests/sessions/test_folder.h"
#include "tests/support/store_results.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class Surroundings : public testing::Test {
 protected:
  /** What the program prints goes to the files printed and log. @param prepare  in its process. */
  pid_t Begin(
      const std::vector<std::string>& line, const std::function<void()>& prepare = [] {}) const {
    return Start(line, [&] {
      if (::chdir(top_.c_str()) != 0) ::_exit(126);
      std::freopen("printed", "w", stdout);
      std::freopen("log", "w", stderr);
      prepare();
    });
  }
  int Run(
      const std::vector<std::string>& line, const std::function<void()>& prepare = [] {}) const {
    return WaitFor(Begin(line, prepare));
  }
  std::string Out() const { return ReadFile(top_ / "printed"); }
  std::string Log() const { return ReadFile(top_ / "log"); }

  /** Results in the folder, and what was printed, of commands that read and write numbers. */
  std::string RunAll(const std::string& folder, const std::function<void()>& prepare) {
    fs::create_directories(top_ / folder);
    WriteFile(top_ / "typed",
              "hand tum\nobject can\nset model.mass_scale 1.5\nrun\nwhy\nscene\ncontacts\n");
    const std::string session = folder + "/s";
    const std::vector<std::vector<std::string>> lines = {
        {"run", "--hand", "tum", "--object", "golf_ball,can", "--grasp", "g3", "--trials", "1",
         "--set", "model.mass_scale=1.25", "--jobs", "1", "--out", session},
        {"judge", session, "--jobs", "1"},
        {"export", session, "--mjcf", "all", "--out", folder + "/mjcf"},
        {"trial", session, "tum-can-g3:0", "--json"},
        {"shell", "typed"},
        {"hand", "show", "tum"},
        {"object", "show", "can"},
        {"new", "study", folder + "/study"}};
    std::string printed;
    for (const std::vector<std::string>& line : lines) {
      const int code = Run(line, prepare);
      EXPECT_LE(code, 1) << line[0] << "\n" << Log();
      EXPECT_GE(code, 0) << line[0] << "\n" << Log();
      printed += Out();
    }
    for (size_t at = 0; (at = printed.find(folder + "/", at)) != printed.npos;) {
      printed.erase(at, folder.size());
    }
    return printed;
  }
  void ExpectAsAlways(const std::function<void()>& prepare) {
    const std::string plain = RunAll("plain", [] {});
    const std::string other = RunAll("other", prepare);
    EXPECT_EQ(plain, other);
    EXPECT_GT(plain.size(), 1000u);
    ExpectSameResults(top_ / "plain", top_ / "other");
  }

  const TestFolder own_{std::string("surroundings_") +
                        testing::UnitTest::GetInstance()->current_test_info()->name()};
  const fs::path& top_ = own_.path();
};

/** Numbers with a comma; an i whose capital is another letter. */
TEST_F(Surroundings, LanguagesChangeNothing) {
  const fs::path locales = top_ / "locales";
  fs::create_directories(locales);
  for (const char* language : {"de_DE", "tr_TR"}) {
    const std::string line = std::string("localedef -i ") + language + " -f UTF-8 '" +
                             (locales / language).string() + ".UTF-8' >/dev/null 2>&1";
    if (std::system(line.c_str()) != 0) GTEST_SKIP() << "localedef or its sources are not there";
  }
  const std::string probe = "LOCPATH='" + locales.string() +
                            "' LC_ALL=de_DE.UTF-8 env printf %.1f 1,5 >'" +
                            (top_ / "probe").string() + "' 2>&1";
  ASSERT_EQ(std::system(probe.c_str()), 0);
  ASSERT_EQ(ReadFile(top_ / "probe"), "1,5");
  for (const char* language : {"de_DE.UTF-8", "tr_TR.UTF-8"}) {
    fs::remove_all(top_ / "plain");
    fs::remove_all(top_ / "other");
    ExpectAsAlways([&] {
      ::setenv("LOCPATH", locales.c_str(), 1);
      ::setenv("LC_ALL", language, 1);
      ::setenv("LANG", language, 1);
    });
  }
}

#ifdef GRASPBENCH_JUMP_CLOCK
TEST_F(Surroundings, ALeapingCalendarChangesNothing) {
  ExpectAsAlways([] { ::setenv("LD_PRELOAD", GRASPBENCH_JUMP_CLOCK, 1); });
  const auto find_year = [&](const char* folder) {
    const std::string runs = ReadFile(top_ / folder / "s/run.json");
    return runs.substr(runs.find("\"started_utc\": \"") + 16, 4);
  };
  EXPECT_NE(find_year("plain"), find_year("other")) << "the calendar must leap";
  EXPECT_EQ(Run({"status", "other/s"}, [] { ::setenv("LD_PRELOAD", GRASPBENCH_JUMP_CLOCK, 1); }), 0)
      << Log();
}

TEST_F(Surroundings, NoPlaceForTemporaryFilesChangesNothing) {
  const fs::path full = top_ / "full";
  fs::create_directories(full);
  ExpectAsAlways([&] {
    ::setenv("TMPDIR", full.c_str(), 1);
    ::setenv("LD_PRELOAD", GRASPBENCH_FAIL_FILES, 1);
    ::setenv("GRASPBENCH_FAULTS", ("1 1.0 " + full.string()).c_str(), 1);
    ::unsetenv("XDG_CACHE_HOME");
    ::unsetenv("HOME");  // then the cache is there, too
  });
}

std::function<void()> WithLocks(const char* kind) {
  return [kind] {
    ::setenv("LD_PRELOAD", GRASPBENCH_FAIL_FILES, 1);
    ::setenv("GRASPBENCH_FLOCK", kind, 1);
  };
}

/** As on some clusters' file systems: no locks, or such as no other machine sees. */
TEST_F(Surroundings, WithoutFileLocksResultsAreTheSame) {
  ExpectAsAlways(WithLocks("ENOSYS"));
  for (const char* kind : {"ENOSYS", "ENOLCK", "local"}) {
    EXPECT_EQ(Run({"new", "study", kind}, WithLocks(kind)), 0) << Log();
    EXPECT_EQ(Log().find("warning"), std::string::npos) << Log();
  }
  EXPECT_EQ(Run({"new", "study", "third"}, WithLocks("EIO")), 5) << Log();
  for (const auto& entry : fs::recursive_directory_iterator(top_)) {
    EXPECT_NE(entry.path().extension(), ".owner") << entry.path();
  }
}

/** The owner file does alone what it does beside flock. */
TEST_F(Surroundings, WithoutFileLocksASecondRunIsRefusedAndAKilledOneIsContinued) {
  for (const char* kind : {"ENOLCK", "local"}) {
    const std::string out = kind;
    const fs::path owner = top_ / out / "journal" / "0.jsonl.owner";
    const pid_t first = Begin({"run", "--hand", "tum", "--object", "golf_ball,can", "--trials", "2",
                               "--jobs", "1", "--out", out},
                              WithLocks(kind));
    while (!fs::exists(owner) && !HasEnded(first)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(first, SIGSTOP);
    ASSERT_FALSE(HasEnded(first)) << Log();
    EXPECT_EQ(Run({"run", "--resume", "--out", out}, WithLocks(kind)), 5) << Log();
    EXPECT_NE(Log().find("; process " + std::to_string(first) + " of host \""), std::string::npos)
        << Log();
    ::kill(first, SIGKILL);
    EXPECT_EQ(WaitFor(first), -SIGKILL);
    EXPECT_TRUE(fs::exists(owner));

    // The process of another machine: nobody here knows.
    const std::string left = ReadFile(owner);
    std::string other = left;
    other.replace(other.find("\"boot\":\"") + 8, 1, "x");
    WriteFile(owner, other);
    EXPECT_EQ(Run({"run", "--resume", "--out", out}, WithLocks(kind)), 5) << Log();
    const std::string refused = Log();
    const size_t command = refused.find("rm \"");
    ASSERT_NE(command, std::string::npos) << refused;
    EXPECT_EQ(Run({"status", out}, WithLocks(kind)), 0) << Log();
    EXPECT_EQ(Out().find("no process of this machine"), std::string::npos) << Out();
    const std::string take_over = refused.substr(command, refused.find('\n', command) - command);
    ASSERT_EQ(std::system(("cd '" + top_.string() + "' && " + take_over).c_str()), 0);

    WriteFile(owner, left);
    EXPECT_EQ(Run({"run", "--resume", "--out", out}, WithLocks(kind)), 0) << Log();
    EXPECT_FALSE(fs::exists(owner));
    EXPECT_EQ(Run({"verify", out}), 0) << Out();
  }
}

/** As disks over the network fail for a moment, and for good. */
TEST_F(Surroundings, AReadThatFailsInPassingIsNoDamage) {
  ASSERT_EQ(Run({"run", "--hand", "tum", "--object", "golf_ball", "--grasp", "g3", "--trials", "1",
                 "--jobs", "1", "--out", "s"}),
            0)
      << Log();
  const auto fail = [](const std::string& reason, int count, const char* file) {
    return [=] {
      ::setenv("LD_PRELOAD", GRASPBENCH_FAIL_FILES, 1);
      ::setenv("GRASPBENCH_READS", (reason + " " + std::to_string(count) + " " + file).c_str(), 1);
    };
  };
  for (const std::string command : {"verify", "status", "trial"}) {
    std::vector<std::string> line = {command, "s"};
    if (command == "trial") line.emplace_back("tum-golf_ball-g3:0");
    ASSERT_EQ(Run(line), 0) << Log();
    const std::string undisturbed = Out();
    for (const char* file : {"plan.jsonl", "manifest.json", "0.jsonl", "session.json"}) {
      for (const char* reason : {"ESTALE", "EIO", "EINTR"}) {
        EXPECT_EQ(Run(line, fail(reason, 2, file)), 0) << command << file << reason << Log();
        EXPECT_EQ(Out(), undisturbed) << command << file << reason;
      }
      EXPECT_EQ(Run(line, fail("EIO", 1000000, file)), 5) << command << file << Out() << Log();
      EXPECT_NE(Log().find("Input/output error"), std::string::npos) << Log();
      for (const char* wrong : {"damaged", "brings back", "has changed"}) {
        EXPECT_EQ((Out() + Log()).find(wrong), std::string::npos) << command << file << Out();
      }
    }
  }
}
#endif

/** 255 bytes are what file systems take. */
TEST_F(Surroundings, TheLongestNamesWork) {
  const std::string longest(255, 'n');
  const std::string letters = [] {  // of two bytes each
    std::string text;
    while (text.size() < 254) text += "\u00e4";
    return text;
  }();
  for (const std::string& name : {longest, letters}) {
    EXPECT_EQ(Run({"run", "--hand", "tum", "--object", "golf_ball", "--trials", "1", "--jobs", "1",
                   "--out", name}),
              0)
        << Log();
    EXPECT_EQ(Run({"verify", name}), 0) << Log();
    EXPECT_EQ(Run({"report", name}), 0) << Log();
    EXPECT_EQ(Run({"new", "study", "study/" + name}), 0) << Log();
    EXPECT_EQ(Run({"render", "tum", "can", "g3", "--out", "x" + name.substr(5) + ".png"}), 0)
        << Log();
  }
}

TEST_F(Surroundings, ALinkToItselfIsTold) {
  fs::create_symlink("loop", top_ / "loop");
  const std::vector<std::vector<std::string>> lines = {{"study", "run", "loop", "--out", "out"},
                                                       {"hand", "import", "loop", "--out", "out"},
                                                       {"object", "check", "loop"},
                                                       {"verify", "loop"},
                                                       {"mocap", "info", "loop"}};
  for (const std::vector<std::string>& line : lines) {
    EXPECT_EQ(Run(line), 2) << line[0] << Log();
    EXPECT_EQ(Log().find("the machine lacks"), std::string::npos) << Log();
  }
  EXPECT_EQ(Run(lines[0]), 2);
  EXPECT_EQ(Log(),
            "graspbench: \"loop\" leads through a symbolic link to itself; remove the link, or "
            "name another file\n");
}

// As nohup starts them, and a script whose commands run in the background.
TEST_F(Surroundings, IgnoredSignalsStopNothing) {
  const pid_t run = Begin({"run", "--hand", "tum", "--object", "golf_ball,tea_light", "--trials",
                           "2", "--jobs", "1", "--out", "s"},
                          [] {
                            ::signal(SIGHUP, SIG_IGN);
                            ::signal(SIGINT, SIG_IGN);
                          });
  while (!fs::exists(top_ / "s" / "journal" / "0.jsonl") && !HasEnded(run)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_FALSE(HasEnded(run)) << Log();
  for (const int signal : {SIGHUP, SIGINT, SIGHUP, SIGINT}) ::kill(run, signal);
  EXPECT_EQ(WaitFor(run), 0) << Log();
}

TEST_F(Surroundings, AStudyEndsAtASignalAndLeavesNothing) {
  ASSERT_EQ(Run({"study", "demo", "--out", "demo"}), 0) << Log();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const pid_t study = Begin({"study", "run", "demo/input/study.yaml", "--out", "out"});
    const auto is_staged = [&] {
      return std::any_of(fs::directory_iterator(top_), {}, [](const auto& entry) {
        return entry.path().filename().string().rfind(".out.part-", 0) == 0;
      });
    };
    while (!is_staged() && !HasEnded(study)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_FALSE(HasEnded(study)) << Log();
    ::kill(study, signal);
    EXPECT_EQ(WaitFor(study), 75) << Log();
    EXPECT_EQ(Log(),
              "graspbench: stopped; nothing was written. Repeat the command to start again\n");
    EXPECT_FALSE(is_staged());
    EXPECT_FALSE(fs::exists(top_ / "out"));
  }
}

// A stage that is asked to end before it can say how it does that was not at fault.
TEST_F(Surroundings, APipelineEndsAtASignalAtAnyMoment) {
  WriteFile(top_ / "t.yaml", "hands: [tum]\nobjects: [golf_ball]\ntrials: 2\n");
  WriteFile(top_ / "p.yaml",
            "stages:\n  first:\n    command: run\n    inputs: {session: t.yaml}\n");
  for (int moment = 0; moment < 8; ++moment) {  // [ms], from the stage's start on
    fs::remove_all(top_ / "results");
    const pid_t pipeline = Begin({"pipeline", "run", "p.yaml"});
    while (!fs::exists(top_ / "results/p/.begun-first") && !HasEnded(pipeline)) {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(moment * moment));
    ::kill(pipeline, SIGTERM);
    EXPECT_EQ(WaitFor(pipeline), 75) << moment << Log();
    EXPECT_NE(Log().find("repeat the command to continue"), std::string::npos) << Log();
  }
  EXPECT_EQ(Run({"pipeline", "run", "p.yaml"}), 0) << Log();
}

// The judge takes what is there when it starts; what a run adds meanwhile is said, and no fault.
TEST_F(Surroundings, AJudgeBesideARunSaysWhatFinishedMeanwhile) {
  const std::vector<std::string> line = {
      "run",    "--hand", "tum",   "--object", "cup,toy_cube,tea_light", "--trials", "4",
      "--jobs", "1",      "--out", "s"};
  const pid_t run = Begin(line);
  const auto count = [&] { return CountLines(top_ / "s" / "journal"); };
  while (count() < 4 && !HasEnded(run)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(run, SIGSTOP);
  ASSERT_FALSE(HasEnded(run)) << Log();
  const pid_t judge = Start({"judge", "s", "--jobs", "1"}, [&] {
    if (::chdir(top_.c_str()) != 0) ::_exit(126);
    std::freopen("judge_printed", "w", stdout);
    std::freopen("judge_log", "w", stderr);
  });
  while (CountLines(top_ / "s" / "judge") < 1 && !HasEnded(judge)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::kill(judge, SIGSTOP);
  ASSERT_FALSE(HasEnded(judge));
  ::kill(run, SIGCONT);
  EXPECT_EQ(WaitFor(run), 0) << Log();
  ::kill(judge, SIGCONT);
  EXPECT_EQ(WaitFor(judge), 0);
  const std::string said = ReadFile(top_ / "judge_log");
  EXPECT_NE(
      said.find("of trials that finished in the meantime: not judged yet; to judge: graspbench "
                "judge s"),
      std::string::npos)
      << said;
  EXPECT_EQ(said.find("had not ended after"), std::string::npos) << said;
  EXPECT_EQ(Run({"judge", "s", "--jobs", "1"}), 0) << Log();
  EXPECT_EQ(Log().find("meanwhile"), std::string::npos) << Log();
  EXPECT_EQ(Run({"verify", "s"}), 0) << Out();
}

// As another user, because root may do everything.
TEST_F(Surroundings, AMaskThatForbidsEverythingIsTold) {
  const fs::path work = top_ / "work";
  fs::create_directories(work);
  ::chmod(work.c_str(), 0777);
  ::chmod(testing::TempDir().c_str(), 0711);
  for (fs::path above = work; above != above.root_path(); above = above.parent_path()) {
    struct stat status;
    ASSERT_EQ(::stat(above.c_str(), &status), 0);
    if (::geteuid() == 0 && (status.st_mode & 0001) == 0) {
      GTEST_SKIP() << above << " cannot be entered by others";
    }
  }
  for (const std::vector<std::string>& line :
       {std::vector<std::string>{"run", "--hand", "tum", "--object", "golf_ball", "--trials", "1",
                                 "--jobs", "1", "--out", "work/s"},
        {"optimise", "--hand", "tum", "--object", "golf_ball", "--evaluations", "2", "--out",
         "work/o"},
        {"study", "demo", "--out", "work/study"},
        {"new", "object", "work/object"}}) {
    const int code = Run(line, [&] {
      if (::geteuid() == 0 && (::setgid(65534) != 0 || ::setuid(65534) != 0)) ::_exit(126);
      ::setenv("HOME", work.c_str(), 1);
      ::unsetenv("XDG_CACHE_HOME");
      ::umask(0777);
    });
    EXPECT_EQ(code, 5) << line[0] << "\n" << Log();
    EXPECT_EQ(Log().rfind("graspbench: ", 0), 0u) << Log();
  }
}

/** A command that holds a file while it works. */
struct LongCommand {
  const char* name;
  std::vector<std::string> line;
  const char* held;
};
void PrintTo(const LongCommand& command, std::ostream* out) { *out << command.name; }

class TwoProcesses : public Surroundings, public testing::WithParamInterface<LongCommand> {
 protected:
  /** Asked of the system: to try it would be to take it. */
  static bool IsLocked(const fs::path& file) {
    struct stat status;
    if (::stat(file.c_str(), &status) != 0) return false;
    const std::string inode = ":" + std::to_string(status.st_ino) + " ";
    std::ifstream locks("/proc/locks");
    for (std::string line; std::getline(locks, line);) {
      if (line.find("FLOCK") != line.npos && line.find(inode) != line.npos) return true;
    }
    return false;
  }
};

// The first one is stopped while it holds the folder, so that it is certainly at work.
TEST_P(TwoProcesses, TheSecondIsRefusedAndTheFirstIsNotDisturbed) {
  WriteFile(top_ / "t.yaml", "hands: [tum]\nobjects: [golf_ball]\ntrials: 2\n");
  WriteFile(top_ / "p.yaml",
            "stages:\n  first:\n    command: run\n    inputs: {session: t.yaml}\n");
  ASSERT_EQ(Run({"run", "t.yaml", "--jobs", "1", "--out", "s"}), 0) << Log();
  const pid_t first = Begin(GetParam().line);
  while (!IsLocked(top_ / GetParam().held) && !HasEnded(first)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::kill(first, SIGSTOP);
  ASSERT_FALSE(HasEnded(first)) << Log();
  std::vector<std::string> second = GetParam().line;
  if (second[0] == "run") second = {"run", "--resume", "--out", "out"};
  EXPECT_EQ(Run(second), 5) << Log();
  EXPECT_NE(Log().find("another"), std::string::npos) << Log();
  EXPECT_NE(Log().find("wait until it is finished or stop it"), std::string::npos) << Log();
  ::kill(first, SIGCONT);
  EXPECT_EQ(WaitFor(first), 0) << Log();
}

INSTANTIATE_TEST_SUITE_P(
    Commands, TwoProcesses,
    testing::Values(
        LongCommand{"run", {"run", "t.yaml", "--jobs", "1", "--out", "out"}, "out/journal/0.jsonl"},
        LongCommand{"judge", {"judge", "s", "--jobs", "1"}, "s/judge/0.jsonl"},
        LongCommand{"basin",
                    {"basin", "--hand", "tum", "--object", "golf_ball", "--samples", "4", "--jobs",
                     "1", "--out", "out"},
                    "out/journal/0.jsonl"},
        LongCommand{"optimise",
                    {"optimise", "--hand", "tum", "--object", "golf_ball", "--evaluations", "2",
                     "--out", "out"},
                    "out/journal.jsonl"},
        LongCommand{"campaign",
                    {"campaign", "--hand", "tum", "--object", "golf_ball", "--evaluations", "2",
                     "--trials", "1", "--out", "out"},
                    "out/scenes/tum-golf_ball/journal.jsonl"},
        LongCommand{"pipeline", {"pipeline", "run", "p.yaml"}, "results/p/.lock"}),
    [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace graspbench
