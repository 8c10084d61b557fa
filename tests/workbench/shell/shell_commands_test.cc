#include "workbench/shell/shell_commands.h"

#include <gtest/gtest.h>

#include "workbench/shell/shell.h"
#include "workbench/shell/shell_words.h"

namespace graspbench {
namespace {

using Names = std::vector<std::string>;

TEST(ShellCommands, CompletesWhatFits) {
  Shell shell;
  EXPECT_EQ(FindCompletions(shell, "con"), Names({"contacts"}));
  EXPECT_EQ(FindCompletions(shell, "joi"), Names({"joint", "joints"}));
  EXPECT_EQ(FindCompletions(shell, " hand s"), Names({"shadow"}));
  EXPECT_EQ(FindCompletions(shell, "joint FFq"), Names({"FFq1", "FFq2", "FFq3"}));
  EXPECT_EQ(FindCompletions(shell, "set sim.st"), Names({"sim.step_s"}));
  EXPECT_EQ(FindCompletions(shell, "undo x"), Names());
  EXPECT_EQ(FindCompletions(shell, "nothing x"), Names());
  EXPECT_GT(FindCompletions(shell, "").size(), 20u);
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
