/** @file
The shell at a terminal, as a person has it: inside tmux at two sizes, with another size of the
window, a paste, Ctrl-C and a crash; the terminal's settings are afterwards what they were. */

#include <gtest/gtest.h>
#include <pty.h>

#include <cstdio>
#include <sstream>

#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

std::string ReadCommand(const std::string& command) {
  std::FILE* pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
  std::string text;
  char bytes[4096];
  while (const size_t size = std::fread(bytes, 1, sizeof bytes, pipe)) text.append(bytes, size);
  ::pclose(pipe);
  return text;
}

std::vector<std::string> SplitLines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

struct WindowSize {
  int columns, rows;
};

/** A shell of the system in a window of tmux. */
class Window {
 public:
  explicit Window(WindowSize size)
      : top_(fs::path(testing::TempDir()) / ("shell_terminal_" + std::to_string(::getpid()))) {
    fs::remove_all(top_);
    fs::create_directories(top_);
    tmux_ = "cd '" + top_.string() + "' && tmux -S socket -f /dev/null ";
    Tmux("new-session -d -x " + std::to_string(size.columns) + " -y " + std::to_string(size.rows) +
         " \"env HOME='" + top_.string() + "' COLORTERM=truecolor PS1='ready\\$ ' sh\"");
    WaitUntil("ready$");
  }
  ~Window() {
    Tmux("kill-server");
    fs::remove_all(top_);
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  std::string Tmux(const std::string& command) const { return ReadCommand(tmux_ + command); }
  void Type(const std::string& text) const { Tmux("send-keys -l '" + text + "'"); }
  void Press(const std::string& key) const { Tmux("send-keys " + key); }
  void Enter(const std::string& line) const {
    Type(line);
    Press("Enter");
  }
  /** All that was printed, or only what is to be seen. */
  std::string Read() const { return Tmux("capture-pane -p -J -S -2000"); }
  std::vector<std::string> ReadScreen() const { return SplitLines(Tmux("capture-pane -p")); }

  /** @param count  so many times. */
  bool WaitUntil(const std::string& text, int count = 1) const {
    return WaitFor([&] {
      const std::string shown = "\n" + Read();
      int found = 0;
      for (size_t at = shown.find(text); at != shown.npos; at = shown.find(text, at + 1)) ++found;
      return found >= count;
    });
  }
  bool WaitFor(const std::function<bool()>& is_so) const {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!is_so()) {
      if (std::chrono::steady_clock::now() > limit) {
        ADD_FAILURE() << "nothing came; the window shows\n" << Read();
        return false;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }
    return true;
  }
  /** What the terminal is set to, by a file of the window's shell. */
  std::string ReadSettings(const std::string& name) {
    Enter("clear; stty -a > " + name + "; echo noted-" + name);
    WaitUntil("\nnoted-" + name);
    return ReadFile(top_ / name);
  }
  void StartShell() {
    Enter(std::string("clear; '") + GRASPBENCH_PROGRAM + "' shell");
    WaitUntil("> ");
  }
  pid_t FindShell() const {
    const std::string parent = SplitLines(Tmux("display -p '#{pane_pid}'")).at(0);
    const std::string child = ReadCommand("cat /proc/" + parent + "/task/" + parent + "/children");
    return child.empty() ? 0 : static_cast<pid_t>(std::stol(child));
  }

 private:
  fs::path top_;
  std::string tmux_;
};

/** The last lines: a picture over the whole width, its words, the prompt. */
void ExpectPicture(const Window& window, WindowSize size) {
  const std::vector<std::string> lines = window.ReadScreen();
  const auto rows = static_cast<size_t>(size.rows);
  ASSERT_EQ(lines.size(), rows);
  EXPECT_EQ(lines[rows - 1].substr(0, 7), "shadow ");
  EXPECT_EQ(lines[rows - 1].back(), '>');
  EXPECT_NE(lines[rows - 2].find("grasp view"), std::string::npos) << lines[rows - 2];
  const std::string colours = window.Tmux("capture-pane -p -e");
  EXPECT_NE(colours.find("\x1b[38;2;"), std::string::npos);
}

class ShellTerminal : public testing::TestWithParam<WindowSize> {};

TEST_P(ShellTerminal, StandsWhatAPersonDoes) {
  if (ReadCommand("tmux -V").empty()) GTEST_SKIP() << "tmux is not installed";
  const WindowSize size = GetParam();
  Window window(size);
  const std::string before = window.ReadSettings("before");
  window.StartShell();

  window.Type("hand shad");
  window.Press("Tab");
  window.WaitUntil("hand shadow");
  window.Press("Enter");
  window.WaitUntil("Shadow Hand (shadow)");
  window.Enter("view");
  window.WaitUntil("grasp view, placing");
  window.WaitUntil("> ", 3);
  ExpectPicture(window, size);

  const WindowSize other = {size.columns + 20, size.rows - 4};
  window.Tmux("resize-window -x " + std::to_string(other.columns) + " -y " +
              std::to_string(other.rows));
  window.Enter("clear");  // no command: the shell goes on
  window.WaitUntil("unknown command");
  window.Enter("view");
  window.WaitUntil("grasp view, placing", 2);
  window.WaitUntil("> ", 5);
  ExpectPicture(window, other);

  window.Tmux("set-buffer 'draw 1\ndraw 2\nnote pasted\ndraw 3\n'");
  window.Tmux("paste-buffer");
  window.WaitUntil("draw     3:");
  EXPECT_NE(window.Read().find("draw     2:"), std::string::npos);

  window.Enter("trials 9999");
  window.WaitUntil("of 9999, success");
  window.Press("C-c");
  window.WaitUntil("stopped by Ctrl-C");
  EXPECT_EQ(window.Read().find("of 9999, success"), std::string::npos) << "left on the screen";
  window.Type("nonsense");
  window.Press("C-c");
  window.Enter("goto 0.1");
  window.WaitUntil("0.100 s");
  window.Enter("quit");
  window.WaitFor([&] { return window.FindShell() == 0; });

  window.Tmux("resize-window -x " + std::to_string(size.columns) + " -y " +
              std::to_string(size.rows));
  EXPECT_EQ(window.ReadSettings("after"), before);

  for (const int signal : {SIGSEGV, SIGABRT, SIGTERM}) {
    window.StartShell();
    window.Type("half a line");
    window.WaitUntil("half a line");
    const pid_t shell = window.FindShell();
    ASSERT_GT(shell, 1);
    ::kill(shell, signal);
    window.WaitFor([&] { return window.FindShell() == 0; });
    EXPECT_EQ(window.ReadSettings("crashed-" + std::to_string(signal)), before) << signal;
  }

  window.StartShell();  // which knows the lines of the one before
  window.Press("Up");
  window.Press("Up");
  window.WaitUntil("> goto 0.1");
}

INSTANTIATE_TEST_SUITE_P(Sizes, ShellTerminal,
                         testing::Values(WindowSize{80, 24}, WindowSize{160, 45}),
                         [](const auto& instance) {
                           return "Of" + std::to_string(instance.param.columns) + "Columns";
                         });

/** All bytes that a shell with these commands writes to a terminal. */
std::string ReadFromTerminal(const std::vector<std::pair<const char*, const char*>>& environment) {
  int terminal = -1;
  winsize size = {24, 80, 0, 0};
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    for (const auto& [name, value] : environment) ::setenv(name, value, 1);
    ::execl(GRASPBENCH_PROGRAM, GRASPBENCH_PROGRAM, "shell", "-c", "run to closure", "-c", "view",
            "-c", "trials 1", "-c", "live view", "-c", "step 300", nullptr);
    ::_exit(127);
  }
  std::string text;
  char bytes[4096];
  for (ssize_t count = 0; (count = ::read(terminal, bytes, sizeof bytes)) > 0;) {
    text.append(bytes, static_cast<size_t>(count));
  }
  ::close(terminal);
  EXPECT_EQ(WaitFor(child), 0);
  return text;
}

TEST(ShellManners, ADumbTerminalGetsNoEscapeByte) {
  const std::string text = ReadFromTerminal({{"TERM", "dumb"}});
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_NE(text.find("grasp view, closure"), std::string::npos);
}

TEST(ShellManners, NoColourWithoutColour) {
  const std::string text = ReadFromTerminal({{"TERM", "xterm-256color"}, {"NO_COLOR", "1"}});
  EXPECT_NE(text.find("\x1b[K"), std::string::npos);  // it is a terminal whose cursor moves
  for (size_t at = text.find("\x1b["); at != text.npos; at = text.find("\x1b[", at + 1)) {
    const size_t end = text.find_first_not_of("0123456789;", at + 2);
    EXPECT_NE(text[end], 'm') << text.substr(at + 1, end - at);
  }
}

TEST(ShellManners, OtherwiseThereIsColour) {
  EXPECT_NE(ReadFromTerminal({{"TERM", "xterm-256color"}, {"NO_COLOR", ""}}).find("\x1b[38;"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
