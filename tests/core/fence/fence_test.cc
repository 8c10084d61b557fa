#include "core/fence/fence.h"

#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <map>
#include <thread>

#include "core/base/files/files.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

/** Of this process [B]. */
double FindPeakMemory() {
  std::ifstream in("/proc/self/status");
  for (std::string word; in >> word;) {
    double kilobytes = 0.0;
    if (word == "VmHWM:" && in >> kilobytes) return 1024.0 * kilobytes;
  }
  return std::nan("");
}

/** @returns what is used now. */
double ResetPeakMemory() {
  std::ofstream("/proc/self/clear_refs") << "5" << std::flush;
  return FindPeakMemory();
}

class FenceTest : public testing::Test {
 protected:
  std::string Read(const std::string& task, const std::string& content, int seconds = 10,
                   const FindBeside& find_beside = nullptr) {
    return fence_.Read<std::string>("task", FencedFile(content, "the file"), find_beside, seconds,
                                    task);
  }
  /** Kind and message of the refusal. */
  std::pair<ErrorKind, std::string> Refusal(const std::string& task, int seconds = 10) {
    try {
      Read(task, "content", seconds);
    } catch (const Error& error) {
      return {error.kind(), error.what()};
    }
    return {ErrorKind::kUsage, "no error"};
  }
  Fence fence_{GRASPBENCH_HOSTILE_READER};
};

TEST_F(FenceTest, HandsOverFilesOfDiskAndMemory) {
  EXPECT_EQ(Read("", "content"), "content");
  EXPECT_EQ(Read("", ""), "");
  const fs::path path = fs::path(testing::TempDir()) / "fence_file";
  std::string large(5'000'000, 'x');
  for (size_t i = 0; i < large.size(); ++i) large[i] = static_cast<char>(i % 251);
  WriteFile(path, large);
  EXPECT_EQ(fence_.Read<std::string>("task", FencedFile(path), nullptr, 10, std::string()), large);
  fs::remove(path);
  EXPECT_THROW(FencedFile{path}, Error);
}

#ifndef GRASPBENCH_SANITIZED
TEST_F(FenceTest, AReaderThatEndsRefusesItsFileAndNoOther) {
  const std::map<std::string, std::string> endings = {{"crash", "11, Segmentation fault"},
                                                      {"abort", "6, Aborted"},
                                                      {"recurse", "11, Segmentation fault"}};
  for (const auto& [task, ending] : endings) {
    EXPECT_EQ(Refusal(task),
              std::make_pair(ErrorKind::kFormat,
                             "\"the file\" cannot be read (its reader ended by signal " + ending +
                                 ", while reading it); the file is damaged or holds what the "
                                 "reader does not bear: export it again from its program or in "
                                 "another format, else leave it out"));
    EXPECT_EQ(Read("", "next"), "next");
  }
}
#endif

TEST_F(FenceTest, AReaderThatExitsIsAtFaultItself) {
  const auto [kind, message] = Refusal("exit");
  EXPECT_EQ(kind, ErrorKind::kEnvironment);
  EXPECT_EQ(message.find("\"the file\" cannot be read (graspbench-reader ended with exit code 3)"),
            0u)
      << message;
  EXPECT_EQ(Read("", "next"), "next");
}

TEST_F(FenceTest, ErrorsCrossWithTheNameOfTheFile) {
  EXPECT_EQ(Refusal("refuse"),
            std::make_pair(ErrorKind::kUnsupported, std::string("the file is refused")));
  EXPECT_NE(Refusal("throw").second.find("\"the file\" cannot be read (said so)"),
            std::string::npos);
  EXPECT_EQ(Refusal("lie").first, ErrorKind::kFormat);
}

TEST_F(FenceTest, TimeEndsAReaderAndSaysNothingOfTheFile) {
  const auto [kind, message] = Refusal("spin", 1);
  EXPECT_EQ(kind, ErrorKind::kEnvironment);
  EXPECT_NE(message.find("more than 1 s of processor time"), std::string::npos) << message;
}

#ifndef GRASPBENCH_SANITIZED
TEST_F(FenceTest, MemoryIsLimited) {
  const auto [kind, message] = Refusal("fill");
  EXPECT_EQ(kind, ErrorKind::kFormat);
  EXPECT_NE(message.find("it takes more than 1.00 GB of memory"), std::string::npos) << message;
  // The same reader goes on.
  EXPECT_EQ(Read("", "next"), "next");
  const auto [ended_kind, ended] = Refusal("fill and end");
  EXPECT_EQ(ended_kind, ErrorKind::kFormat);
  EXPECT_EQ(ended.find("\"the file\" cannot be read (reading it takes more memory than 1 GB"), 0u)
      << ended;
}
#endif

TEST_F(FenceTest, AnAnswerIsInMemoryOnce) {
  const fs::path path = fs::path(testing::TempDir()) / "fence_file";
  std::ofstream(path) << "";
  fs::resize_file(path, 200'000'000);
  const double before = ResetPeakMemory();
  const std::string answer =
      fence_.Read<std::string>("task", FencedFile(path), nullptr, 10, std::string());
  fs::remove(path);
  EXPECT_EQ(answer.size(), 200'000'000U);
  EXPECT_LT(FindPeakMemory() - before, 210e6);
}

TEST(FencedAnswerTest, WhatIsTakenLeavesTheMemoryOfTheKernel) {
  auto file = std::make_unique<FencedFile>(std::string(8'000'000, 'x'), "an answer");
  const int id = file->id();
  FencedAnswer answer(std::move(file));
  std::string taken(7'000'000, ' ');
  answer.values().Bytes(taken.data(), taken.size());
  EXPECT_EQ(taken, std::string(7'000'000, 'x'));
  struct stat left = {};
  ASSERT_EQ(::fstat(id, &left), 0);
  EXPECT_LT(512 * left.st_blocks, 1'100'000);
}

TEST_F(FenceTest, NothingIsWritten) {
  const fs::path folder = fs::path(testing::TempDir()) / "fence_folder";
  fs::create_directories(folder);
  WriteFile(folder / "kept", "as it was");
  EXPECT_EQ(Read("write", folder.string()), "");
  EXPECT_EQ(ReadFile(folder / "kept"), "as it was");
  EXPECT_FALSE(fs::exists(folder / "made"));
  fs::remove_all(folder);
}

TEST_F(FenceTest, TheParentOpensFilesBeside) {
  const fs::path path = fs::path(testing::TempDir()) / "fence_beside";
  WriteFile(path, "beside");
  const auto find = [&](const std::string& name) {
    return name == "known" ? std::optional(path) : std::nullopt;
  };
  EXPECT_EQ(Read("beside", "known", 10, find), "beside");
  EXPECT_EQ(Read("beside", "other", 10, find), "nothing");
  EXPECT_EQ(Read("beside", std::string(9000, 'n'), 10, find), "nothing");
  EXPECT_EQ(Read("beside", "known"), "nothing");
  fs::remove(path);
  EXPECT_EQ(Read("beside", "known", 10, find), "nothing");  // gone meanwhile
}

/** Processes that this one started and that have not ended. */
std::vector<int> ListChildren() {
  std::ifstream file("/proc/thread-self/children");
  std::vector<int> children;
  for (int child = 0; file >> child;) children.push_back(child);
  return children;
}

TEST_F(FenceTest, SignalsOfATerminalAreForTheParent) {
  EXPECT_EQ(Read("", "a"), "a");
  const std::vector<int> before = ListChildren();
  ASSERT_EQ(before.size(), 1u);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) ::kill(before[0], signal);
  EXPECT_EQ(Read("", "b"), "b");
  EXPECT_EQ(ListChildren(), before) << "one reader for many files";
  // Killed while it waits, it is replaced.
  ::kill(before[0], SIGKILL);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(Read("", "c"), "c");
}

/** The first child of a process, once it has one. */
int AwaitChild(int process) {
  const std::string id = std::to_string(process);
  for (int i = 0; i < 1000; ++i) {
    std::ifstream file("/proc/" + id + "/task/" + id + "/children");
    if (int child = 0; file >> child) return child;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return 0;
}

TEST_F(FenceTest, AReaderEndsWithItsParent) {
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
  const int parent = ::fork();
  if (parent == 0) {
    Read("spin", "content", 60);
    ::_exit(0);
  }
  const int reader = AwaitChild(parent);
  ASSERT_GT(reader, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));  // it spins
  ::kill(parent, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(parent, &status, 0), parent);
  rusage used = {};
  ASSERT_EQ(::wait4(reader, &status, 0, &used), reader);
  EXPECT_TRUE(WIFEXITED(status)) << status;
  EXPECT_LT(used.ru_utime.tv_sec, 5);
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

TEST_F(FenceTest, ThreadsDoNotMeet) {
  std::vector<int> num_right(4, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([this, t, &num_right] {
      for (int i = 0; i < 20; ++i) {
        const std::string content = std::to_string(100 * t + i);
        num_right[static_cast<size_t>(t)] += Read("", content) == content;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(num_right, std::vector<int>(4, 20));
}

TEST_F(FenceTest, AMissingProgramIsNamed) {
  Fence fence("/no/such/program");
  try {
    fence.Read<std::string>("task", FencedFile("", "the file"), nullptr, 1);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kEnvironment);
  }
}

TEST_F(FenceTest, AFileTakesTwoMilliseconds) {
  Read("", "first");
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 200; ++i) Read("", "content");
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  RecordProperty("ms_per_file", std::to_string(took.count() / 200));
  EXPECT_LT(took.count() / 200, 10.0);  // 2 on a machine with nothing else to do
}

}  // namespace
}  // namespace graspbench
