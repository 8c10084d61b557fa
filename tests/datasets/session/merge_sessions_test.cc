#include "datasets/session/merge_sessions.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/session/judgement_store.h"
#include "datasets/shards/worker_log.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class MergeSessionsTest : public testing::Test {
 protected:
  fs::path Make(const std::string& name, const std::vector<size_t>& places) {
    const fs::path folder = top_.path() / name;
    plan_ = CreateFakeSession(folder, 3);
    JournalWriter journal(folder, 0, name);
    for (const size_t place : places) journal.Append(MakeFakeRecord(plan_[place]));
    return folder;
  }
  static std::string Export(const fs::path& folder) {
    ExportSession(folder, LoadSession(folder), true);
    return ReadFile(folder / "export" / "records.jsonl") + ReadFile(folder / "index.sqlite");
  }
  /** The message of what must not be merged; nothing may have changed. */
  static std::string Refuse(const fs::path& folder, const std::vector<fs::path>& others,
                            ErrorKind kind) {
    const auto read_all = [&] {
      std::string text;
      for (const fs::path& path : ListJournals(folder)) text += path.string() + ReadFile(path);
      return text;
    };
    const std::string before = read_all();
    try {
      MergeSessions(folder, others);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
      EXPECT_EQ(read_all(), before);
      return error.what();
    }
    ADD_FAILURE() << "was merged";
    return "";
  }
  TemporaryFolder top_;
  std::vector<PlannedTrial> plan_;
};

// Without an editor: the file of one of two machines is left out and stays beside.
TEST_F(MergeSessionsTest, OneOfTwoResultsCanBeSetAside) {
  const fs::path here = Make("1of2", {0, 1}), there = Make("2of2", {2});
  TrialRecord other = MakeFakeRecord(plan_[1]);
  other.result.lift_height += 1.0;
  JournalWriter(there, 0, "1of2").Append(other);
  SealStore(kSessionStore, there);
  const std::string said = Refuse(here, {there}, ErrorKind::kFormat);
  EXPECT_TRUE(Has(said, "has another result than in journal/1of2-0.jsonl"));
  fs::copy(there / "journal" / "1of2-0.jsonl", here / "journal" / "3of3-0.jsonl");
  try {
    LoadSession(here);
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_TRUE(Has(text, "journal/3of3-0.jsonl:1: "));
    EXPECT_TRUE(Has(text, "journal/1of2-0.jsonl:2"));
    EXPECT_TRUE(Has(text, "--set-aside"));
  }
  SetJournalAside(here, "journal/3of3-0.jsonl");
  EXPECT_TRUE(fs::exists(here / "journal" / "3of3-0.jsonl.set-aside"));
  SetJournalAside(there, "journal/1of2-0.jsonl");  // sealed before
  EXPECT_TRUE(CheckStore(there).damages.empty());
  EXPECT_EQ(MergeSessions(here, {there}), 1);
  EXPECT_EQ(LoadSession(here).records.size(), 3u);
  EXPECT_THROW(SetJournalAside(here, "plan.jsonl"), Error);
  EXPECT_THROW(SetJournalAside(here, "../1of2/journal/1of2-0.jsonl"), Error);
}

TEST_F(MergeSessionsTest, IsCommutativeAndIdempotent) {
  const fs::path ab = Make("ab", {0, 1}), ba = Make("ba", {0, 1});
  const fs::path a = Make("a", {1, 2, 5}), b = Make("b", {0, 4, 3, 5});
  EXPECT_EQ(MergeSessions(ab, {a, b}), 4);
  EXPECT_EQ(MergeSessions(ba, {b}), 3);
  EXPECT_EQ(MergeSessions(ba, {a}), 1);
  EXPECT_EQ(LoadSession(ab).records.size(), 6u);
  EXPECT_EQ(Export(ab), Export(ba));
  EXPECT_EQ(MergeSessions(ab, {b, a, ab}), 0);
  EXPECT_EQ(Export(ab), Export(ba));
}

TEST_F(MergeSessionsTest, BringsJudgementsAndWorkers) {
  const fs::path here = Make("here", {0, 1}), there = Make("there", {0, 2});
  Judgement judgement;
  judgement.breaking_force = 2.5;
  JudgementWriter(there, 0, "1of2").Append(plan_[0].id, judgement);
  WorkerLog(there, "1of2").Append({"1of2", "2026-01-31T12:00:00Z", {}, {}});
  EXPECT_EQ(MergeSessions(here, {there}), 1);
  EXPECT_TRUE(LoadSession(here).records[0].judgement);
  Diagnostics findings;
  EXPECT_EQ(LoadWorkers(here, findings).starts.size(), 1u);
  EXPECT_EQ(MergeSessions(here, {there}), 0);
  EXPECT_EQ(LoadWorkers(here, findings).starts.size(), 1u);
}

TEST_F(MergeSessionsTest, RefusesDamage) {
  const fs::path here = Make("here", {0}), there = Make("there", {1, 2});
  const fs::path journal = there / "journal" / "there-0.jsonl";
  const std::string whole = ReadFile(journal);
  WriteFile(journal, whole.substr(5));
  Refuse(here, {there}, ErrorKind::kFormat);
  WriteFile(journal, whole);
  SealStore(kSessionStore, there);
  WriteFile(journal, whole.substr(0, whole.find('\n') + 1));  // cut at a line's end
  Refuse(here, {there}, ErrorKind::kFormat);
  Refuse(here, {top_.path()}, ErrorKind::kNotFound);
}

}  // namespace
}  // namespace graspbench
