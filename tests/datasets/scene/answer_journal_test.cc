#include "datasets/scene/answer_journal.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"
#include "datasets/scene/development_store.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

class AnswerJournalTest : public testing::Test {
 protected:
  /** A search of three questions, two of which are asked together. */
  std::vector<std::string> Ask(const std::vector<std::string>& ids) {
    DevelopmentJournal journal(path());
    std::vector<std::string> simulated;
    const auto ask = [&](const std::vector<std::string>& asked) {
      std::vector<DevelopmentRecord> questions;
      for (const std::string& id : asked) questions.push_back({0, "search", id, {}});
      const auto recall = [&](size_t i, const DevelopmentRecord& stored) {
        if (stored.id != asked[i]) throw Error(ErrorKind::kUsage, "another question");
      };
      const auto simulate = [&](std::vector<DevelopmentRecord>& records,
                                const std::vector<size_t>& left) {
        for (const size_t i : left) {
          simulated.push_back(records[i].id);
          records[i].trials = {{Outcome::kSuccess, static_cast<double>(records[i].id.size())}};
        }
      };
      for (const auto& trials : journal.Answer(questions, recall, simulate)) {
        scores_.push_back(trials.at(0).score);
      }
    };
    ask({ids[0]});
    ask({ids[1], ids[2]});
    return simulated;
  }
  std::filesystem::path path() const { return folder_.path() / "journal.jsonl"; }

  TemporaryFolder folder_;
  std::vector<double> scores_;
};

TEST_F(AnswerJournalTest, SimulatesOnlyWhatIsNotAnswered) {
  const std::vector<std::string> ids = {"a", "bb", "ccc"};
  EXPECT_EQ(Ask(ids), ids);
  const std::string whole = ReadFile(path());
  EXPECT_TRUE(Ask(ids).empty());
  EXPECT_EQ(ReadFile(path()), whole);
  const size_t second = whole.find('\n') + 1;
  WriteFile(path(), whole.substr(0, second + 9));  // torn in the second answer
  EXPECT_EQ(Ask(ids), (std::vector<std::string>{"bb", "ccc"}));
  EXPECT_EQ(ReadFile(path()), whole);
  EXPECT_EQ(scores_, (std::vector<double>{1, 2, 3, 1, 2, 3, 1, 2, 3}));
}

TEST_F(AnswerJournalTest, AnAnswerToAnotherQuestionIsNotTaken) {
  Ask({"a", "bb", "ccc"});
  EXPECT_THROW(Ask({"a", "bb", "other"}), Error);
}

TEST_F(AnswerJournalTest, OfSeveralAnswersTheFirstCounts) {
  Ask({"a", "bb", "ccc"});
  DevelopmentRecord other{1, "search", "bb", {{Outcome::kSuccess, 7.0}}};
  WriteFile(path(), ReadFile(path()) + DevelopmentRecord::Format(other) + "\n");
  EXPECT_EQ(DevelopmentJournal(path()).Find(1)->trials[0].score, 2.0);
}

TEST_F(AnswerJournalTest, ALineThatIsNoAnswerIsRefused) {
  Ask({"a", "bb", "ccc"});
  WriteFile(path(), ReadFile(path()) + FormatCheckedLine({{"shard", "1of2"}}) + "\n");
  EXPECT_THROW(DevelopmentJournal journal(path()), Error);
}

// Each line says in which journal it was written; other journals do not take it.
TEST_F(AnswerJournalTest, BelongsToItsStore) {
  CreateDevelopment(folder_.path(), {});
  Ask({"a", "bb", "ccc"});
  SealStore(kDevelopmentStore, folder_.path());
  EXPECT_TRUE(CheckStore(folder_.path()).damages.empty());
  const TemporaryFolder other;
  DevelopmentConfig config;
  config.hand = "another";
  CreateDevelopment(other.path(), config);
  const std::string lines = ReadFile(path());
  WriteFile(other.path() / "journal.jsonl", lines.substr(0, lines.find('\n') + 1));
  const std::vector<Damage> damages = CheckStore(other.path()).damages;
  ASSERT_EQ(damages.size(), 1u);
  EXPECT_EQ(damages[0].text, "it is a line of another search");
  // An older line, without a name, may only stand before those with one.
  const std::string older = DevelopmentRecord::Format({3, "search", "d", {}}) + "\n";
  WriteFile(path(), lines + older);
  EXPECT_EQ(CheckStore(folder_.path()).damages.size(), 1u);
  WriteFile(path(), older + lines);
  for (const Damage& damage : CheckStore(folder_.path()).damages) {
    EXPECT_NE(damage.text, "it is a line of another search");
  }
}

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

TEST_F(EvaluationJournalTest, ADamagedLineCostsItselfOnly) {
  const std::string whole = Finish();
  std::string damaged = whole;
  damaged[damaged.find('\n') + 30] ^= 1;  // in the second line
  WriteFileAtomically(path(), damaged);
  EXPECT_EQ(Load().size(), 9u);
  EXPECT_EQ(
      findings_.Format(),
      "journal.jsonl:2: warning: skipped: its bytes do not match their checksum; it is ignored");
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

TEST_F(EvaluationJournalTest, IsContinuedWithTheSameBytesFromWhereverItWasCut) {
  const std::string whole = Finish();
  EXPECT_EQ(Finish(), whole);
  for (size_t length = 0; length < whole.size(); length += 97) {
    WriteFileAtomically(path(), whole.substr(0, length));
    ASSERT_EQ(Finish(), whole) << length;
  }
}

TEST_F(EvaluationJournalTest, HasOneWriter) {
  const EvaluationJournal first(path());
  EXPECT_TRUE(Has(FindError([&] { const EvaluationJournal second(path()); }),
                  "is being written by another process"));
}

}  // namespace

}  // namespace graspbench
