#include "workbench/text/command_line_text.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "core/base/files/files.h"
#include "workbench/terminal/command_line.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

// A program of its own: "tool hand show --unit m|mm" and "tool run --hand H --jobs N".
class CommandLineTextTest : public testing::Test {
 protected:
  CommandLineTextTest() {
    program_.Describe("graspbench", "What it is.", "");
    Command& run = AddSubcommand(program_, "run", "Runs.", "  graspbench run");
    run.AddOption("--hand", hand_, "a hand", "H");
    run.AddOption("--jobs", jobs_, ".5 at a time", "N")->ShowDefault("2");
    Command& show =
        AddSubcommand(AddSubcommand(program_, "hand", "Hands.", ""), "show", "It's a hand.", "");
    show.AddOption("--unit", hand_, "of length")->OneOf({"m", "mm"});
    show.AddFlag("--json", "as JSON");
  }

  fs::path Write(const std::string& shell) {
    const fs::path file =
        fs::path(testing::TempDir()) / (std::to_string(::getpid()) + "_completion." + shell);
    WriteFile(file, FormatCompletion(program_, shell));
    return file;
  }
  bool Has(const std::string& shell) {
    return std::system(("command -v " + shell + " >/dev/null").c_str()) == 0;
  }
  // What bash would offer after these words, the last of which is being typed.
  std::string Complete(const std::string& words) {
    const fs::path file = Write("bash"), out = fs::path(testing::TempDir()) /
                                               (std::to_string(::getpid()) + "_completion.out");
    const std::string script = ". " + file.string() + "; COMP_WORDS=(" + words +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _graspbench; echo "
                               "\"${COMPREPLY[*]}\" >" +
                               out.string();
    EXPECT_EQ(std::system(("bash -c '" + script + "'").c_str()), 0);
    std::string text = ReadFile(out);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
  }

  Command program_;
  std::string hand_;
  int jobs_ = 2;
};

TEST_F(CommandLineTextTest, BashCompletesCommandsOptionsAndValues) {
  if (!Has("bash")) GTEST_SKIP() << "bash is not installed";
  EXPECT_EQ(Complete("graspbench r"), "run");
  EXPECT_EQ(Complete("graspbench hand \"\""), "show --help");
  EXPECT_EQ(Complete("graspbench hand show --"), "--help --unit --json");
  EXPECT_EQ(Complete("graspbench hand show --unit \"\""), "m mm");
  EXPECT_EQ(Complete("graspbench run --hand sh"), "shadow shadow-evolved");
  EXPECT_EQ(Complete("graspbench run --hand tum,shadow-"), "tum,shadow-evolved");
  EXPECT_EQ(Complete("graspbench run --jobs \"\""), "");  // a number
  EXPECT_EQ(Complete("graspbench run --jobs 3 --h"), "--help --hand");
}

TEST_F(CommandLineTextTest, ShellsAcceptTheirScripts) {
  for (const std::string& shell : ListShells()) {
    const fs::path file = Write(shell);
    if (!Has(shell)) continue;
    EXPECT_EQ(std::system((shell + " -n " + file.string()).c_str()), 0) << shell;
  }
}

TEST_F(CommandLineTextTest, TheManPageHasEveryCommandAndOption) {
  const std::string page = FormatManPage(program_);
  EXPECT_EQ(page.find(".TH GRASPBENCH 1\n"), 0u);
  EXPECT_NE(page.find(".SS graspbench hand show\nIt's a hand.\n"), std::string::npos) << page;
  EXPECT_NE(page.find(".B \\-\\-jobs \\fIN\\fR\n\\&.5 at a time (default 2)\n"), std::string::npos)
      << page;
  EXPECT_NE(page.find(".B \\-\\-json\nas JSON\n"), std::string::npos) << page;
}

}  // namespace
}  // namespace graspbench
