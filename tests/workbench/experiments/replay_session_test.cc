#include "workbench/experiments/replay_session.h"

#include <gtest/gtest.h>

#include <memory>
#include <mutex>
#include <set>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/experiments/run_record.h"
#include "workbench/experiments/run_session.h"

namespace graspbench {
namespace {

/** A session of three trials that was run once for all tests; each test has a copy. */
class ReplaySessionTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    original_ = std::make_unique<TemporaryFolder>();
    SessionRequest request;
    request.config = SessionConfig();
    request.config->hands = {"tum"};
    request.config->objects = {"golf_ball"};
    request.config->trials = 3;
    request.out = original_->path() / "s";
    Observer observer;
    RunRound(kTrialRound, PrepareSession(request), 1, observer);
  }
  static void TearDownTestSuite() { original_.reset(); }
  ReplaySessionTest() {
    std::filesystem::copy(original_->path() / "s", folder_,
                          std::filesystem::copy_options::recursive);
  }

  SessionReplay Replay(const Session& session, int num_workers = 2) {
    inputs_ = LoadSessionInputs(session.config, FieldUse::kLater, session.folder);
    ReplayRequest request;
    request.trials = session.plan;
    request.num_workers = num_workers;
    request.take = take_;
    return ReplaySession(session, inputs_, request, observer_);
  }

  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "s";
  std::filesystem::path journal_ = folder_ / "journal" / "0.jsonl";
  SessionInputs inputs_;
  std::atomic<bool> stop_ = false;
  Observer observer_{stop_};
  std::function<void(size_t, const TrialSetup&, const TracedTrial&)> take_;
  static std::unique_ptr<TemporaryFolder> original_;
};
std::unique_ptr<TemporaryFolder> ReplaySessionTest::original_;

TEST_F(ReplaySessionTest, TheSameProgramGivesTheSameRecords) {
  for (const RecordParts parts : {RecordParts::kWhole, RecordParts::kBrief}) {
    const Session session = LoadSession(folder_, OnDamage::kRefuse, parts);
    const SessionReplay replay = Replay(session);
    ASSERT_EQ(replay.trials.size(), 3u);
    EXPECT_EQ(replay.CountDifferent(), 0);
    EXPECT_EQ(replay.CountMissing(), 0);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(replay.trials[i].planned.id, session.plan[i].id);
      EXPECT_EQ(replay.trials[i].outcome, session.records[i].result.outcome);
    }
  }
}

// Whoever changes a record and everything that vouches for it is found by the trial itself.
TEST_F(ReplaySessionTest, NamesTheFieldOfARecordThatWasRewritten) {
  Session session = LoadSession(folder_);
  const double height = session.records[1].result.lift_height;
  session.records[1].result.lift_height = height + 1e-9;
  std::string lines;
  for (const TrialRecord& record : session.records) lines += FormatJournalLine(record) + "\n";
  WriteFileAtomically(journal_, lines);
  SealStore(kSessionStore, folder_);
  const SessionReplay replay = Replay(LoadSession(folder_));
  EXPECT_EQ(replay.CountDifferent(), 1);
  ASSERT_TRUE(replay.trials[1].difference);
  EXPECT_FALSE(replay.trials[1].is_damaged);
  EXPECT_EQ(replay.trials[1].difference->field, "lift_height_m");
  EXPECT_EQ(replay.trials[1].difference->recorded, FormatJson(height + 1e-9));
  EXPECT_EQ(replay.trials[1].difference->now, FormatJson(height));
}

TEST_F(ReplaySessionTest, NamesTheFieldOfAFlippedDigit) {
  std::string lines = ReadFile(journal_);
  const size_t second = lines.find('\n') + 1;
  const std::string key = "\"num_steps\":";
  const size_t digit = lines.find(key, second) + key.size();
  ASSERT_LT(digit, lines.find('\n', second));
  lines[digit] = lines[digit] == '9' ? '8' : '9';
  WriteFileAtomically(journal_, lines);
  EXPECT_THROW(LoadSession(folder_), Error) << "the door comes first";
  const Session session = LoadSession(folder_, OnDamage::kAccept, RecordParts::kBrief);
  const SessionReplay replay = Replay(session);
  EXPECT_EQ(replay.CountDifferent(), 1);
  EXPECT_EQ(replay.CountMissing(), 0);
  ASSERT_TRUE(replay.trials[1].difference);
  EXPECT_TRUE(replay.trials[1].is_damaged);
  EXPECT_EQ(replay.trials[1].difference->field, "num_steps");
}

// What is not legible any more has no field to name; its trial counts as one without a record.
TEST_F(ReplaySessionTest, ALineThatIsNoRecordAnyMoreIsMissing) {
  std::string lines = ReadFile(journal_);
  lines[lines.find("\"result\"")] = '#';
  WriteFileAtomically(journal_, lines);
  const SessionReplay replay = Replay(LoadSession(folder_, OnDamage::kAccept));
  EXPECT_EQ(replay.CountMissing(), 1);
  EXPECT_FALSE(replay.trials[0].is_recorded);
  EXPECT_EQ(replay.CountDifferent(), 0);
}

TEST_F(ReplaySessionTest, GivesEveryStepToWhoeverAsks) {
  const Session session = LoadSession(folder_);
  std::mutex mutex;
  std::set<size_t> taken;
  take_ = [&](size_t trial, const TrialSetup& setup, const TracedTrial& traced) {
    const std::lock_guard lock(mutex);
    taken.insert(trial);
    EXPECT_EQ(setup.hand->id, "tum");
    EXPECT_EQ(static_cast<int>(traced.trace.size()), session.records[trial].result.num_steps + 1);
  };
  EXPECT_EQ(Replay(session).CountDifferent(), 0);
  EXPECT_EQ(taken, (std::set<size_t>{0, 1, 2}));
}

TEST_F(ReplaySessionTest, SaysWhatMayBeTheReason) {
  Session session = LoadSession(folder_);
  Replay(session);
  ReplayConditions conditions = FindReplayConditions(session, inputs_);
  EXPECT_FALSE(conditions.is_other_physics());
  EXPECT_FALSE(conditions.is_other_build());
  EXPECT_EQ(conditions.recorded_builds, std::vector<std::string>{FindBuild()});
  EXPECT_EQ(conditions.num_changed, 0);
  session.physics_version -= 1;
  EXPECT_TRUE(FindReplayConditions(session, inputs_).is_other_physics());
  WriteFileAtomically(folder_ / "run.json", R"({"runs":[{"build":"0123456789abcdef"}]})");
  EXPECT_TRUE(FindReplayConditions(session, inputs_).is_other_build());
  auto changed = std::make_shared<GraspObject>(*inputs_.objects[0]);
  changed->content_hash = "of another object";
  inputs_.objects[0] = changed;
  EXPECT_EQ(FindReplayConditions(session, inputs_).num_changed, 3);
}

TEST_F(ReplaySessionTest, StopsWhenAsked) {
  const Session session = LoadSession(folder_);
  stop_ = true;
  EXPECT_THROW(Replay(session), Error);
}

}  // namespace
}  // namespace graspbench
