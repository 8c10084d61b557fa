#include "workbench/shell/shell_commands.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/shell/shell.h"
#include "workbench/terminal/command_line.h"

namespace graspbench {
namespace {

using Names = std::vector<std::string>;

TEST(ShellCommands, CompletesWhatFits) {
  Shell shell;
  EXPECT_EQ(FindCompletions(shell, "con"), Names({"contacts"}));
  EXPECT_EQ(FindCompletions(shell, "joi"), Names({"joint", "joints"}));
  EXPECT_EQ(FindCompletions(shell, " hand shad"), Names({"shadow", "shadow-evolved"}));
  EXPECT_EQ(FindCompletions(shell, "joint FFq"), Names({"FFq1", "FFq2", "FFq3"}));
  EXPECT_EQ(FindCompletions(shell, "set sim.step"), Names({"sim.step_s"}));
  EXPECT_EQ(FindCompletions(shell, "HAND shadow-"), Names({"shadow-evolved"}));
  EXPECT_EQ(FindCompletions(shell, "hand shadow s"), Names());
  EXPECT_EQ(FindCompletions(shell, "run to sta"), Names({"stabilisation"}));
  EXPECT_EQ(FindCompletions(shell, "joint FFq2 30 "), Names({"pre", "target"}));
  EXPECT_EQ(FindCompletions(shell, "turn hand "), Names({"x", "y", "z"}));
  EXPECT_EQ(FindCompletions(shell, "view t"), Names({"top"}));
  EXPECT_EQ(FindCompletions(shell, "live o"), Names({"off"}));
  EXPECT_EQ(FindCompletions(shell, "help fi"), Names({"film"}));
  EXPECT_EQ(FindCompletions(shell, "undo x"), Names());
  EXPECT_EQ(FindCompletions(shell, "nothing x"), Names());
  EXPECT_GT(FindCompletions(shell, "").size(), 20u);
}

TEST(ShellCommands, CompletesFilesWhereOneIsExpected) {
  const TemporaryFolder folder;
  const std::string top = folder.path().string() + "/";
  std::filesystem::create_directories(folder.path() / "grasps");
  WriteFileAtomically(folder.path() / "great.yaml", "");
  WriteFileAtomically(folder.path() / ".hidden", "");
  Shell shell;
  EXPECT_EQ(FindCompletions(shell, "grasp " + top + "gr"),
            Names({top + "grasps/", top + "great.yaml"}));
  EXPECT_EQ(FindCompletions(shell, "save " + top), Names({top + "grasps/", top + "great.yaml"}));
  EXPECT_EQ(FindCompletions(shell, "save " + top + "none/"), Names());
  EXPECT_EQ(FindCompletions(shell, "goto " + top), Names());
}

TEST(ShellCommands, EveryExampleFitsItsCommand) {
  for (const ShellCommand& command : ListShellCommands()) {
    const Names words = SplitWords(command.example);
    EXPECT_EQ(words.front(), command.name);
    const int count = static_cast<int>(words.size()) - 1;
    EXPECT_GE(count, command.min_arguments) << command.name;
    EXPECT_LE(count, command.max_arguments) << command.name;
    EXPECT_LT(std::string(command.help).size(), 66u) << command.name << " breaks the overview";
  }
}

}  // namespace
}  // namespace graspbench
