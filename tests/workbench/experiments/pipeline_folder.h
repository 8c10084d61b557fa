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

#ifdef GRASPBENCH_PIPELINES_FOLDER
class PackFolder : public PipelineFolder {
 protected:
  /** Packed here, made again elsewhere as somebody else would, on one processor instead of two. */
  void ExpectSameBytes(const std::string& name) const {
    const std::string file =
        "'" + (std::filesystem::path(GRASPBENCH_PIPELINES_FOLDER) / (name + ".yaml")).string() +
        "'";
    ASSERT_EQ(Run("\"$GB\" pipeline run " + file + " --jobs 2"), 0) << Log();
    ASSERT_EQ(Run("\"$GB\" pipeline pack " + file + " p.tar"), 0) << Log();
    std::filesystem::create_directories(top_ / "home of" / "else");
    ASSERT_EQ(Run("env -i HOME=\"$PWD/home of/else\" USER=else LOGNAME=else TZ=Asia/Kolkata "
                  "LANG=de_DE.UTF-8 LC_ALL=tr_TR.UTF-8 PATH=\"$PATH\" sh -c 'cd \"$HOME\" && exec "
                  "\"$0\" replay ../../p.tar --verify --jobs 1' \"$GB\""),
              0)
        << Log();
    EXPECT_NE(Log().find("program  the same"), std::string::npos) << Log();
    const std::string bytes = ReadFile(top_ / "p.tar");
    for (const std::string& trace : {top_.string(), std::string(GRASPBENCH_PIPELINES_FOLDER)}) {
      EXPECT_EQ(bytes.find(trace), std::string::npos) << trace;
    }
  }
};
#endif

}  // namespace graspbench
