#pragma once
/** @file
Pipelines run by the program itself, in a folder of their own. */

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "core/base/files/files.h"
#include "core/base/text/json.h"

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
  /** Letters that make a command run as a user who owns nothing but `home`; none where that is not
  ours to do, which only root may. */
  static std::string BecomeSomebodyElse(const std::filesystem::path& home) {
    constexpr int kNobody = 65534;
    if (::geteuid() != 0 || std::system("setpriv --version >/dev/null 2>&1") != 0) return "";
    std::filesystem::permissions(
        home.parent_path().parent_path(),
        std::filesystem::perms::others_exec | std::filesystem::perms::others_read,
        std::filesystem::perm_options::add);
    EXPECT_EQ(::chown(home.c_str(), kNobody, kNobody), 0);
    return "setpriv --reuid=65534 --regid=65534 --clear-groups ";
  }

  /** Packed here, made again elsewhere by somebody else, on one processor instead of two. */
  void ExpectSameBytes(const std::string& name) const {
    const std::string file =
        "'" + (std::filesystem::path(GRASPBENCH_PIPELINES_FOLDER) / (name + ".yaml")).string() +
        "'";
    ASSERT_EQ(Run("\"$GB\" pipeline run " + file + " --jobs 2"), 0) << Log();
    ASSERT_EQ(Run("\"$GB\" pipeline pack " + file + " p.tar"), 0) << Log();
    const std::filesystem::path home = top_ / "home of" / "else";
    std::filesystem::create_directories(home);
    const std::string somebody_else = BecomeSomebodyElse(home);
    ASSERT_EQ(Run("env -i HOME=\"$PWD/home of/else\" USER=else LOGNAME=else TZ=Asia/Kolkata "
                  "LANG=de_DE.UTF-8 LC_ALL=tr_TR.UTF-8 PATH=\"$PATH\" " +
                  somebody_else +
                  "sh -c 'cd \"$HOME\" && id -u >user && exec "
                  "\"$0\" replay ../../p.tar --verify --jobs 1' \"$GB\""),
              0)
        << Log();
    if (!somebody_else.empty()) {
      EXPECT_EQ(ReadFile(home / "user"), "65534\n");
    }
    EXPECT_NE(Log().find("program  the same"), std::string::npos) << Log();
    const std::string bytes = ReadFile(top_ / "p.tar");
    for (const std::string& trace : {top_.string(), std::string(GRASPBENCH_PIPELINES_FOLDER)}) {
      EXPECT_EQ(bytes.find(trace), std::string::npos) << trace;
    }
  }
};
#endif

}  // namespace graspbench
