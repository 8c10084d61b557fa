#include "datasets/session/explanation_store.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

Explanation MakeExplanation(bool is_on_edge, int num_draws = kNumFreshDraws) {
  Explanation explanation;
  explanation.is_on_edge = is_on_edge;
  explanation.held.assign(static_cast<size_t>(num_draws), 0);
  explanation.remedies = {{"grip-x2", true, num_draws, 3, 1}};
  return explanation;
}

/** Every trial of it failed. */
class ExplanationStore : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"session", "other"}) {
      plan_ = CreateFakeSession(temporary_.path() / name, 3);
      JournalWriter journal(temporary_.path() / name, 0);
      for (const PlannedTrial& planned : plan_) {
        TrialRecord record = MakeFakeRecord(planned);
        record.result.outcome = Outcome::kSlippedInLiftOff;
        record.result.diagnosis = Diagnosis();
        record.result.policy.reset();
        journal.Append(record);
      }
    }
  }
  std::filesystem::path folder() const { return temporary_.path() / "session"; }

  TemporaryFolder temporary_;
  std::vector<PlannedTrial> plan_;
};

TEST_F(ExplanationStore, OneFailureOfEachConditionIsAskedForOrAll) {
  const size_t num_conditions = plan_.size() / 3;
  const auto list = [&](ExplainScope scope) {
    return FindUnexplained(LoadSession(folder()), scope);
  };
  ASSERT_EQ(list(ExplainScope::kOneOfEach).size(), num_conditions);
  EXPECT_EQ(list(ExplainScope::kAll).size(), plan_.size());
  for (const PlannedTrial& planned : list(ExplainScope::kOneOfEach)) EXPECT_EQ(planned.trial, 0);
  ExplanationWriter(folder(), 0).Append(plan_[1].id, MakeExplanation(false));
  EXPECT_EQ(list(ExplainScope::kOneOfEach).size(), num_conditions - 1);
  EXPECT_EQ(list(ExplainScope::kAll).size(), plan_.size() - 1);
}

TEST_F(ExplanationStore, AFullExplanationTakesThePlaceOfAShortOne) {
  const auto count = [&](ExplainScope scope) {
    return FindUnexplained(LoadSession(folder()), scope).size();
  };
  const size_t num_conditions = plan_.size() / 3;
  ASSERT_EQ(count(ExplainScope::kShortly), num_conditions);
  ExplanationWriter(folder(), 0).Append(plan_[0].id, MakeExplanation(true, kNumFirstDraws));
  EXPECT_EQ(count(ExplainScope::kShortly), num_conditions - 1);
  EXPECT_EQ(count(ExplainScope::kOneOfEach), num_conditions);
  ExplanationWriter(folder(), 1).Append(plan_[0].id, MakeExplanation(false));
  EXPECT_EQ(count(ExplainScope::kOneOfEach), num_conditions - 1);
  EXPECT_FALSE(LoadExplanations(folder()).at(plan_[0].id).is_short());
  const std::filesystem::path other = temporary_.path() / "other";
  ExplanationWriter(other, 0).Append(plan_[0].id, MakeExplanation(true, kNumFirstDraws));
  MergeExplanations(other, folder());
  EXPECT_FALSE(LoadExplanations(other).at(plan_[0].id).is_short());
}

TEST_F(ExplanationStore, WhatIsWrittenIsReadAndTheRecordsStay) {
  const Json before = ToJson(LoadSession(folder()).records.front().result);
  ExplanationWriter(folder(), 0).Append(plan_[0].id, MakeExplanation(true));
  ExplanationWriter(folder(), 1).Append(plan_[0].id, MakeExplanation(true));
  const Explanations known = LoadExplanations(folder());
  ASSERT_EQ(known.size(), 1u);
  EXPECT_EQ(RecordToJson(known.at(plan_[0].id)), RecordToJson(MakeExplanation(true)));
  EXPECT_EQ(ToJson(LoadSession(folder()).records.front().result), before);
}

TEST_F(ExplanationStore, UnequalDuplicatesAreAnError) {
  ExplanationWriter(folder(), 0).Append(plan_[0].id, MakeExplanation(true));
  ExplanationWriter(folder(), 1).Append(plan_[0].id, MakeExplanation(false));
  const std::string message = FindError([&] { LoadExplanations(folder()); });
  EXPECT_NE(message.find(plan_[0].id + " has two different explanations"), std::string::npos)
      << message;
}

TEST_F(ExplanationStore, AMergeBringsWhatIsMissing) {
  const std::filesystem::path other = temporary_.path() / "other";
  ExplanationWriter(folder(), 0).Append(plan_[0].id, MakeExplanation(true));
  ExplanationWriter(other, 0).Append(plan_[0].id, MakeExplanation(true));
  ExplanationWriter(other, 0).Append(plan_[1].id, MakeExplanation(false));
  MergeExplanations(folder(), other);
  MergeExplanations(folder(), other);
  EXPECT_EQ(LoadExplanations(folder()).size(), 2u);
}

}  // namespace
}  // namespace graspbench
