#include "workbench/experiments/policies/child_policy.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>
#include <vector>

extern "C" {  // the header of glibc 2.36 does not say so itself
#include <sys/pidfd.h>
}

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/trial/policy/policy_messages.h"
#include "core/trial/trial_setup.h"

namespace graspbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kMostLastWords = 400;  ///< of standard error [bytes]
constexpr std::chrono::milliseconds kFarewell(300);
constexpr std::chrono::seconds kEnding(10);  ///< for what is killed, on a busy machine
constexpr double kLeastStartTime = 60.0;     ///< for the answer to a reset, as weights load [s]

/** Names, in the environment of a controller and of all that it starts, who started them. */
std::string MakeMark() {
  static std::atomic<int> count{0};
  return fmt::format("GRASPBENCH_CONTROLLER={}-{}", ::getpid(), ++count);
}

/** PYTHONPATH with the program's own package behind all else. */
std::string MakePythonPath() {
  const std::filesystem::path root = FindDataRoot();
  const bool is_installed = std::filesystem::exists(root / "python");
  const std::string own = (is_installed ? root / "python" : root / "workbench" / "python").string();
  const char* path = std::getenv("PYTHONPATH");
  return "PYTHONPATH=" + (path && *path ? path + (":" + own) : own);
}

std::vector<pid_t> FindMarked(const std::string& mark) {
  std::vector<pid_t> found;
  std::error_code status;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", status)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != name.npos) continue;
    std::ifstream file(entry.path() / "environ", std::ios::binary);
    const std::string all = '\0' + std::string(std::istreambuf_iterator<char>(file), {}) + '\0';
    if (all.find('\0' + mark + '\0') != all.npos) found.push_back(std::stoi(name));
  }
  return found;
}

/** A file descriptor that is closed with its owner. */
class OwnedFile {
 public:
  OwnedFile() = default;
  ~OwnedFile() { Close(); }
  OwnedFile(const OwnedFile&) = delete;
  OwnedFile& operator=(const OwnedFile&) = delete;
  void Take(int number) { number_ = number; }
  void Close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  int number() const { return number_; }

 private:
  int number_ = -1;
};

class ControllerProcess {
 public:
  /** @throws PolicyLost where the machine gives no process. */
  explicit ControllerProcess(const std::string& command) : mark_(MakeMark()) {
    std::array<int, 2> in{}, out{}, errors{};
    // A socket, so that a controller that has gone is an error of a write and no signal.
    OwnedFile its_in, its_out, its_errors;
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in.data()) != 0) FailToStart(errno);
    in_.Take(in[0]);
    its_in.Take(in[1]);
    if (::pipe2(out.data(), O_CLOEXEC) != 0) FailToStart(errno);
    out_.Take(out[0]);
    its_out.Take(out[1]);
    if (::pipe2(errors.data(), O_CLOEXEC) != 0) FailToStart(errno);
    errors_.Take(errors[0]);
    its_errors.Take(errors[1]);
    for (const OwnedFile* file : {&in_, &out_, &errors_}) {
      ::fcntl(file->number(), F_SETFL, O_NONBLOCK);
    }
    Start(command, its_in.number(), its_out.number(), its_errors.number());
  }

  /** Ends it and all that it has started. */
  ~ControllerProcess() {
    in_.Close();
    const auto end = Clock::now() + kFarewell;
    while (!Reap() && Clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    // What it started may start more while it is being ended, and what is killed ends only when it
    // gets a processor.
    const auto last = Clock::now() + kEnding;
    for (std::vector<pid_t> left; !(left = FindMarked(mark_)).empty() && Clock::now() < last;) {
      for (const pid_t process : left) ::kill(process, SIGKILL);
      Reap();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (!has_ended_) {
      ::kill(process_, SIGKILL);
      ::waitpid(process_, &status_, 0);
    }
  }
  ControllerProcess(const ControllerProcess&) = delete;
  ControllerProcess& operator=(const ControllerProcess&) = delete;

  void Send(std::string_view message) {
    const auto length = static_cast<uint32_t>(message.size());
    for (unsigned byte = 0; byte < 4; ++byte) {
      outbox_.push_back(static_cast<char>(length >> (8 * byte)));
    }
    outbox_.append(message);
  }

  /** The next answer. @throws PolicyLost, PolicyFault. */
  std::string Receive(double timeout) {
    const auto end = Clock::now() + std::chrono::duration<double>(timeout);
    while (true) {
      std::string answer;
      if (TakeAnswer(answer)) return answer;
      if (is_closed_ || (Reap() && !CanRead())) {
        throw PolicyLost("the controller " + DescribeEnd() + " without an answer" + QuoteErrors());
      }
      const double left = std::chrono::duration<double>(end - Clock::now()).count();
      if (left <= 0.0) {
        throw PolicyLost(
            fmt::format("the controller has not answered for {:g} s of real time "
                        "(policy.timeout_s){}",
                        timeout, QuoteErrors()));
      }
      Wait(static_cast<int>(std::min(1000.0 * left + 1.0, 1e6)));
    }
  }

 private:
  [[noreturn]] static void FailToStart(int error) {
    throw PolicyLost(std::string("the controller cannot be started: ") + std::strerror(error));
  }

  void Start(const std::string& command, int in, int out, int errors) {
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_adddup2(&files, in, 0);
    ::posix_spawn_file_actions_adddup2(&files, out, 1);
    ::posix_spawn_file_actions_adddup2(&files, errors, 2);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // out of reach of Ctrl-C
    std::vector<char*> environment;
    std::string python_path = MakePythonPath();
    environment.push_back(python_path.data());
    for (char** variable = environ; *variable; ++variable) {
      if (std::strncmp(*variable, "PYTHONPATH=", 11) != 0) environment.push_back(*variable);
    }
    environment.push_back(mark_.data());
    environment.push_back(nullptr);
    std::string shell = "/bin/sh", option = "-c", text = command;
    std::array<char*, 4> arguments = {shell.data(), option.data(), text.data(), nullptr};
    const int error = ::posix_spawn(&process_, shell.c_str(), &files, &attributes, arguments.data(),
                                    environment.data());
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&files);
    if (error != 0) FailToStart(error);
    end_.Take(::pidfd_open(process_, 0));  // -1: the time limit alone finds its end
  }

  bool Reap() {
    if (!has_ended_) has_ended_ = ::waitpid(process_, &status_, WNOHANG) == process_;
    return has_ended_;
  }

  /** Moves what can be moved, once. */
  void Wait(int milliseconds) {
    std::array<pollfd, 4> files = {{{out_.number(), POLLIN, 0},
                                    {errors_.number(), POLLIN, 0},
                                    {outbox_.empty() ? -1 : in_.number(), POLLOUT, 0},
                                    {has_ended_ ? -1 : end_.number(), POLLIN, 0}}};
    if (::poll(files.data(), files.size(), milliseconds) <= 0) return;
    if (files[2].revents) Write();
    if (files[1].revents) {
      ReadErrors();
    }
    if (files[0].revents) Read();
  }

  bool CanRead() const {
    pollfd file = {out_.number(), POLLIN, 0};
    return ::poll(&file, 1, 0) > 0;
  }

  void Write() {
    const ssize_t count = ::send(in_.number(), outbox_.data(), outbox_.size(), MSG_NOSIGNAL);
    if (count > 0) outbox_.erase(0, static_cast<size_t>(count));
    if (count < 0 && errno != EAGAIN && errno != EINTR) outbox_.clear();  // nobody reads it
  }

  void Read() {
    std::array<char, 65536> part;
    const ssize_t count = ::read(out_.number(), part.data(), part.size());
    if (count > 0) inbox_.append(part.data(), static_cast<size_t>(count));
    if (count == 0) is_closed_ = true;
  }

  void ReadErrors() {
    std::array<char, 4096> part;
    const ssize_t count = ::read(errors_.number(), part.data(), part.size());
    if (count == 0) errors_.Close();
    if (count <= 0) return;
    last_words_.append(part.data(), static_cast<size_t>(count));
    if (last_words_.size() > kMostLastWords) {
      last_words_.erase(0, last_words_.size() - kMostLastWords);
    }
  }

  bool TakeAnswer(std::string& answer) {
    if (inbox_.size() < 4) return false;
    uint32_t length = 0;
    for (unsigned byte = 0; byte < 4; ++byte) {
      length |= static_cast<uint32_t>(static_cast<uint8_t>(inbox_[byte])) << (8 * byte);
    }
    if (length > kMostAnswerBytes) {
      throw PolicyFault(
          fmt::format("the controller announced an answer of {} bytes; at most {} are accepted. "
                      "Does it print to its standard output?",
                      length, kMostAnswerBytes));
    }
    if (inbox_.size() < 4 + size_t{length}) return false;
    answer = inbox_.substr(4, length);
    inbox_.erase(0, 4 + size_t{length});
    return true;
  }

  std::string DescribeEnd() {
    const auto end = Clock::now() + kFarewell;
    while (!Reap() && Clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (!has_ended_) return "closed its standard output";
    if (WIFSIGNALED(status_)) return fmt::format("was ended by signal {}", WTERMSIG(status_));
    return fmt::format("ended with exit status {}", WEXITSTATUS(status_));
  }

  std::string QuoteErrors() {
    for (int i = 0; i < 16 && errors_.number() >= 0; ++i) ReadErrors();
    const std::string words = FormatLastWords(last_words_);
    return words.empty() ? "" : "; its standard error ends with: " + words;
  }

  std::string mark_;
  OwnedFile in_, out_, errors_;  // ours; in_ is its standard input
  OwnedFile end_;                // readable once the process has ended, whatever it has started
  pid_t process_ = -1;
  int status_ = 0;
  bool has_ended_ = false, is_closed_ = false;
  std::string inbox_, outbox_, last_words_;
};

class ChildPolicy : public HandPolicy {
 public:
  explicit ChildPolicy(std::string command) : command_(std::move(command)) {}

  void Begin(const PolicyView& view) override {
    const bool is_old = is_sound_ && process_;
    if (!is_old) process_ = std::make_unique<ControllerProcess>(command_);
    is_sound_ = false;
    PackedValue answer;
    try {
      answer = Exchange(view, true);
    } catch (const PolicyLost&) {
      if (!is_old) throw;
      process_.reset();  // it may serve one trial only
      process_ = std::make_unique<ControllerProcess>(command_);
      answer = Exchange(view, true);
    }
    CheckPolicyReset(answer);
    is_sound_ = true;
  }

  PolicyAction Answer(const PolicyView& view) override {
    is_sound_ = false;
    PolicyAction action = ReadPolicyAction(Exchange(view, false), view.targets.size());
    is_sound_ = true;
    return action;
  }

 private:
  PackedValue Exchange(const PolicyView& view, bool is_reset) {
    const uint64_t number = ++number_;
    if (is_reset) first_number_ = number;
    const double given = view.setup.policy.timeout;
    const double timeout = is_reset ? std::max(given, kLeastStartTime) : given;
    process_->Send(is_reset ? FormatPolicyReset(number, view) : FormatPolicyQuestion(number, view));
    while (true) {
      PackedValue answer = ParsePolicyAnswer(process_->Receive(timeout));
      const uint64_t answered = ReadPolicyAnswerNumber(answer);
      if (answered == number) return answer;
      if (answered < first_number_) continue;  // one too many of an earlier trial
      throw PolicyFault(
          fmt::format("the controller answered question {} of the trial when it was "
                      "asked question {}",
                      static_cast<int64_t>(answered - first_number_), number - first_number_));
    }
  }

  const std::string command_;
  std::unique_ptr<ControllerProcess> process_;
  bool is_sound_ = true;  // nothing went wrong with the process so far
  uint64_t number_ = 0, first_number_ = 0;
};

}  // namespace

std::string FormatLastWords(const std::string& text) {
  std::string lines;
  std::istringstream words(text);
  for (std::string line; std::getline(words, line);) {
    if (!line.empty()) lines += (lines.empty() ? "" : " / ") + line;
  }
  return EscapeForTerminal(lines, LineFeeds::kEscape);
}

std::unique_ptr<HandPolicy> MakeChildPolicy(const std::string& command) {
  return std::make_unique<ChildPolicy>(command);
}

}  // namespace graspbench
