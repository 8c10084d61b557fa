#pragma once
/** @file Pipelines run by the program itself, in a folder of their own. */

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "core/base/files.h"
#include "core/base/json.h"

namespace graspbench {

class PipelineFolder : public testing::Test {
 protected:
  PipelineFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "graspbench_XXXXXX").string();
    top_ = ::mkdtemp(pattern.data());
  }
  ~PipelineFolder() override {
    if (!HasFailure()) std::filesystem::remove_all(top_);
  }

  /** In the folder, with GB for the program; what it prints and says is in `log`. */
  pid_t Start(const std::string& line) const {
    const pid_t child = ::fork();
    if (child != 0) return child;
    ::setenv("GB", program_.c_str(), 1);
    if (::chdir(top_.c_str()) != 0) ::_exit(126);
    ::execl("/bin/sh", "sh", "-c", ("exec " + line + " >log 2>&1 </dev/null").c_str(), nullptr);
    ::_exit(127);
  }
  /** The exit code, or the signal with a minus. */
  static int Wait(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  int Run(const std::string& line) const { return Wait(Start(line)); }
  std::string Log() const { return ReadFile(top_ / "log"); }

  std::filesystem::path top_;
  std::string program_ = GRASPBENCH_PROGRAM;
};

}  // namespace graspbench
