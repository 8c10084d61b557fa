#include "datasets/journal/read_journal.h"

#include <gtest/gtest.h>

#include <new>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/session/judgement_store.h"
#include "datasets/session/session_store.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

class ReadJournalTest : public testing::Test {
 protected:
  std::vector<int> Read(const std::string& text) {
    WriteFile(folder_.path() / "j.jsonl", text);
    std::vector<int> taken;
    const auto take = [&](const FileLine& line) {
      taken.push_back(ParseCheckedLine(line.text).at("a").get<int>());
    };
    ReadJournal(folder_.path(), "j.jsonl", take, findings_, damage_);
    return taken;
  }
  TemporaryFolder folder_;
  Diagnostics findings_;
  std::vector<Damage> damage_;
};

std::string Line(const Json& json) { return FormatCheckedLine(json) + "\n"; }

TEST_F(ReadJournalTest, EveryKindOfLineHasOneFate) {
  const std::string good = Line({{"a", 1}}), foreign = Line({{"b", 2}});
  std::string wrong = Line({{"a", 3}});
  wrong[5] = '4';
  EXPECT_EQ(Read(good + "\n" + wrong + foreign + Line({{"a", 5}}) + good.substr(0, 9)),
            (std::vector<int>{1, 5}));
  EXPECT_EQ(findings_.Format(),
            "j.jsonl:3: warning: skipped: its bytes do not match their checksum; it is "
            "ignored\nj.jsonl:6: warning: the last line is incomplete because the program was "
            "stopped; it is ignored");
  ASSERT_EQ(damage_.size(), 1u);
  EXPECT_EQ(damage_[0].path, "j.jsonl");
  EXPECT_EQ(damage_[0].line, 4);
}

TEST_F(ReadJournalTest, AGoodLineWithoutItsLineBreakWasNotFinished) {
  EXPECT_TRUE(Read(FormatCheckedLine({{"a", 1}})).empty());
  EXPECT_EQ(findings_.entries().size(), 1u);
  EXPECT_TRUE(damage_.empty());
}

TEST_F(ReadJournalTest, TooLittleMemoryIsNoFaultOfALine) {
  WriteFile(folder_.path() / "j.jsonl", Line({{"a", 1}}));
  const auto take = [](const FileLine&) { throw std::bad_alloc(); };
  EXPECT_THROW(ReadJournal(folder_.path(), "j.jsonl", take, findings_, damage_), std::bad_alloc);
}

std::string FormatAnswer(int question, double sigma) {
  return FormatCheckedLine({{"request", question},
                            {"stage", "search"},
                            {"trials", Json::array({{{"trial_id", "a"}, {"sigma", sigma}}})}}) +
         "\n";
}

std::vector<int> ListLines(const std::vector<Damage>& damages) {
  std::vector<int> lines;
  for (const Damage& damage : damages) lines.push_back(damage.line);
  return lines;
}

class ForeignLines : public testing::Test {
 protected:
  std::vector<Damage> Find(const std::string& text, const Manifest& manifest = {}) const {
    WriteFile(folder_.path() / "journal.jsonl", text);
    return FindForeignLines(kSceneStore, folder_.path(), "journal.jsonl", manifest);
  }
  TemporaryFolder folder_;
};

TEST_F(ForeignLines, ASearchAnswersEachQuestionOnce) {
  const std::string one = FormatAnswer(1, 0.5), two = FormatAnswer(2, 0.5);
  EXPECT_TRUE(Find(one + two + one).empty());  // equal answers contradict nothing
  const std::vector<Damage> found = Find(one + two + FormatAnswer(1, 0.6) + FormatAnswer(1, 0.7));
  EXPECT_EQ(ListLines(found), (std::vector<int>{1, 3, 4}));
  EXPECT_EQ(found[0].text, "it answers question 1 differently than line 3");
  EXPECT_EQ(found[2].text, "it answers question 1 differently than line 1");
}

TEST_F(ForeignLines, OfAnotherJournalAreNamed) {
  const std::string answer = FormatAnswer(1, 0.5);
  const std::string worker = FormatCheckedLine({{"shard", "1of1"}, {"left", 0}}) + "\n";
  const std::string developed = FormatCheckedLine({{"request", 2},
                                                   {"stage", "search"},
                                                   {"id", "0123456789abcdef"},
                                                   {"trials", Json::array()}}) +
                                "\n";
  EXPECT_EQ(ListLines(Find(answer + worker + developed)), (std::vector<int>{2, 3}));
  // Keys count on the first level only, and in any order; damaged and torn lines are others' affair.
  const std::string nested = FormatCheckedLine({{"x", {{"stage", 1}, {"trials", 2}}}}) + "\n";
  const std::string turned =
      FormatCheckedLine({{"trials", Json::array()}, {"\u00e9", 1}, {"stage", "search"}}) + "\n";
  EXPECT_EQ(ListLines(Find(nested + turned + "{}\n" + worker.substr(0, 9))), std::vector<int>{1});
}

TEST_F(ForeignLines, BehindAResultNothingIsAdded) {
  const std::string one = FormatAnswer(1, 0.5), two = FormatAnswer(2, 0.5);
  Manifest manifest;
  manifest.files = {{"journal.jsonl", one.size(), "", 1}};
  EXPECT_TRUE(Find(one + two, manifest).empty());  // it goes on
  manifest.files.push_back({"result.json", 2, "", std::nullopt});
  EXPECT_EQ(ListLines(Find(one + two, manifest)), std::vector<int>{2});
}

// A judgement in a session's journal, behind the seal and under it.
TEST_F(ForeignLines, AreSetAsideByARepairAndNotSealed) {
  const std::vector<PlannedTrial> plan = CreateFakeSession(folder_.path(), 1);
  JournalWriter(folder_.path(), 0).Append(MakeFakeRecord(plan[0]));
  JudgementWriter(folder_.path(), 0).Append(plan[0].id, Judgement());
  SealStore(kSessionStore, folder_.path());
  const std::filesystem::path journal = folder_.path() / "journal" / "0.jsonl";
  const std::string records = ReadFile(journal);
  const std::string judgement = ReadFile(folder_.path() / "judge" / "0.jsonl");
  for (const bool is_sealed : {false, true}) {
    WriteFile(journal, records + judgement);
    if (is_sealed) SealStore(kSessionStore, folder_.path());
    const std::vector<Damage> damages = CheckStore(folder_.path()).damages;
    ASSERT_EQ(ListLines(damages), std::vector<int>{2});
    EXPECT_EQ(damages[0].path + ": " + damages[0].text,
              "journal/0.jsonl: it is a line of another kind of journal");
    EXPECT_THROW(LoadSession(folder_.path()), Error);
    EXPECT_TRUE(RepairStore(folder_.path()).state.damages.empty());
    EXPECT_EQ(ReadFile(journal), records);
    EXPECT_EQ(ReadFile(journal.string() + ".damaged"),
              is_sealed ? judgement + judgement : judgement);
    EXPECT_EQ(LoadSession(folder_.path()).records.size(), 1u);
  }
}

}  // namespace

}  // namespace graspbench
