#include "datasets/records/journal_index.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "datasets/session/session_store.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class JournalIndexTest : public testing::Test {
 protected:
  void Write(size_t first, size_t last) {
    JournalWriter writer(folder_.path(), 0, "1of2");
    for (size_t i = first; i < last; ++i) writer.Append(MakeFakeRecord(plan_[i]));
  }
  std::vector<std::string> Read(int* num_bad = nullptr) const {
    std::vector<std::string> ids;
    const int count =
        ForEachTrialOf(journal_, IndexUse::kBelieve, 0,
                       [&](std::string_view id, std::string_view) { ids.emplace_back(id); });
    if (num_bad) *num_bad = count;
    return ids;
  }
  std::vector<std::string> Ids(size_t first, size_t last) const {
    std::vector<std::string> ids;
    for (size_t i = first; i < last; ++i) ids.push_back(plan_[i].id);
    return ids;
  }
  TemporaryFolder folder_;
  const std::vector<PlannedTrial> plan_ = CreateFakeSession(folder_.path(), 3);
  const fs::path journal_ = folder_.path() / "journal" / "1of2-0.jsonl";
  const fs::path index_ = folder_.path() / "progress" / "1of2-0.jsonl";
};

// That the index is asked is seen by a record whose own bytes no longer match.
TEST_F(JournalIndexTest, SparesTheRecordsThatItNames) {
  Write(0, 3);
  std::string text = ReadFile(journal_);
  text[text.find("lift_height") + 16] ^= 1;
  WriteFile(journal_, text);
  fs::last_write_time(journal_, fs::last_write_time(index_));  // a disk's fault is no write
  EXPECT_EQ(Read(), Ids(0, 3));
  fs::remove(index_);
  int num_bad = 0;
  EXPECT_EQ(Read(&num_bad).size(), 2u);
  EXPECT_EQ(num_bad, 1);
}

TEST_F(JournalIndexTest, WhatItLacksIsReadInTheJournal) {
  Write(0, 3);
  const std::string whole = ReadFile(index_);
  for (size_t length = 0; length <= whole.size(); length += 7) {
    WriteFile(index_, whole.substr(0, length));
    EXPECT_EQ(Read(), Ids(0, 3)) << length;
  }
  WriteFile(index_, "no index\n");
  EXPECT_EQ(Read(), Ids(0, 3));
  Write(3, 4);  // made anew, and goes on
  EXPECT_EQ(ReadFile(index_).substr(0, whole.size()), whole);
  EXPECT_EQ(Read(), Ids(0, 4));
}

// A repaired or replaced journal: the places no longer hold what the index says.
TEST_F(JournalIndexTest, AnIndexOfAnotherJournalIsNotBelieved) {
  Write(0, 3);
  const std::string text = ReadFile(journal_);
  WriteFile(journal_, text.substr(text.find('\n') + 1));
  EXPECT_EQ(Read(), Ids(1, 3));
  WriteFile(journal_, "");
  EXPECT_TRUE(Read().empty());
  Write(1, 3);
  EXPECT_EQ(Read(), Ids(1, 3));
  fs::remove(journal_);
  Write(3, 6);
  EXPECT_EQ(Read(), Ids(3, 6));
}

TEST_F(JournalIndexTest, TornLinesAreNoTrials) {
  Write(0, 2);
  const std::string text = ReadFile(journal_);
  WriteFile(journal_, text + text.substr(0, 100));
  int num_bad = 0;
  EXPECT_EQ(Read(&num_bad), Ids(0, 2));
  EXPECT_EQ(num_bad, 0);
}

// What a manifest seals is counted by its ids; behind it each line is checked.
TEST_F(JournalIndexTest, ChecksWhatIsNotSealed) {
  Write(0, 3);
  std::string text = ReadFile(journal_);
  const size_t first_end = text.find('\n') + 1;
  text[text.find("lift_height") + 16] ^= 1;
  WriteFile(journal_, text);
  const auto count_bad = [&](uintmax_t sealed) {
    std::string read;
    return ForEachTrialOf(journal_, IndexUse::kIgnore, sealed,
                          [&](std::string_view, std::string_view line) { read += line; });
  };
  EXPECT_EQ(count_bad(0), 1);
  EXPECT_EQ(count_bad(first_end - 1), 1) << "not all of it";
  EXPECT_EQ(count_bad(first_end), 0);
}

}  // namespace
}  // namespace graspbench
