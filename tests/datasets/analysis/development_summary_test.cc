#include "datasets/analysis/development_summary.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace graspbench {
namespace {
namespace fs = std::filesystem;

DevelopmentRecord MakeRecord(int request, const std::string& stage, int held, int lost) {
  DevelopmentRecord record;
  record.request = request;
  record.stage = stage;
  record.id = "0123456789abcdef";
  for (int i = 0; i < held + lost; ++i) {
    DevelopTrial& trial = record.trials.emplace_back();
    trial.outcome = i < held ? Outcome::kSuccess : Outcome::kNoContact;
    trial.score = i < held ? 1.0 : 0.0;
  }
  return record;
}

TEST(DevelopmentSummaryTest, CountsByGraspAndStage) {
  const fs::path path =
      fs::path(testing::TempDir()) / ("development_summary_" + std::to_string(::getpid()));
  fs::remove(path);
  {
    DevelopmentJournal journal(path);
    journal.Append({MakeRecord(0, "race", 1, 3), MakeRecord(1, "race", 3, 1),
                    MakeRecord(2, "search", 2, 0), MakeRecord(3, "check", 11, 1),
                    MakeRecord(4, "race", 0, 2)});
  }
  const auto grasps = SummariseDevelopment(DevelopmentJournal(path));
  fs::remove(path);
  ASSERT_EQ(grasps.size(), 2u);
  ASSERT_EQ(grasps[0].size(), 3u);
  EXPECT_EQ(grasps[0][0].name, "race");
  EXPECT_EQ(grasps[0][0].num_requests, 2);
  EXPECT_EQ(grasps[0][0].tally.finished, 8);
  EXPECT_EQ(grasps[0][0].tally.successes(), 4);
  EXPECT_EQ(grasps[0][0].best_score, 0.75);
  EXPECT_EQ(grasps[0][2].name, "check");
  EXPECT_EQ(grasps[0][2].tally.successes(), 11);
  ASSERT_EQ(grasps[1].size(), 1u);
  EXPECT_EQ(grasps[1][0].tally.CountOf(Outcome::kNoContact), 2);
}

}  // namespace
}  // namespace graspbench
