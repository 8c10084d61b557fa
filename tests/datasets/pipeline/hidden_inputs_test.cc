#include "datasets/pipeline/hidden_inputs.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/pipeline/made_commands.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class HiddenInputs : public testing::Test {
 protected:
  HiddenInputs() {
    MakeFolder(top_ / "here" / "mine");
    MakeFolder(top_ / "away");
    WriteFile(top_ / "here" / "p.yaml", "stages: {a: {command: make, inputs: {file: s.yaml}}}\n");
  }

  /** What loading the pipeline says to a session file; empty: nothing. */
  std::string Load(const std::string& session) {
    WriteFile(top_ / "here" / "s.yaml", session);
    try {
      LoadPipeline(top_ / "here" / "p.yaml", MakeCommands());
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder temporary_;
  fs::path top_ = temporary_.path();
};

TEST_F(HiddenInputs, WhatLeadsOutOfThePipelineIsRefusedAtItsLine) {
  const std::string away = (top_ / "away").string();
  const std::string message = Load("trials: 1\nobjects:\n  - can\n  - " + away + "\n");
  EXPECT_NE(message.find("s.yaml:4"), message.npos) << message;
  EXPECT_NE(message.find("stage a would read \"" + away + "\""), message.npos) << message;
  EXPECT_NE(Load("objects: [../away]\n"), "");
  EXPECT_NE(Load("deep: {er: [{still: ../away}]}\n"), "");
}

TEST_F(HiddenInputs, WhatStaysInsideOrLeadsNowhereIsLeftToTheCommand) {
  EXPECT_EQ(Load("objects: [can, mine, inputs/mine, ../nowhere, /nowhere/at/all]\n"), "");
  EXPECT_EQ(Load("broken: [\n"), "");  // which the command tells better
  EXPECT_EQ(Load(""), "");
}

}  // namespace
}  // namespace graspbench
