#include "datasets/benchmark/board.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/session/find_trial.h"
#include "tests/datasets/benchmark/made_board.h"
#include "tests/datasets/find_error.h"

namespace graspbench {
namespace {

std::vector<std::string> ListRanked(const Board& board) {
  std::vector<std::string> lines;
  for (const BoardLine& line : board.lines) {
    lines.push_back((line.rank ? std::to_string(*line.rank) : "-") + " " + line.entry->facts.name);
  }
  return lines;
}

using Names = std::vector<std::string>;

// 9 of 10 on each of 9 objects against 1 of 10 differs beyond chance; 9 against 8 on one does not.
TEST(BoardTest, LinesShareARankUnlessTheirDifferenceIsSure) {
  const std::vector<int> good(9, 9), bad(9, 1);
  std::vector<int> nearly = good;
  nearly[3] = 8;
  const Board board = MakeBoard({MakeBoardEntry("bad", bad, 10), MakeBoardEntry("good", good, 10),
                                 MakeBoardEntry("nearly", nearly, 10)},
                                9);
  EXPECT_EQ(ListRanked(board), (Names{"1 good", "1 nearly", "3 bad"}));
  EXPECT_EQ(board.lines[0].tally.successes(), 81);
  EXPECT_NEAR(board.lines[1].behind.estimate, -1.0 / 90.0, 1e-12);
  EXPECT_NEAR(board.lines[2].behind.estimate, -0.8, 1e-12);
  EXPECT_LT(board.lines[2].behind.interval->high, 0.0);
  EXPECT_GE(board.lines[1].behind.interval->high, 0.0);
}

TEST(BoardTest, TheOrderOfThePacksChangesNoRank) {
  const auto a = MakeBoardEntry("a", {9, 9, 9, 9, 9, 9}, 10);
  const auto b = MakeBoardEntry("b", {9, 9, 9, 9, 9, 9}, 10);
  const auto c = MakeBoardEntry("c", {1, 2, 1, 0, 1, 1}, 10);
  EXPECT_EQ(ListRanked(MakeBoard({a, b, c}, 6)), ListRanked(MakeBoard({c, b, a}, 6)));
}

TEST(BoardTest, WhoRepeatsAnothersResultsHasNoRank) {
  BoardEntry first = MakeBoardEntry("first", {3, 2}, 4), copy = MakeBoardEntry("copy", {3, 2}, 4);
  Session trials = MakeBoardSession("copy", {3, 2}, 4);  // ids of its own
  for (TrialRecord& record : trials.records) record.result.reason = "first";
  copy.reproduction = CompareRecords(trials, trials);
  const Board board = MakeBoard({first, copy}, 2);
  EXPECT_EQ(ListRanked(board), Names{"1 first"});
  ASSERT_EQ(board.refused.size(), 1u);
  EXPECT_EQ(board.refused[0].pack, "copy.tar");
  EXPECT_TRUE(Has(board.refused[0].reason, "same results in every trial as \"first\""));
}

// "lucky" was chosen on the public draws: 30 points of its success do not stand there.
TEST(BoardTest, HeldOutDrawsRankAndTheDifferenceStandsBeside) {
  BoardEntry lucky = MakeBoardEntry("lucky", std::vector<int>(8, 10), 10);
  BoardEntry sound = MakeBoardEntry("sound", std::vector<int>(8, 9), 10);
  const BoardEntry actions = MakeBoardEntry("actions", std::vector<int>(8, 10), 10);
  lucky.held_out = TakeDraws(MakeBoardSession("l", {7, 7, 6, 7, 8, 7, 7, 7}, 10, 7));
  sound.held_out = TakeDraws(MakeBoardSession("s", std::vector<int>(8, 9), 10, 7));
  Board board;
  board.benchmark.name = "made/1";
  board.held_out_seed = 7;
  board.entries = {lucky, actions, sound};
  RankEntries(MakeBoardInputs(8), board);
  EXPECT_EQ(ListRanked(board), (Names{"1 sound", "2 lucky", "- actions"}));
  EXPECT_NEAR(*board.lines[0].gap, 0.0, 1e-12);
  EXPECT_NEAR(*board.lines[1].gap, 0.3, 1e-12);
  EXPECT_FALSE(board.lines[2].gap);
}

// "grippy" holds the three objects with least friction, "strong" the three heaviest, which are the
// same ones here; "other" the rest.
TEST(BoardTest, TheBestOnSlipperyObjectsIsNamed) {
  const Board board = MakeBoard({MakeBoardEntry("grippy", {9, 9, 9, 1, 1, 1, 1, 1, 1}, 10),
                                 MakeBoardEntry("other", {1, 1, 1, 9, 9, 9, 9, 9, 9}, 10)},
                                9);
  EXPECT_EQ(ListRanked(board)[0], "1 other");
  std::map<std::string, const GroupWinner*> winners;
  for (const GroupWinner& one : board.winners) winners[one.group] = &one;
  const GroupWinner& slippery = *winners.at("least friction");
  EXPECT_EQ(slippery.objects, (Names{"o0", "o1", "o2"}));
  EXPECT_EQ(slippery.best->entry->facts.name, "grippy");
  EXPECT_EQ(slippery.tally.successes(), 27);
  EXPECT_NEAR(slippery.lead.estimate, 0.8, 1e-12);
  EXPECT_TRUE(IsSure(slippery.lead));
  EXPECT_EQ(NameTrial(board.lines[0].examples.at("o0")->plan), "tum-o0-g1:1");  // failed first
  EXPECT_EQ(winners.at("most friction")->best->entry->facts.name, "other");
  EXPECT_EQ(winners.at("heaviest")->best->entry->facts.name, "grippy");
  EXPECT_EQ(winners.at("lightest")->best->entry->facts.name, "other");
  EXPECT_EQ(winners.at("o0")->best->entry->facts.name, "grippy");
  EXPECT_EQ(winners.at("all objects")->best->entry->facts.name, "other");
}

// The fourth object has the friction of the third; both entries hold the same trials.
TEST(BoardTest, ObjectsOfEqualFrictionStayTogetherAndEqualEntriesAreTied) {
  SessionInputs inputs = MakeBoardInputs(9);
  const auto equal = MakeFakeObject("o3");
  equal->surface.friction_static = inputs.objects[2]->surface.friction_static;
  inputs.objects[3] = equal;
  Board board;
  board.benchmark.name = "made/1";
  board.entries = {MakeBoardEntry("one", std::vector<int>(9, 9), 10),
                   MakeBoardEntry("other", {9, 9, 9, 9, 9, 9, 9, 9, 1}, 10)};
  RankEntries(inputs, board);
  std::map<std::string, const GroupWinner*> winners;
  for (const GroupWinner& winner : board.winners) winners[winner.group] = &winner;
  EXPECT_EQ(winners.at("least friction")->objects, (Names{"o0", "o1", "o2", "o3"}));
  EXPECT_EQ(winners.at("least friction")->num_tied, 1);
  EXPECT_EQ(winners.at("all objects")->num_tied, 0);
}

// "arm" is best of one kind of lines and "bare" of the other; all are of the same hand and sensing.
TEST(BoardTest, TheBestOfEachControllerAndYearIsNamed) {
  BoardEntry arm = MakeBoardEntry("arm", std::vector<int>(8, 5), 10);
  BoardEntry bare = MakeBoardEntry("bare", std::vector<int>(8, 9), 10);
  BoardEntry other = MakeBoardEntry("other", std::vector<int>(8, 1), 10);
  arm.public_draws.config.arm.model = "puma560";
  bare.facts.date = "2025-01-01";
  std::map<std::string, const GroupWinner*> winners;
  const Board board = MakeBoard({arm, bare, other}, 8);
  for (const GroupWinner& one : board.winners) winners[one.group] = &one;
  EXPECT_EQ(winners.count("hand tum"), 0u);
  EXPECT_EQ(winners.at("controller strategy")->best->entry->facts.name, "bare");
  EXPECT_EQ(winners.at("controller strategy")->num_lines, 2);
  EXPECT_EQ(winners.at("controller strategy, arm puma560")->best->entry->facts.name, "arm");
  EXPECT_EQ(winners.at("controller strategy, arm puma560")->second, nullptr);
  EXPECT_EQ(winners.at("year 2025")->best->entry->facts.name, "bare");
  EXPECT_EQ(winners.at("year not declared")->best->entry->facts.name, "arm");
  EXPECT_EQ(winners.at("year not declared")->tally.successes(), 40);
}

TEST(BoardTest, ThresholdsAndBreakingLoadsAreMediansOfTheLine) {
  BoardEntry entry = MakeBoardEntry("one", {2, 2}, 3);
  ThresholdSummary thresholds;
  thresholds.scale = &kThresholdScales[0];
  const std::vector<double> margins = {1.0, 2.0, HUGE_VAL, 1.5, 4.0, kUnset};
  for (size_t i = 0; i < margins.size(); ++i) {
    BoardTrial& trial = entry.public_draws.trials[i];
    thresholds.draws.push_back({trial.plan, 0, {}, margins[i]});
    if (IsSuccess(trial.outcome)) trial.breaking_force = 3.0 + double(i);  // of draws 0, 1, 3 and 4
  }
  entry.thresholds = thresholds;
  const Board board = MakeBoard({entry, MakeBoardEntry("two", {1, 1}, 3)}, 2);
  const auto show = [&](const char* heading) {
    return ShowTable(ListBoardColumns(), board.lines, {heading}).columns.at(0).cells;
  };
  EXPECT_EQ(show("Grip threshold [margin]"), (Names{"2.00", ""}));
  EXPECT_EQ(show("Breaking load [N]"), (Names{"5.0", ""}));
  EXPECT_EQ(show("Year (declared)"), (Names{"not declared", "not declared"}));
}

// Of trials 3, 4 and 5 of three, one ends otherwise and one differs in a number.
TEST(BoardTest, RecordsAreComparedFieldByField) {
  const Session entry = MakeBoardSession("e", {2, 2}, 3);
  Session again = entry;
  EXPECT_EQ(CompareRecords(entry, again).num_identical, 6);
  EXPECT_TRUE(CompareRecords(entry, again).first.empty());
  again.records[3].result.lift_height = 0.6;
  again.records[4].result.outcome = Outcome::kNoContact;
  const Reproduction found = CompareRecords(entry, again);
  EXPECT_EQ(found.num_trials, 6);
  EXPECT_EQ(found.num_identical, 4);
  EXPECT_EQ(found.num_other_outcome, 1);
  EXPECT_TRUE(Has(found.first, "tum-o1-g1:0"));
  EXPECT_FALSE(found.is_within_tolerance());
  EXPECT_TRUE((Reproduction{200, 0, 2, ""}).is_within_tolerance());
  EXPECT_FALSE((Reproduction{200, 0, 3, ""}).is_within_tolerance());
  again.records.pop_back();
  EXPECT_EQ(CompareRecords(entry, again).num_other_outcome, 2);
}

TEST(BoardTest, NoEntryAndOneEntryAreABoard) {
  EXPECT_TRUE(MakeBoard({}, 3).lines.empty());
  const Board board = MakeBoard({MakeBoardEntry("alone", {1, 0, 2}, 2)}, 3);
  EXPECT_EQ(ListRanked(board), Names{"1 alone"});
  EXPECT_EQ(board.winners.front().second, nullptr);
}

}  // namespace
}  // namespace graspbench
