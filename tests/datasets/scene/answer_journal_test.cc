#include "datasets/scene/answer_journal.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/scene/development_store.h"
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

}  // namespace
}  // namespace graspbench
