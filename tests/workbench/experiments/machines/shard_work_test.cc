#include "workbench/experiments/machines/shard_work.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TEST(TimeBudget, StopsWhenTheTimeIsOverOrSomebodyAsks) {
  Observer observer;
  std::atomic<bool> stop{false};
  TimeBudget none(1e-9, observer, stop), enough(3600.0, observer, stop);
  BatchStatus status;
  none.ShowStatus(status, 9);
  EXPECT_FALSE(none.stop());  // nothing is finished
  status.num_done = 7;
  none.ShowStatus(status, 9);
  enough.ShowStatus(status, 9);
  EXPECT_TRUE(none.stop());
  EXPECT_FALSE(enough.stop());
  stop = true;
  enough.ShowStatus(status, 9);
  EXPECT_TRUE(enough.stop());
  EXPECT_EQ(enough.num_done(), 7);
  enough.BeginStage({});
  EXPECT_EQ(enough.num_done(), 0);
}

TEST(ShardPresence, SaysWhatIsLeftWhenItEnds) {
  const TemporaryFolder folder;
  const std::vector<PlannedTrial> plan = CreateFakeSession(folder.path(), 2);
  Observer observer;
  const std::atomic<bool> stop{false};
  TimeBudget budget(3600.0, observer, stop);
  const auto is_at_rest = [&] {
    Diagnostics findings;
    return LoadWorkers(folder.path(), findings).at_rest.count("1of2") > 0;
  };
  int num_left = 9;
  {
    ShardPresence presence(folder.path(), "1of2", num_left);
    EXPECT_EQ(presence.ListMissingSentinels(plan).size(), 3u);
    EXPECT_TRUE(presence.Begin({}, {}, {}, budget, kTrialTimeLimit));
    EXPECT_FALSE(is_at_rest());
    EXPECT_THROW(ShardPresence(folder.path(), "1of2", num_left), Error);
    num_left = 5;
  }
  EXPECT_TRUE(is_at_rest());
  const std::string text = ReadFile(folder.path() / "workers" / "1of2-0.jsonl");
  EXPECT_NE(text.find("\"left\":5"), std::string::npos) << text;
}

}  // namespace
}  // namespace graspbench
