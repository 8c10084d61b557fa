#pragma once
/** @file
The program as a process that is started, killed and waited for, and its folders compared. */

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "core/base/files/files.h"

namespace graspbench {

/** @param prepare  called in the new process before the program. */
inline pid_t Start(
    std::vector<std::string> arguments, const std::function<void()>& prepare = [] {}) {
  arguments.insert(arguments.begin(), GRASPBENCH_PROGRAM);
  const pid_t child = ::fork();
  if (child != 0) return child;
  prepare();
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

/** The exit code, or the signal with a minus. */
inline int WaitFor(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

inline bool HasEnded(pid_t child) {
  siginfo_t info{};
  return ::waitid(P_PID, child, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == child;
}

/** Lines of all .jsonl files of the folder and those below it. A file may go while it is counted.
 */
inline int CountLines(const std::filesystem::path& folder) {
  int count = 0;
  std::error_code status;
  std::filesystem::recursive_directory_iterator entry(folder, status);
  for (; !status && entry != std::filesystem::recursive_directory_iterator();
       entry.increment(status)) {
    if (entry->path().extension() != ".jsonl") continue;
    std::ifstream file(entry->path(), std::ios::binary);
    count += static_cast<int>(
        std::count(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>(), '\n'));
  }
  return count;
}

/** Kills the child a moment after `is_time` [s]; false when it ended by itself before. */
inline bool KillAfter(pid_t child, const std::function<bool()>& is_time, double moment) {
  while (!is_time() && !HasEnded(child)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(moment));
  ::kill(child, SIGKILL);
  return WaitFor(child) == -SIGKILL;
}

inline void ExpectSameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
  EXPECT_TRUE(ReadFile(a) == ReadFile(b)) << a << " and " << b << " differ";
}

}  // namespace graspbench
