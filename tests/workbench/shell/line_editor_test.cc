#include "workbench/shell/line_editor.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

void IgnoreInterrupt(int) {}

/** Reads what is shown until it holds so many prompts; keys that come earlier are the terminal's. */
void WaitForPrompts(int terminal, size_t count, std::string& shown) {
  const auto count_prompts = [&shown] {
    size_t found = 0;
    for (size_t at = shown.find("> "); at != shown.npos; at = shown.find("> ", at + 1)) ++found;
    return found;
  };
  char bytes[256];
  while (count_prompts() < count) {
    const ssize_t size = ::read(terminal, bytes, sizeof bytes);
    if (size <= 0) return;
    shown.append(bytes, static_cast<size_t>(size));
  }
  // Raw mode begins behind the prompt; an end of input that comes before it would be lost.
  termios settings = {};
  do {
    ::usleep(1000);
    ::tcgetattr(terminal, &settings);
  } while (settings.c_lflag & ICANON);
}

/** What the editor reads on a terminal of its own on which `keys` are typed, a line in brackets. */
std::string Type(const std::vector<std::string>& keys,
                 const std::filesystem::path& history_file = {}) {
  int answers[2];
  if (::pipe(answers) != 0) return "no pipe";
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    struct sigaction action {};
    action.sa_handler = &IgnoreInterrupt;
    ::sigaction(SIGINT, &action, nullptr);
    ::setenv("TERM", "xterm", 1);
    LineEditor editor([] { return std::string("> "); },
                      [](const std::string& line) {
                        return line == "co" ? std::vector<std::string>{"contacts"}
                                            : std::vector<std::string>();
                      },
                      history_file);
    std::string lines;
    while (const std::optional<std::string> line = editor.Read()) lines += "[" + *line + "]";
    if (::write(answers[1], lines.data(), lines.size()) < 0) ::_exit(1);
    ::_exit(0);
  }
  ::close(answers[1]);
  size_t num_prompts = 1;
  std::string shown;
  for (const std::string& key : keys) {
    WaitForPrompts(terminal, num_prompts, shown);
    if (key.back() == '\n' || key == "\x03") ++num_prompts;
    EXPECT_EQ(::write(terminal, key.data(), key.size()), static_cast<ssize_t>(key.size()));
  }
  std::string lines(1000, ' ');
  lines.resize(static_cast<size_t>(::read(answers[0], lines.data(), lines.size())));
  ::close(answers[0]);
  ::waitpid(child, nullptr, 0);
  ::close(terminal);
  return lines;
}

TEST(LineEditor, ReadsEditedLinesUntilTheEnd) {
  EXPECT_EQ(Type({"run\n", "bxack\x02\x02\x02\x08\n", "\x04"}), "[run][back]");
}

TEST(LineEditor, KeepsLettersBeyondAscii) {
  EXPECT_EQ(Type({"note gr\xc3\xbc\xc3\x9f\n", "\x04"}), "[note gr\xc3\xbc\xc3\x9f]");
}

TEST(LineEditor, CompletesAndRemembers) {
  EXPECT_EQ(Type({"co\t\n", "\x10\n", "\x04"}), "[contacts ][contacts]");
}

TEST(LineEditor, HistoryOutlivesTheEditor) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "state" / "history";
  EXPECT_EQ(Type({"run\n", "goto 1\n", "\x04"}, file), "[run][goto 1]");
  EXPECT_EQ(Type({"\x10\x10\n", "\x10\n", "\x04"}, file), "[run][run]");
  EXPECT_EQ(std::filesystem::status(file).permissions() & std::filesystem::perms::others_all,
            std::filesystem::perms::none);
  EXPECT_EQ(Type({"run\n", "\x04"}, "/proc/nowhere/history"), "[run]");
}

TEST(LineEditor, TheHistoryStandsInTheFolderOfStates) {
  ::setenv("HOME", "/home/somebody", 1);
  ::unsetenv("XDG_STATE_HOME");
  EXPECT_EQ(FindHistoryFile(), "/home/somebody/.local/state/graspbench/history");
  ::setenv("XDG_STATE_HOME", "/states", 1);
  EXPECT_EQ(FindHistoryFile(), "/states/graspbench/history");
  ::setenv("XDG_STATE_HOME", "relative", 1);  // to be ignored by its specification
  EXPECT_EQ(FindHistoryFile(), "/home/somebody/.local/state/graspbench/history");
  ::unsetenv("HOME");
  EXPECT_EQ(FindHistoryFile(), "");
}

TEST(LineEditor, CtrlCGivesTheLineUp) {
  EXPECT_EQ(Type({"abc", "\x03", "run\n", "\x04"}), "[][run]");
}

}  // namespace
}  // namespace graspbench
