#include "datasets/scene/rehearsal_store.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"
#include "datasets/plan/frozen_folder.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

RehearsedPair MakePair(int request) {
  RehearsedPair pair{request, "tum", "can", "0123456789abcdef", {}};
  RehearsedCandidate failed;
  failed.candidate = {"g1", Approach::kAutomatic, {}, 0.0};
  failed.outcomes = {Outcome::kPushedAway};
  failed.reason = "it slid, then left";
  RehearsedCandidate chosen;
  chosen.candidate = {"g3", Approach::kSide, {0.5, -0.01, 0.02}, 0.3};
  chosen.outcomes = {Outcome::kSuccess, Outcome::kSuccess};
  pair.result = {{failed, chosen}, 1, 3};
  return pair;
}

TEST(RehearsalLine, IsReadAsItWasWritten) {
  const std::string line = RehearsedPair::Format(MakePair(7));
  const RehearsedPair read = RehearsedPair::Parse(line);
  EXPECT_EQ(RehearsedPair::Format(read), line);
  EXPECT_EQ(read.request, 7);
  EXPECT_TRUE(read.result.choice().candidate == MakePair(7).result.choice().candidate);
  EXPECT_EQ(read.result.tried[0].reason, "it slid, then left");
}

TEST(RehearsalLine, AChoiceThatWasNotTriedIsRefused) {
  RehearsedPair pair = MakePair(0);
  pair.result.chosen = 2;
  EXPECT_TRUE(Throws([&] { RehearsedPair::Parse(RehearsedPair::Format(pair)); }, ErrorKind::kFormat,
                     "candidate 2 is chosen of 2"));
}

TEST(RehearsalStore, TheTableHasARowForEachCandidate) {
  const TemporaryFolder folder;
  WriteFrozen(kRehearsalStore, folder.path(), {{"draws", 2}});
  RehearsalJournal(folder.path() / "journal.jsonl").Append({MakePair(0)});
  const std::vector<RehearsedPair> pairs = LoadRehearsals(folder.path());
  ASSERT_EQ(pairs.size(), 1u);
  FinishRehearsals(folder.path(), pairs, {{"grasps/tum/can.yaml", "id: rehearsed\n"}});
  const std::string table = ReadFile(folder.path() / kCandidateTable);
  EXPECT_TRUE(
      Has(table, "\ntum,can,0,g1,automatic,0.0,0.0,0.0,0.0,1,0,1.0,0,\"it slid, then left\"\n"));
  EXPECT_TRUE(Has(table, "\ntum,can,1,g3,side,28.6478897"));  // half a radian
  EXPECT_TRUE(Has(table, ",-0.01,0.02,0.3,2,2,1.0,1,\n"));
  EXPECT_TRUE(LoadRehearsals(folder.path()).size() == 1u);
  EXPECT_TRUE(Throws(
      [&] {
        CheckSameFrozen(kRehearsalStore, folder.path(), {{"draws", 3}});
      },
      ErrorKind::kUsage, "\n  draws"));
  // A damaged grasp file is seen.
  WriteFile(folder.path() / "grasps" / "tum" / "can.yaml", "id: other\n");
  EXPECT_THROW(LoadRehearsals(folder.path()), Error);
}

}  // namespace
}  // namespace graspbench
