#include "datasets/session/damaged_records.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TEST(DamagedRecords, AreReadFromLinesThatFailTheirChecksum) {
  const TemporaryFolder temporary;
  const std::vector<PlannedTrial> plan = CreateFakeSession(temporary.path(), 2);
  {
    JournalWriter writer(temporary.path(), 0);
    for (const PlannedTrial& planned : plan) writer.Append(MakeFakeRecord(planned));
  }
  SealStore(kSessionStore, temporary.path());
  const auto journal = temporary.path() / "journal" / "0.jsonl";
  std::string lines = ReadFile(journal);
  lines.insert(lines.find("\"num_steps\":") + 12, "1");  // of the first trial
  const size_t second = lines.find('\n') + 1;
  lines[second] = '#';  // no JSON any more
  WriteFileAtomically(journal, lines);
  const Session session = LoadSession(temporary.path(), OnDamage::kAccept, RecordParts::kBrief);
  const std::vector<TrialRecord> records = ReadDamagedRecords(session);
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].plan.id, plan[0].id);
  TrialRecord expected = MakeFakeRecord(plan[0]);
  EXPECT_NE(records[0].result.num_steps, expected.result.num_steps);
  expected.result.num_steps = records[0].result.num_steps;
  EXPECT_EQ(ToJson(records[0]), ToJson(expected));
  // A whole line of the trial, in any journal, is what counts.
  JournalWriter(temporary.path(), 1).Append(MakeFakeRecord(plan[0]));
  EXPECT_TRUE(ReadDamagedRecords(LoadSession(temporary.path(), OnDamage::kAccept)).empty());
}

}  // namespace
}  // namespace graspbench
