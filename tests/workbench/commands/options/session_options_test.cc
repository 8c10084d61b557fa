#include "workbench/commands/options/session_options.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "workbench/terminal/command_line.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class SessionOptionsTest : public testing::Test {
 protected:
  SessionOptionsTest()
      : file_(fs::path(testing::TempDir()) / ("pilot_" + std::to_string(::getpid()) + ".yaml")) {
    WriteFileAtomically(file_, "hands: tum\ntrials: 7\nseed: 5\n");
    options_.AddTo(command_);
  }
  ~SessionOptionsTest() override { fs::remove(file_); }

  fs::path file_;
  Command command_;
  SessionOptions options_;
};

// The defaults shown in the help must not override the file.
TEST_F(SessionOptionsTest, OptionsOverrideSettingsAndSettingsTheFile) {
  ASSERT_EQ(command_.Parse(SplitWords(file_.string() + " --set seed=6 --trials 9")).fault, "");
  EXPECT_TRUE(options_.HasAny());
  EXPECT_EQ(options_.name(), file_.stem().string());
  const SessionConfig config = options_.MakeConfig();
  EXPECT_EQ(config.hands, std::vector<std::string>{"tum"});
  EXPECT_EQ(config.trials, 9);
  EXPECT_EQ(config.seed, 6);
}

TEST_F(SessionOptionsTest, AListWithAnEmptyNameIsRefused) {
  for (const char* list : {"g1,,g2", "g1,", ",g1"}) {
    for (const char* option : {"--grasp", "--hand", "--object"}) {
      Command command;
      SessionOptions options;
      options.AddTo(command);
      try {
        command.Parse({option, list});
        FAIL() << option << " " << list;
      } catch (const Error& e) {
        const std::string place = list[0] == ',' ? "1" : "2";
        EXPECT_EQ(std::string(e.what()).find(std::string(option) + " \"" + list + "\": name " +
                                             place + " of the list is empty"),
                  0u)
            << e.what();
      }
    }
  }
  ASSERT_EQ(command_.Parse(SplitWords("--grasp g1,g2 --grasp g3 --hand tum")).fault, "");
  const SessionConfig config = options_.MakeConfig();
  EXPECT_EQ(config.grasps, (std::vector<std::string>{"g1", "g2", "g3"}));
  EXPECT_EQ(config.hands, std::vector<std::string>{"tum"});
}

TEST_F(SessionOptionsTest, APresetStandsInThePlaceOfAFile) {
  ASSERT_EQ(command_.Parse(SplitWords("--preset benchmark --set seed=6 --trials 9")).fault, "");
  EXPECT_TRUE(options_.HasAny());
  EXPECT_EQ(options_.name(), "benchmark");
  SessionConfig expected;
  expected.seed = 6;
  expected.trials = 9;
  EXPECT_EQ(ToJson(options_.MakeConfig()), ToJson(expected));
}

TEST_F(SessionOptionsTest, WhatContradictsItselfIsRefused) {
  const std::pair<std::string, const char*> cases[] = {
      {file_.string() + " --preset benchmark", "preset: benchmark"},
      {"--set sim.step_s=0.001 --set trials=8 --trials 9",
       "--set trials=8 and --trials set the same value; give one of them"},
      {"--arm pa10 --set arm.base_y_m=0.2 --arm-base -0.5,0,0,0",
       "--set arm.base_y_m=0.2 and --arm-base set the same value; give one of them"},
      {"--arm-base -0.5,0,0,0", "--arm-base: the session has no arm; add --arm"},
      {"--arm none --arm-base -0.5,0,0,0", "the session has no arm"},
      {"--set strategy.grip_force_n=3 --set strategy.grip=posture",
       "strategy.grip_force_n=3 has no effect if strategy.grip is posture"}};
  for (const auto& [words, expected] : cases) {
    Command command;
    SessionOptions options;
    options.AddTo(command);
    ASSERT_EQ(command.Parse(SplitWords(words)).fault, "");
    try {
      options.MakeConfig();
      ADD_FAILURE() << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kUsage);
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace graspbench
