#include "datasets/scene/evaluation_journal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

EvaluationRecord MakeRecord(int number) {
  EvaluationRecord record;
  record.request = number;
  record.stage = LearningStage::kSearch;
  record.individual.number = number;
  record.individual.generation = 2;
  record.individual.parents = {3, 1};
  record.individual.genome = Eigen::Vector3d(0.1, 0.2 + number, -1.0 / 3.0);
  record.individual.steps = Eigen::Vector3d(0.1, 0.1, 0.1);
  LearningTrial trial;
  trial.draw = 0;
  trial.outcome = Outcome::kSuccess;
  trial.sigma = 1.0 + 0.1 * number;
  trial.contacts = {{"TH", true, 0.4}, {"FF", false, std::nan("")}};
  trial.closings = {0.4, std::nan("")};
  record.trial_ids = {"0123456789abcdef"};
  record.trials = {trial};
  return record;
}

TEST(EvaluationLine, IsReadAsItWasWritten) {
  for (const LearningStage stage :
       {LearningStage::kSearch, LearningStage::kFinalist, LearningStage::kCheckAfter}) {
    EvaluationRecord record = MakeRecord(7);
    record.stage = stage;
    const std::string line = EvaluationRecord::Format(record);
    const EvaluationRecord read = EvaluationRecord::Parse(line);
    EXPECT_EQ(EvaluationRecord::Format(read), line);
    EXPECT_EQ(read.stage, stage);
    EXPECT_EQ(read.trial_ids, record.trial_ids);
  }
  const EvaluationRecord read = EvaluationRecord::Parse(EvaluationRecord::Format(MakeRecord(7)));
  EXPECT_EQ(read.individual.genome, MakeRecord(7).individual.genome);
  EXPECT_EQ(read.individual.parents, MakeRecord(7).individual.parents);
  EXPECT_EQ(read.individual.fitness, 1.0 + 0.1 * 7);
}

TEST(EvaluationLine, DamageIsTold) {
  std::string line = EvaluationRecord::Format(MakeRecord(7));
  EXPECT_THROW(EvaluationRecord::Parse(line.substr(0, line.size() - 3)), Error);
  line[20] ^= 1;
  try {
    EvaluationRecord::Parse(line);
    FAIL();
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "its bytes do not match their checksum");
  }
}

class EvaluationJournalTest : public testing::Test {
 protected:
  std::filesystem::path path() const { return folder_.path() / "journal.jsonl"; }

  /** Writes what is missing of the records 0 to 9 as a resumed run does, and returns the file. */
  std::string Finish() {
    EvaluationJournal journal(path());
    for (int number = 0; number < 10; ++number) {
      if (const EvaluationRecord* stored = journal.Find(number)) {
        EXPECT_EQ(stored->individual.number, number);
      } else {
        journal.Append({MakeRecord(number)});
      }
    }
    return ReadFile(path());
  }

  std::vector<EvaluationRecord> Load() {
    return LoadAnswers<EvaluationRecord>(path(), findings_, damage_);
  }

  TemporaryFolder folder_;
  Diagnostics findings_;
  std::vector<Damage> damage_;
};

TEST_F(EvaluationJournalTest, IsContinuedWithTheSameBytesFromWhereverItWasCut) {
  const std::string whole = Finish();
  EXPECT_EQ(Finish(), whole);
  for (size_t length = 0; length < whole.size(); length += 97) {
    WriteFileAtomically(path(), whole.substr(0, length));
    ASSERT_EQ(Finish(), whole) << length;
  }
}

TEST_F(EvaluationJournalTest, ADamagedLineCostsItselfOnly) {
  const std::string whole = Finish();
  std::string damaged = whole;
  damaged[damaged.find('\n') + 30] ^= 1;  // in the second line
  WriteFileAtomically(path(), damaged);
  EXPECT_EQ(Load().size(), 9u);
  EXPECT_EQ(findings_.Format(),
            "journal.jsonl:2: warning: skipped: its bytes do not match their checksum; it counts "
            "as not there");
  EXPECT_EQ(FindAnswer(Load(), 1), nullptr);
  // The missing answer is given again, behind the others, which are all still there.
  const std::string continued = Finish();
  EXPECT_EQ(continued, damaged + EvaluationRecord::Format(MakeRecord(1)) + "\n");
  const auto records = Load();
  ASSERT_EQ(records.size(), 10u);
  for (int number = 0; number < 10; ++number) {
    EXPECT_EQ(records[static_cast<size_t>(number)].individual.number, number);
  }
}

TEST_F(EvaluationJournalTest, InOlderJournalsTheLinesPlaceIsTheNumber) {
  std::string text;
  for (int number = 0; number < 3; ++number) {
    Json json = Json::parse(EvaluationRecord::Format(MakeRecord(number)));
    json.erase("request");
    json.erase("xxh64");
    text += number == 1 ? "damaged\n" : FormatCheckedLine(json) + "\n";
  }
  WriteFileAtomically(path(), text);
  const auto records = Load();
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(FindAnswer(records, 2)->individual.number, 2);
  EXPECT_EQ(FindAnswer(records, 1), nullptr);
}

TEST_F(EvaluationJournalTest, HasOneWriter) {
  const EvaluationJournal first(path());
  try {
    const EvaluationJournal second(path());
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("is being written by another process"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace graspbench
