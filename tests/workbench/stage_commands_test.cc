#include "workbench/stage_commands.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/command.h"

namespace graspbench {

namespace {

const StageOption* FindStageOption(const StageCommand& command, const std::string& name) {
  for (const StageOption& option : command.options) {
    if (option.name == name) return &option;
  }
  return nullptr;
}

class StageCommands : public testing::Test {
 protected:
  StageCommands() {
#define GRASPBENCH_COMMAND(Name, room) Add##Name##Command(program_);
#include "workbench/commands/command_list.inc"
#undef GRASPBENCH_COMMAND
  }
  StageCommand Find(const std::string& name) const {
    for (const StageCommand& command : ListStageCommands(program_)) {
      if (command.name == name) return command;
    }
    return {};
  }

  Command program_;
};

TEST_F(StageCommands, OptionsAreThoseOfTheCommandLine) {
  const StageCommand run = Find("run");
  ASSERT_NE(FindStageOption(run, "session"), nullptr);
  EXPECT_TRUE(FindStageOption(run, "session")->is_argument);
  EXPECT_FALSE(FindStageOption(run, "session")->is_needed);
  EXPECT_TRUE(FindStageOption(run, "trials")->takes_value);
  EXPECT_FALSE(FindStageOption(run, "trials")->is_own);
  for (const char* own : {"out", "jobs", "resume", "plan-only", "trial-timeout"}) {
    EXPECT_TRUE(FindStageOption(run, own)->is_own) << own;
  }
  EXPECT_FALSE(FindStageOption(Find("campaign"), "compare")->takes_value);
  EXPECT_TRUE(FindStageOption(Find("study run"), "study")->is_needed);
}

// What is written goes to --out, into the copied first argument, or to stdout.
TEST_F(StageCommands, EveryPlaceFitsItsCommand) {
  EXPECT_GE(ListStageCommands(program_).size(), 15u);
  for (const StageCommand& command : ListStageCommands(program_)) {
    const bool has_out = FindStageOption(command, "out") != nullptr;
    EXPECT_TRUE(has_out || command.place != StagePlace::kOwn) << command.name;
    EXPECT_FALSE(has_out && command.place == StagePlace::kText) << command.name;
    if (command.place != StagePlace::kCopy) continue;
    const auto first = std::find_if(command.options.begin(), command.options.end(),
                                    [](const StageOption& option) { return option.is_argument; });
    ASSERT_NE(first, command.options.end()) << command.name;
    EXPECT_TRUE(first->is_needed) << command.name;
  }
}

// What a good pack gives is told by tests/workbench/experiments/pipelines/replay_pack_test.cc.
TEST(PackReplayCommand, WhatIsNoPackIsRefusedByName) {
  Command program;
#define GRASPBENCH_COMMAND(Name, room) Add##Name##Command(program);
#include "workbench/commands/command_list.inc"
#undef GRASPBENCH_COMMAND
  const TemporaryFolder temporary;
  const std::filesystem::path pack = temporary.path() / "some.tar";
  WriteFile(pack, "no tar file at all");
  try {
    ReplayPackFile(program, {pack, temporary.path() / "new", 1, false});
    FAIL();
  } catch (const Error& fault) {
    EXPECT_EQ(fault.kind(), ErrorKind::kFormat);
    EXPECT_NE(std::string(fault.what()).find("some.tar\" is no tar file"), std::string::npos)
        << fault.what();
  }
}

}  // namespace

}  // namespace graspbench
