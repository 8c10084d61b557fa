/** @file
Runs every command that the manual shows, as a reader would: the blocks marked `console` of a page
in order, in one fresh folder of the page. A line that begins with "$ " is a command for bash, the
lines below it are what it prints on stdout and stderr together ("..." as in transcript.h); its exit
code is 0, in a block marked `console exit=N` N of its last command. Lines that begin with "> " go
on with the command. A block marked `console needs=PROGRAM` is left out where there is no such
program, and the page's test is then skipped, not passed. GRASPBENCH_UPDATE_MANUAL=1 writes what
failing commands print now into the page: read the difference before committing it. */

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "core/base/files/files.h"
#include "tests/support/transcript.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

/** A part of a page: text as it is, or a command with what it should print. */
struct Piece {
  std::string command;  ///< empty: text
  int exit_code = 0;
  std::string needs;  ///< a program; empty: nothing but graspbench
  std::vector<std::string> lines;
};

/** What follows `mark` in the first line of a block; empty: it is not there. */
std::string FindMark(const std::string& line, const std::string& mark) {
  const size_t at = line.find(mark);
  if (at == line.npos) return {};
  const size_t begin = at + mark.size();
  return line.substr(begin, line.find(' ', begin) - begin);
}

std::vector<Piece> ParsePage(const std::string& page) {
  std::vector<Piece> pieces(1);
  bool in_console = false;
  Piece block;  // what holds for its commands
  for (const std::string& line : SplitLines(page)) {
    if (!in_console && line.rfind("```console", 0) == 0) {
      in_console = true;
      const std::string exit_code = FindMark(line, " exit=");
      block.exit_code = exit_code.empty() ? 0 : std::stoi(exit_code);
      block.needs = FindMark(line, " needs=");
    } else if (in_console && line == "```") {
      in_console = false;
      pieces.push_back({});
    } else if (in_console && line.rfind("$ ", 0) == 0) {
      block.command = line.substr(2);
      pieces.push_back(block);
      continue;
    } else if (in_console && line.rfind("> ", 0) == 0 && pieces.back().lines.empty()) {
      pieces.back().command += "\n" + line.substr(2);
      continue;
    }
    pieces.back().lines.push_back(line);
  }
  return pieces;
}

/** A command as the page has it, with a mark before each of its lines. */
std::string FormatCommand(const std::string& command) {
  if (command.empty()) return {};
  std::string text = "$ ";
  for (const char c : command) {
    text += c;
    if (c == '\n') text += "> ";
  }
  return text + "\n";
}

std::string FormatPage(const std::vector<Piece>& pieces) {
  std::string page;
  for (const Piece& piece : pieces) page += FormatCommand(piece.command) + JoinLines(piece.lines);
  return page;
}

bool IsThere(const std::string& program) {
  return program.empty() || std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
}

class ManualTest : public testing::Test {
 public:
  explicit ManualTest(fs::path file) : file_(std::move(file)) {}

  void TestBody() override {
    const fs::path folder = fs::path(testing::TempDir()) /
                            ("manual_" + file_.stem().string() + "_" + std::to_string(::getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder / "work");
    std::vector<Piece> pieces = ParsePage(ReadFile(file_));
    bool is_changed = false;
    std::string missing;
    for (Piece& piece : pieces) {
      if (piece.command.empty()) continue;
      if (!IsThere(piece.needs)) {
        missing = piece.needs;
        continue;
      }
      is_changed |= !Check(folder, piece);
    }
    fs::remove_all(folder);
    if (is_changed && std::getenv("GRASPBENCH_UPDATE_MANUAL")) {
      WriteFileAtomically(file_, FormatPage(pieces));
    }
    if (!missing.empty() && !HasFailure()) {
      GTEST_SKIP() << missing << " is not installed: the commands that need it did not run";
    }
  }

 private:
  /** Puts what was printed in the place of what was expected. @returns whether they were the same.
  */
  static bool Check(const fs::path& folder, Piece& piece) {
    WriteFileAtomically(folder / "command", "cd '" + (folder / "work").string() + "'\nPATH='" +
                                                GRASPBENCH_PROGRAM_FOLDER +
                                                "':/usr/bin:$PATH\nexport XDG_CACHE_HOME='" +
                                                (folder / "cache").string() + "'\n" +
                                                piece.command + "\n");
    const fs::path output = folder / "output";
    const int status = std::system(
        ("bash '" + (folder / "command").string() + "' >'" + output.string() + "' 2>&1 </dev/null")
            .c_str());
    const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    std::vector<std::string> printed = SplitLines(ReadFile(output));
    DropEmptyTail(printed);
    const bool is_right = exit_code == piece.exit_code && Matches(printed, 0, piece.lines, 0);
    EXPECT_TRUE(is_right) << "$ " << piece.command << "\n---- expected, exit " << piece.exit_code
                          << "\n"
                          << JoinLines(piece.lines) << "---- printed, exit " << exit_code << "\n"
                          << JoinLines(printed);
    if (!is_right) piece.lines = printed;
    return is_right;
  }

  fs::path file_;
};

TEST(ManualFormat, APageIsTextAndCommandsWithWhatTheyPrint) {
  const std::string page =
      "# Title\n\n```console needs=sh exit=3\n$ one\n> more\na\nb\n$ two\n```\ntext\n```text\n$ "
      "no\n```\n";
  const std::vector<Piece> pieces = ParsePage(page);
  ASSERT_EQ(pieces.size(), 4U);
  EXPECT_EQ(pieces[1].command, "one\nmore");
  EXPECT_EQ(pieces[1].exit_code, 3);
  EXPECT_EQ(pieces[1].needs, "sh");
  EXPECT_EQ(pieces[1].lines, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(FormatPage(pieces), page);
}

void RegisterPages() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(GRASPBENCH_MANUAL_PAGES)) {
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::string name = file.stem();
    std::replace(name.begin(), name.end(), '-',
                 '_');  // a filter takes what follows '-' as excluded
    testing::RegisterTest("Manual", name.c_str(), nullptr, nullptr, file.c_str(), 1,
                          [file]() -> testing::Test* { return new ManualTest(file); });
  }
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  graspbench::RegisterPages();
  const int status = RUN_ALL_TESTS();
  return testing::UnitTest::GetInstance()->test_to_run_count() == 0 ? 1 : status;
}
