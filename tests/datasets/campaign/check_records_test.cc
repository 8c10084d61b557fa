#include "datasets/campaign/check_records.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "datasets/campaign/campaign_store.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

std::string Check(const fs::path& folder) {
  StoreState state = CheckStore(folder);
  EXPECT_TRUE(state.damages.empty()) << "each line is whole";
  CheckRecords(folder, state);
  return FormatDamage(state.damages);
}

/** A session with one record. */
std::vector<PlannedTrial> MakeSession(const fs::path& folder) {
  const std::vector<PlannedTrial> plan = CreateFakeSession(folder, 1);
  JournalWriter(folder, 0).Append(MakeFakeRecord(plan[0]));
  return plan;
}

void AppendForeign(const fs::path& folder, const PlannedTrial& planned) {
  TrialRecord record = MakeFakeRecord(planned);
  record.plan.object = "elephant";
  JournalWriter(folder, 7).Append(record);
}

TEST(CheckRecordsTest, NamesLinesOfAnotherSession) {
  const TemporaryFolder temporary;
  const fs::path session = temporary.path() / "session";
  const auto plan = MakeSession(session);
  EXPECT_EQ(Check(session), "");
  AppendForeign(session, plan[1]);
  EXPECT_EQ(Check(session), "\n  journal/7.jsonl:1: trial " + plan[1].id +
                                " is not in the plan: the line belongs to another session");
}

TEST(CheckRecordsTest, NamesContradictions) {
  const TemporaryFolder temporary;
  const fs::path session = temporary.path() / "session";
  const auto plan = MakeSession(session);
  TrialRecord other = MakeFakeRecord(plan[0]);
  other.result.grip_force += 1.0;
  JournalWriter(session, 1).Append(other);
  EXPECT_NE(Check(session).find("one trial has different results"), std::string::npos);
}

TEST(CheckRecordsTest, NamesAnExperimentOnAnotherSession) {
  const TemporaryFolder temporary;
  const fs::path session = temporary.path() / "session", below = session / "sensitivity" / "1";
  const auto plan = MakeSession(session);
  SessionConfig config = LoadSession(session).config;
  CreateSession(below, config, plan);
  EXPECT_EQ(Check(session), "");
  fs::remove_all(below);
  config.seed = 7;
  CreateSession(below, config, plan);
  EXPECT_TRUE(
      Has(Check(session), "\n  sensitivity/1: \"sensitivity/1\" is an experiment on another"));
}

// It has no seal: nothing rests on it.
TEST(CheckRecordsTest, SaysThatWhenItRanCannotBeRead) {
  const TemporaryFolder temporary;
  const fs::path session = temporary.path() / "session";
  MakeSession(session);
  for (const auto& [content, is_read] :
       {std::pair("{\"runs\": []}", true), {"[[[[[", false}, {"{\"runs\": 3}", false}}) {
    WriteFile(session / "run.json", content);
    StoreState state = CheckStore(session);
    const Diagnostics findings = CheckRecords(session, state);
    EXPECT_TRUE(state.damages.empty());
    EXPECT_EQ(findings.Format().find("run.json") == std::string::npos, is_read) << content;
  }
}

TEST(CheckRecordsTest, LooksIntoTheBenchmarkOfACampaign) {
  const TemporaryFolder temporary;
  const fs::path campaign = temporary.path() / "campaign";
  CreateCampaign(campaign, CampaignConfig());
  const auto plan = MakeSession(campaign / "benchmark");
  EXPECT_EQ(Check(campaign), "");
  AppendForeign(campaign / "benchmark", plan[1]);
  EXPECT_TRUE(Has(Check(campaign), "\n  benchmark/journal/7.jsonl:1: trial " + plan[1].id));
}

}  // namespace
}  // namespace graspbench
