#include "workbench/terminal/terminal_observer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <string>

namespace graspbench {
namespace {

ProgressState MakeState() {
  ProgressState state;
  state.num_planned = 420;
  state.num_done = 132;
  state.outcomes = {{Outcome::kSuccess, 120}, {Outcome::kNoContact, 3}, {Outcome::kPushedAway, 9}};
  state.workers = {"shadow  can  g3  #4", ""};
  state.rate = 3.2;
  return state;
}

TEST(FormatDuration, UsesTheTwoLargestUnits) {
  EXPECT_EQ(FormatDuration(0.0), "0 s");
  EXPECT_EQ(FormatDuration(2.1), "3 s");
  EXPECT_EQ(FormatDuration(60.0), "1 min 0 s");
  EXPECT_EQ(FormatDuration(85.0), "1 min 25 s");
  EXPECT_EQ(FormatDuration(7500.0), "2 h 5 min");
}

TEST(Pace, IsTheRateOfTheLastHalfMinute) {
  Pace pace;
  EXPECT_TRUE(std::isnan(pace.rate()));
  for (int second = 0; second <= 100; ++second) pace.Add(second, second);  // one a second
  EXPECT_DOUBLE_EQ(pace.rate(), 1.0);
  for (int second = 1; second <= 40; ++second) pace.Add(100 + second, 100 + 5 * second);
  EXPECT_DOUBLE_EQ(pace.rate(), 5.0);  // the slow start is forgotten
}

// Interval by the closed form of Wilson 1927 for 120 of 132.
TEST(FormatBlock, ShowsAllThatMatters) {
  const std::vector<std::string> lines = FormatBlock(MakeState(), 200);
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines[0], "  done     [#########---------------------] 132 of 420 trials");
  EXPECT_EQ(lines[1], "  pace     3.2 trials/s, 1 min 30 s left");
  EXPECT_NE(lines[2].find("120 of 132"), std::string::npos) << lines[2];
  EXPECT_NE(lines[2].find("84.8 to 94.7 %"), std::string::npos) << lines[2];
  EXPECT_EQ(lines[3], "  failed   no contact 3, pushed away 9");
  EXPECT_EQ(lines[4], "  worker 1 shadow  can  g3  #4");
  EXPECT_EQ(lines[5], "  worker 2 idle");
}

// Trials of a development cost differently: their number says less than their work.
TEST(FormatBlock, WhatIsLeftFollowsFromTheWorkWhereThatIsKnown) {
  ProgressState state = MakeState();
  state.remaining = 601.0;
  EXPECT_EQ(FormatBlock(state, 200)[1], "  pace     3.2 trials/s, 10 min 1 s left");
  state.remaining = std::numeric_limits<double>::infinity();
  EXPECT_EQ(FormatBlock(state, 200)[1], "  pace     3.2 trials/s");
  state.num_done = state.num_planned;
  EXPECT_EQ(FormatBlock(state, 200)[1], "  pace     3.2 trials/s, done");
}

// What the judge runs again has succeeded before; that is no result of the judge's.
TEST(FormatBlock, OutcomesThatSayNothingAreLeftOut) {
  ProgressState state = MakeState();
  state.counted = "held grasps";
  state.tells_success = false;
  const std::vector<std::string> lines = FormatBlock(state, 200);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "  done     [#########---------------------] 132 of 420 held grasps");
  EXPECT_EQ(lines[1], "  pace     3.2 held grasps/s, 1 min 30 s left");
  EXPECT_EQ(FormatLine(state), "132 of 420 held grasps, 3.2 held grasps/s, 1 min 30 s left");
}

TEST(FormatBlock, NeverWrapsAndNeverGrowsWithoutBound) {
  ProgressState state = MakeState();
  for (const std::string& line : FormatBlock(state, 24)) EXPECT_LE(line.size(), 24u) << line;
  state.workers.assign(64, "shadow  can  g3  #4");
  const std::vector<std::string> lines = FormatBlock(state, 80);
  EXPECT_LE(lines.size(), 14u);
  EXPECT_EQ(lines.back(), "  and 56 more workers");
}

TEST(FormatBlock, BreaksTheListOfFailures) {
  const std::vector<std::string> lines = FormatBlock(MakeState(), 30);
  EXPECT_EQ(lines[3], "  failed   no contact 3,");
  EXPECT_EQ(lines[4], "           pushed away 9");
}

TEST(FormatLine, SaysWhoseMeshIsPrepared) {
  ProgressState state = MakeState();
  state.tells_success = false;
  state.preparing = {"cup", "can"};
  EXPECT_EQ(FormatLine(state),
            "132 of 420 trials, 3.2 trials/s, 1 min 30 s left, preparing the mesh of can, cup");
}

TEST(FormatLine, IsOneLineBeforeTheFirstTrialToo) {
  ProgressState state;
  state.num_planned = 10;
  state.rate = std::nan("");
  EXPECT_EQ(FormatLine(state), "0 of 10 trials; success 0 of 0 trials; failed: none");
}

/** What an observer writes into a pipe. */
class ObserverOnPipe : public testing::Test {
 protected:
  ObserverOnPipe() : file_(std::tmpfile()), observer_(nullptr, stop_, file_) {}
  ~ObserverOnPipe() override { std::fclose(file_); }
  std::string Read() {
    std::rewind(file_);
    std::string text(100000, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), file_));
    return text;
  }
  std::atomic<bool> stop_{false};
  std::FILE* file_;
  TerminalObserver observer_;
};

TEST_F(ObserverOnPipe, WritesPlainLinesFromTimeToTime) {
  observer_.BeginStage(MakeStage(StageKind::kRun, 1000));
  BatchStatus status;
  for (int tick = 0; tick <= 350; ++tick) {  // 35 s at ten a second
    status.num_done = tick;
    status.outcomes[Outcome::kSuccess] = tick;
    observer_.ShowAt(0.1 * tick, status, 1000);
  }
  stop_ = true;
  observer_.ShowStatus(status, 1000);
  observer_.ShowStatus(status, 1000);  // which is said once
  observer_.EndStage();
  const std::string text = Read();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos) << text;
}

TEST_F(ObserverOnPipe, CountsWhatEarlierRunsFinished) {
  Stage stage = MakeStage(StageKind::kRun, 16);
  stage.before = {{Outcome::kSuccess, 4}};
  observer_.BeginStage(stage);
  BatchStatus status;
  status.num_done = 1;
  status.outcomes[Outcome::kSuccess] = 1;
  observer_.ShowAt(1.0, status, 20);
  observer_.EndStage();
  EXPECT_EQ(Read().substr(0, 14), "5 of 20 trials");
}

}  // namespace
}  // namespace graspbench
