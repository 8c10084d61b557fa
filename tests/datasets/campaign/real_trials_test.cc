#include "datasets/campaign/real_trials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/datasets/find_error.h"

namespace graspbench {
namespace {

const std::string kHeading = "hand,object,variant,trial,success,t_TH_s,t_FF_s,note\n";

std::string FindProblems(const std::string& rows, const std::string& heading = kHeading) {
  Diagnostics problems;
  ReadRealTrials(heading + rows, "real.csv", problems);
  return problems.Format();
}

TEST(ReadRealTrials, ReadsWhatWasDoneAndLeavesOutWhatWasNot) {
  Diagnostics problems;
  const std::vector<RealTrial> trials =
      ReadRealTrials(kHeading + "tum,can,standard,0,yes,0.4,0.5,\ntum,can,standard,1,,,,\n" +
                         "tum,can,new-target,0,0,0.3,,Made up\n",
                     "real.csv", problems);
  ASSERT_EQ(problems.Format(), "");
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_TRUE(trials[0].is_success);
  EXPECT_FALSE(trials[0].is_made_up);
  EXPECT_EQ(trials[0].contacts[1].time, 0.5);
  EXPECT_FALSE(trials[1].is_success);
  EXPECT_TRUE(trials[1].is_made_up);
  EXPECT_EQ(trials[1].variant, kNewTarget);
  EXPECT_TRUE(std::isnan(trials[1].contacts[1].time));
}

TEST(ReadRealTrials, EveryFaultIsToldWithItsLine) {
  for (const auto& [rows, fault] :
       {std::pair("tum,can,best,0,1,,,\n", "real.csv:2: error: no variant \"best\""),
        {"tum,can,standard,0,maybe,,,\n", "success is \"maybe\""},
        {"tum,can,standard,0,1,412,530,\n", "are these milliseconds?"},
        {"tum,can,standard,0.5,1,,,\n", "expected 0, 1, 2"},
        {"tum,can,standard,-1,1,,,\n", "expected 0, 1, 2"},
        {"tum,can,standard,0,1,,,\ntum,can,standard,0,0,,,\n", "real.csv:3"}}) {
    EXPECT_TRUE(Has(FindProblems(rows), fault));
  }
  EXPECT_TRUE(Has(FindProblems("tum,can,standard,0,1\n", "hand,object,variant,trial,succes\n"),
                  "unknown column \"succes\""));
  EXPECT_TRUE(Has(FindProblems("", ""), "holds no rows"));
}

// Ten of ten with each of three grasps of the adhesive tape.
TEST(PublishedTrials, AreThoseOfTheScenesAndSaySo) {
  const std::vector<RealTrial> trials =
      LoadPublishedTrials({{"tum", "adhesive_tape"}, {"shadow", "can"}});
  EXPECT_EQ(trials.size(), 30u);
  for (const RealTrial& trial : trials) {
    EXPECT_TRUE(trial.is_success && trial.is_published && !trial.is_made_up);
  }
  EXPECT_TRUE(LoadPublishedTrials({{"shadow", "adhesive_tape"}}).empty());
  for (const PublishedFigure& figure : LoadPublishedFigures()) {
    EXPECT_GT(figure.value, 0.0) << figure.what;
    EXPECT_FALSE(figure.source.empty() || figure.unit.empty()) << figure.what;
  }
}

TEST(CheckRealTrials, NamesWhatTheCampaignDoesNotHave) {
  SessionInputs inputs;
  auto hand = std::make_shared<Hand>();
  hand->id = "tum";
  hand->digits.resize(1);
  hand->digits[0].id = "TH";
  inputs.hands.emplace_back();
  inputs.hands[0].hand = hand;
  auto object = std::make_shared<GraspObject>();
  object->id = "can";
  inputs.objects.push_back(object);
  Diagnostics reading, problems;
  const std::vector<RealTrial> trials =
      ReadRealTrials(kHeading + "tum,can,standard,0,1,0.4,,\ntum,cup,standard,0,1,0.4,0.5,\n" +
                         "shadow,can,standard,0,1,0.4,,\n",
                     "real.csv", reading);
  CheckRealTrials(trials, "real.csv", inputs, problems);
  std::vector<int> lines;
  for (const Diagnostic& entry : problems.entries()) lines.push_back(entry.line);
  EXPECT_EQ(lines, (std::vector<int>{3, 3, 4})) << problems.Format();
}

}  // namespace
}  // namespace graspbench
