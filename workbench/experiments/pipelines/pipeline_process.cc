#include "workbench/experiments/pipelines/pipeline_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr int kCannotStart = 127;

int OpenForStage(const fs::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644);
  if (file >= 0) return file;
  throw Error(ErrorKind::kIo, "cannot write \"" + path.string() + "\": " + std::strerror(errno));
}

/** Between fork and exec: nothing that takes memory or locks. */
[[noreturn]] void BecomeStage(char* const* argv, const char* folder, int output, int log,
                              pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const bool is_ready = ::getppid() == parent && nothing >= 0 && ::dup2(nothing, 0) >= 0 &&
                        ::dup2(output, 1) >= 0 && ::dup2(log, 2) >= 0 && ::chdir(folder) == 0;
  // A terminal's Ctrl-C is for the pipeline, which asks its stages to end.
  ::setpgid(0, 0);
  if (is_ready) ::execv("/proc/self/exe", argv);
  ::_exit(kCannotStart);
}

}  // namespace

PipelineProcess::PipelineProcess(const std::vector<std::string>& words, const fs::path& folder,
                                 const fs::path& output, const fs::path& log) {
  std::vector<std::string> texts = {"graspbench"};
  texts.insert(texts.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& text : texts) argv.push_back(text.data());
  argv.push_back(nullptr);
  const int log_file = OpenForStage(log);
  int output_file = log_file;
  try {
    if (output != log) output_file = OpenForStage(output);
  } catch (...) {
    ::close(log_file);
    throw;
  }
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) BecomeStage(argv.data(), folder.c_str(), output_file, log_file, parent);
  const int reason = errno;
  if (output_file != log_file) ::close(output_file);
  ::close(log_file);
  if (process_ < 0) {
    throw Error(ErrorKind::kEnvironment,
                std::string("cannot start a stage: ") + std::strerror(reason));
  }
}

PipelineProcess::~PipelineProcess() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<int> PipelineProcess::Poll() {
  int status = 0;
  const pid_t ended = ::waitpid(process_, &status, WNOHANG);
  if (ended != process_) return std::nullopt;
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void PipelineProcess::Interrupt() const {
  if (process_ > 0) ::kill(process_, SIGTERM);
}

}  // namespace graspbench
