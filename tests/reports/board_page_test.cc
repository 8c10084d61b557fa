#include "reports/board_page.h"

#include <gtest/gtest.h>

#include "tests/datasets/benchmark/made_board.h"
#include "tests/datasets/find_error.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

Board MakeSmallBoard(const std::string& name) {
  BoardEntry named = MakeBoardEntry("first", {9, 9, 9, 1, 1, 1}, 10);
  named.facts.name = name;
  Board board = MakeBoard({named, MakeBoardEntry("second", {1, 1, 1, 0, 0, 0}, 10)}, 6);
  board.refused.push_back({"bad.tar", "", "\"bad.tar\" is cut off"});
  return board;
}

TEST(BoardPageTest, ItSaysWhoIsBestWhereAndWhatHasNoRank) {
  const std::string page = MakeBoardPage(MakeSmallBoard("first"));
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "ranks"),
              {"Best: 1. first, tum with 30 of 60 trials", "5.0", "the public draws"});
  ExpectParts(TextOfId(page, "winners"),
              {"slippery (least friction): o0, o1", "first, tum", "18 of 20", "yes"});
  ExpectParts(TextOfId(page, "failures"),
              {"tum-o0-g1:9", "slipped in lift-off", "tar xf first.tar -C entry",
               "trial entry/session tum-o0-g1:9 --page"});
  EXPECT_TRUE(Has(page, "href=\"#failed-0-o0\""));
  ExpectParts(TextOfId(page, "refused"), {"bad.tar", "is cut off"});
  ExpectParts(TextOfId(page, "rules"), {"Not found: grasps or controllers that were chosen"});
}

// One entry never fails on o1: its cell leads to a success.
TEST(BoardPageTest, WhereTrialsAreShownEveryCellLeadsToOneOfItsOwn) {
  const Board board = MakeBoard({MakeBoardEntry("first", {1, 2}, 2)}, 2);
  const std::string page = MakeBoardPage(board, true);
  EXPECT_TRUE(Has(page, "href=\"trials/0.html#view-first0-1\""));
  EXPECT_TRUE(Has(page, "href=\"trials/0.html#view-first1-0\""));
  const std::string trials = MakeTrialsPage(
      board, board.lines[0],
      [](const PlannedTrial&) -> TracedTrial { throw Error(ErrorKind::kIo, "gone"); });
  ExpectSoundPage(trials);
  ExpectParts(TextOfId(trials, "trials"), {"tum-o0-g1:1", "tum-o1-g1:0"});
}

TEST(BoardPageTest, NamesAreTextWhateverTheyHold) {
  const std::string name = "<script>alert(1)</script><b>\"&'";
  Board board = MakeSmallBoard(name);
  board.entries[0].facts.notes = "<img src=x onerror=alert(1)>\n\n</blockquote><h1>best";
  const std::string page = MakeBoardPage(board);
  ExpectSoundPage(page);
  EXPECT_EQ(page.find("<script>alert"), page.npos);
  EXPECT_EQ(page.find("<img src=x"), page.npos);
  EXPECT_TRUE(Has(TextOfId(page, "ranks"), name));
  EXPECT_TRUE(Has(TextOfId(page, "entries"), "</blockquote><h1>best"));
}

TEST(BoardPageTest, HeldOutDrawsAreNamedWithTheirCommitment) {
  BoardEntry entry = MakeBoardEntry("one", {2, 2}, 2);
  entry.held_out = TakeDraws(MakeBoardSession("h", {1, 1}, 2, 7));
  Board board;
  board.benchmark.name = "made/1";
  board.held_out_seed = 7;
  board.commitment = "c0ffee";
  board.entries = {entry};
  RankEntries(MakeBoardInputs(2), board);
  const std::string page = MakeBoardPage(board);
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "ranks"), {"held-out draws of seed 7", "50.0"});
  ExpectParts(TextOfId(page, "rules"), {"commitment c0ffee"});
}

TEST(BoardPageTest, TwoHundredEntriesAreAPageThatABrowserOpens) {
  std::vector<BoardEntry> entries;
  for (int i = 0; i < 200; ++i) {
    std::vector<int> successes(21);
    for (int object = 0; object < 21; ++object) successes[object] = (i * 7 + object * 3) % 11;
    entries.push_back(MakeBoardEntry("entry " + std::to_string(i), successes, 10));
  }
  const std::string page = MakeBoardPage(MakeBoard(std::move(entries), 21));
  EXPECT_LT(page.size(), 10'000'000u);
}

TEST(BoardPageTest, ABoardWithoutEntriesIsAPage) {
  ExpectSoundPage(MakeBoardPage(MakeBoard({}, 2)));
}

}  // namespace
}  // namespace graspbench
