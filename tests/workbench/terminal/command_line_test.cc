#include "workbench/terminal/command_line.h"

#include <gtest/gtest.h>

#include <filesystem>

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
    run.AddOption("object", object_, "what")->Require()->ValueName("O");
    run.AddOption("--trials", trials_, "how many")->Within(1, 9)->ValueName("N")->ShowDefault();
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

TEST_F(CommandLineTest, ItTellsItsParts) {
  const Command& run = program_.Subcommand("run");
  ASSERT_EQ(run.options().size(), 9u);
  EXPECT_EQ(run.options()[0]->name(), "--help");
  EXPECT_FALSE(run.options()[0]->takes_value());
  const Option& object = *run.options()[1];
  EXPECT_TRUE(object.is_argument());
  EXPECT_TRUE(object.is_required());
  EXPECT_EQ(object.name(), "object");
  EXPECT_EQ(object.value_name(), "O");
  const Option& trials = *run.options()[2];
  EXPECT_EQ(trials.long_names(), Words{"trials"});
  EXPECT_TRUE(trials.takes_value());
  EXPECT_EQ(trials.shown_default(), "2");
  EXPECT_EQ(trials.description(), "how many");
  EXPECT_EQ(run.options()[3]->choices(), (Words{"m", "mm"}));
  EXPECT_EQ(run.options()[4]->choices(), (Words{"a", "b"}));
  EXPECT_EQ(run.examples(), "  graspbench run can --trials 3");
}

TEST(ReadNumber, IsTrueOfWholeWordsAlone) {
  double real = 0.0;
  int whole = 0;
  EXPECT_TRUE(ReadNumber("-1.5e2", real));
  EXPECT_EQ(real, -150.0);
  EXPECT_TRUE(ReadNumber("12", whole));
  EXPECT_EQ(whole, 12);
  for (const char* word : {"", "x", "1x", "1 2"}) EXPECT_FALSE(ReadNumber(word, real)) << word;
  for (const char* word : {"", "1.5", "99999999999"}) EXPECT_FALSE(ReadNumber(word, whole)) << word;
}

}  // namespace
}  // namespace graspbench
