#include "workbench/terminal/command_line.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/error.h"
#include "datasets/plan/scene_names.h"

namespace graspbench {

namespace {

using Words = std::vector<std::string>;

class CommandLineTest : public testing::Test {
 protected:
  CommandLineTest() {
    program_.Describe("graspbench", "What it is.", "  graspbench run can");
    program_.RequireSubcommand();
    program_.AddVersionFlag("--version,-V", "graspbench 1.2", "the version");
    Command& run = AddSubcommand(program_, "run", "Runs.", "  graspbench run can --trials 3");
    run.AddOption("object", object_, "what", "O")->Require();
    run.AddOption("--trials", trials_, "how many", "N")->Within(1, 9)->ShowDefault();
    run.AddOption("--unit", unit_, "of length")->OneOf({"m", "mm"});
    run.AddOption("--preset", unit_, "settings")->Suggest({"a", "b"});
    run.AddOption("--sizes", sizes_, "some")->SplitAtCommas();
    run.AddOption("--scale", scale_, "of the mesh");
    json_ = run.AddFlag("--json", "as JSON");
    run.AddFlag("--all", all_, "every one")->Excludes(json_);
    run.SetAction([this] { ++num_runs_; });
  }
  /** The first line: the second names the help. */
  std::string FindFault(const Words& words) {
    const std::string fault = program_.Parse(words).fault;
    return fault.substr(0, fault.find('\n'));
  }

  Command program_;
  std::filesystem::path object_;
  int trials_ = 2, num_runs_ = 0;
  std::string unit_;
  std::vector<double> sizes_;
  std::optional<double> scale_;
  bool all_ = false;
  Option* json_ = nullptr;
};

TEST_F(CommandLineTest, WordsBecomeValuesAndTheActionRuns) {
  const Command::Parsed parsed =
      program_.Parse({"run", "can", "--trials", "3", "--sizes", "0.5,2", "--scale=1e-3", "--json"});
  EXPECT_EQ(parsed.fault, "");
  EXPECT_FALSE(parsed.answer);
  EXPECT_EQ(num_runs_, 1);
  EXPECT_EQ(object_, "can");
  EXPECT_EQ(trials_, 3);
  EXPECT_EQ(sizes_, (std::vector<double>{0.5, 2.0}));
  EXPECT_EQ(scale_, 1e-3);
  EXPECT_TRUE(json_->IsGiven());
  EXPECT_FALSE(all_);
  EXPECT_TRUE(program_.Subcommand("run").IsGiven("--trials"));
  EXPECT_FALSE(program_.Subcommand("run").IsGiven("--unit"));
}

TEST_F(CommandLineTest, WhatIsNotGivenKeepsItsValue) {
  EXPECT_EQ(FindFault({"run", "can"}), "");
  EXPECT_EQ(trials_, 2);
  EXPECT_FALSE(scale_);
  EXPECT_FALSE(json_->IsGiven());
}

TEST_F(CommandLineTest, AFaultIsSaidInTheWordsTyped) {
  EXPECT_EQ(FindFault({}).find("a command is missing"), 0u);
  EXPECT_EQ(FindFault({"rnu"}).find("unknown command \"rnu\""), 0u);
  EXPECT_EQ(FindFault({"run", "can", "--trails=3"}).find("unknown option \"--trails\""), 0u);
  EXPECT_EQ(FindFault({"run", "can", "cup"}), "unexpected argument \"cup\"");
  EXPECT_EQ(FindFault({"run", "can", "--sizes", "x"}), "--sizes = x: a whole number is expected");
  EXPECT_NE(FindFault({"run", "can", "--trials", "10"}).find("10 not in range 1 to 9"),
            std::string::npos);
  EXPECT_NE(FindFault({"run", "can", "--unit", "km"}).find("km not in {m,mm}"), std::string::npos);
  EXPECT_NE(FindFault({"run", "can", "--all", "--json"}), "");
  EXPECT_NE(program_.Parse({"run"}).fault.find("\nsee: graspbench run --help"), std::string::npos);
  EXPECT_EQ(num_runs_, 0);
}

TEST_F(CommandLineTest, HelpAndVersionAreAnswers) {
  EXPECT_EQ(program_.Parse({"--version"}).answer, "graspbench 1.2\n");
  const Command::Parsed parsed = program_.Parse({"run", "--help"});
  ASSERT_TRUE(parsed.answer);
  EXPECT_EQ(parsed.answer->find("Examples:\n  graspbench run can --trials 3\n"), 0u);
  EXPECT_NE(parsed.answer->find("how many (default 2)"), std::string::npos);
  EXPECT_EQ(program_.Subcommand("run").FormatHelp("graspbench"), *parsed.answer);
}

using Words = std::vector<std::string>;

TEST(TypedWords, AreSplitAtBlanksOutsideOfQuotes) {
  EXPECT_EQ(SplitWords(""), Words());
  EXPECT_EQ(SplitWords("  \t "), Words());
  EXPECT_EQ(SplitWords(" goto\t1.25s\r"), Words({"goto", "1.25s"}));
  EXPECT_EQ(SplitWords("save 'my grasp.yaml'"), Words({"save", "my grasp.yaml"}));
  EXPECT_EQ(SplitWords("'a b'c ''"), Words({"a bc", ""}));
  EXPECT_EQ(SplitWords("it's \"it's\""), Words({"it's", "it's"}));
}

TEST(TypedWords, EndAtAComment) {
  EXPECT_EQ(SplitWords("# all of it"), Words());
  EXPECT_EQ(SplitWords("run # to the end"), Words({"run"}));
  EXPECT_EQ(SplitWords("save a#b '#c'"), Words({"save", "a#b", "#c"}));
}

TEST(TypedWords, AQuoteWithoutEndIsRefused) {
  EXPECT_THROW(SplitWords("save 'my grasp"), Error);
  EXPECT_THROW(SplitWords("\""), Error);
}

TEST(TypedWords, NumbersMayCarryTheirUnit) {
  EXPECT_EQ(ParseNumber("1.25", "the time", "s", 0.0, 10.0), 1.25);
  EXPECT_EQ(ParseNumber("1.25s", "the time", "s", 0.0, 10.0), 1.25);
  EXPECT_EQ(ParseNumber("-3deg", "the angle", "deg", -5.0, 5.0), -3.0);
  for (const char* wrong : {"", "s", "nan", "inf", "1e999", "1 2", "1ms", "11", "-1", "0x"}) {
    EXPECT_THROW(ParseNumber(wrong, "the time", "s", 0.0, 10.0), Error) << wrong;
  }
  EXPECT_EQ(ParseCount("7", "the draw", 0, 9), 7);
  for (const char* wrong : {"", "1.5", "ten", "-1", "10", "99999999999999999999"}) {
    EXPECT_THROW(ParseCount(wrong, "the draw", 0, 9), Error) << wrong;
  }
}

}  // namespace

}  // namespace graspbench
