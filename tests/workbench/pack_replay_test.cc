#include "workbench/pack_replay.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/commands/command.h"

namespace graspbench {
namespace {

// What a good pack gives is told by tests/workbench/experiments/pipelines/replay_pack_test.cc.
TEST(PackReplayCommand, WhatIsNoPackIsRefusedByName) {
  ExitCode exit_code = kExitOk;
  Command program;
#define GRASPBENCH_COMMAND(Name, room) Add##Name##Command(program, exit_code);
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
