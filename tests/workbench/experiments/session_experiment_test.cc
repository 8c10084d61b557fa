#include "workbench/experiments/session_experiment.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/analysis/conditions/delay_summary.h"
#include "datasets/analysis/conditions/numerics_summary.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "datasets/analysis/export_result.h"
#include "datasets/plan/conditions.h"
#include "datasets/session/merge_sessions.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/experiments/machines/run_shard.h"

namespace graspbench {
namespace {

class SessionExperiment : public testing::Test {
 protected:
  void SetUp() override {
    config_.hands = {"tum"};
    config_.objects = {"golf_ball", "tea_light"};
    config_.trials = 2;
  }
  PreparedSession Prepare(const std::string& name) {
    SessionRequest request;
    request.config = config_;
    request.out = temporary_.path() / name;
    request.resume = HasSession(request.out);
    return PrepareSession(request);
  }
  static std::string ReadTables(const std::filesystem::path& folder) {
    ExportResult(folder, LoadSession(folder));
    return ReadFile(folder / "export" / "trials.csv") +
           ReadFile(folder / "export" / "effects.csv") +
           ReadFile(folder / "export" / "conditions.csv") + ReadFile(folder / "index.sqlite");
  }

  TemporaryFolder temporary_;
  SessionConfig config_;
  Observer observer_;
  std::atomic<bool> stop_ = false;
};

// Shards in folders of their own, worked on and merged in another order, are one run.
TEST_F(SessionExperiment, ShardsOfASweepAreOneRun) {
  config_.conditions = {{"heavy", {"model.mass_scale=2.0"}},
                        {"late", {"delay.last=0.1"}},
                        {"heavy and late", {"model.mass_scale=2.0", "delay.last=0.1"}}};
  const PreparedSession whole = Prepare("whole");
  EXPECT_EQ(whole.session.plan.size(), 16u);
  ASSERT_EQ(RunRound(kTrialRound, whole, 2, observer_, stop_).ending, RunEnding::kFinished);
  const std::filesystem::path folder = Prepare("planned").folder;
  std::vector<std::filesystem::path> others;
  for (const int number : {5, 2, 7, 1, 3, 6, 4}) {
    others.push_back(temporary_.path() / ("machine" + std::to_string(number)));
    std::filesystem::copy(folder, others.back(), std::filesystem::copy_options::recursive);
    ShardRequest request;
    request.folder = others.back();
    request.shard = {number, 7};
    EXPECT_EQ(WorkOnShard(request, observer_, stop_).num_left, 0);
  }
  EXPECT_EQ(MergeSessions(folder, others), 16);
  EXPECT_EQ(ReadTables(folder), ReadTables(whole.folder));
}

TEST_F(SessionExperiment, TakesWhatTheSessionKnowsAndStandsWithinIt) {
  const PreparedSession session = Prepare("session");
  RunRound(kTrialRound, session, 2, observer_, stop_);
  ExperimentRequest request;
  request.folder = session.folder;
  const std::vector<Condition> conditions = {{"heavy", {"model.mass_scale=2.0"}}};
  const PreparedSession experiment =
      PrepareExperiment(request, "sensitivity", [&](const SessionConfig&) { return conditions; });
  EXPECT_EQ(experiment.session.plan.size(), 8u);
  EXPECT_EQ(experiment.session.records.size(), 4u) << "the base is the session's";
  EXPECT_TRUE(RunExperiment(experiment, request, 1, observer_, stop_));
  const Session found = LoadSession(experiment.folder);
  EXPECT_EQ(found.records.size(), 8u);
  // The door of the session is the experiment's, too.
  std::string journal = ReadFile(experiment.folder / "journal" / "0.jsonl");
  journal[journal.size() / 2] ^= 1;
  WriteFile(experiment.folder / "journal" / "0.jsonl", journal);
  EXPECT_THROW(LoadSession(session.folder), Error);
  EXPECT_FALSE(CheckStore(session.folder).damages.empty());
}

// Under less friction the golf ball would be grasped otherwise; no pair may vanish for it.
TEST_F(SessionExperiment, EveryConditionHasTheDrawsOfTheBase) {
  config_.objects = {"golf_ball", "pencil"};
  SessionConfig slippery = config_;
  slippery.model.friction_scale = 0.7;
  const auto list_draws = [](const std::vector<PlannedTrial>& plan, const auto& condition) {
    std::set<std::string> draws;
    for (const PlannedTrial& planned : plan) {
      if (planned.condition == condition) draws.insert(NameDraw(planned));
    }
    return draws;
  };
  const auto make_plan = [](const SessionConfig& config) {
    return MakePlan(config, LoadSessionInputs(config, FieldUse::kLater));
  };
  const std::optional<std::string> base;
  EXPECT_NE(list_draws(make_plan(slippery), base), list_draws(make_plan(config_), base));
  const SessionConfig plain = config_;
  for (const auto& conditions :
       {ListDelayConditions(plain), ListNumericsVariants(plain),
        std::vector<Condition>{{"slippery", {"model.friction_scale=0.7"}}}}) {
    config_.conditions = conditions;
    const std::vector<PlannedTrial> plan = make_plan(config_);
    for (const Condition& condition : conditions) {
      if (condition.name == "compliant") continue;  // cannot move all of them
      EXPECT_EQ(list_draws(plan, condition.name), list_draws(plan, base)) << condition.name;
    }
  }
}

// As a level of a factor, too, best is what the base chooses.
TEST_F(SessionExperiment, BestAsALevelIsTheBasesBest) {
  config_.objects = {"pencil"};
  config_.trials = 1;
  const std::string best = Prepare("best").session.plan.at(0).grasp;
  config_.grasps = {"g3"};
  config_.conditions = {{"best", {"grasp=best"}},
                        {"slippery", {"model.friction_scale=0.7"}},
                        {"both", {"grasp=best", "model.friction_scale=0.7"}}};
  std::vector<std::string> grasps;
  for (const PlannedTrial& planned : Prepare("sweep").session.plan) grasps.push_back(planned.grasp);
  EXPECT_EQ(grasps, (std::vector<std::string>{"g3", best, "g3", best}));
}

// Where the grasp is the setting, each draw is compared with itself under another grasp.
TEST_F(SessionExperiment, AGraspAsTheSettingIsComparedDrawByDraw) {
  config_.objects = {"golf_ball"};
  config_.grasps = {"g1"};
  const PreparedSession prepared = Prepare("session");
  RunRound(kTrialRound, prepared, 1, observer_, stop_);
  const Session session = LoadSession(prepared.folder, OnDamage::kRefuse, RecordParts::kBrief);
  ExperimentRequest request;
  request.folder = prepared.folder;
  const PreparedSession experiment =
      PrepareExperiment(request, "sensitivity", [](const SessionConfig&) {
        return std::vector<Condition>{{"grasp=g2", {"grasp=g2"}}};
      });
  EXPECT_TRUE(RunExperiment(experiment, request, 1, observer_, stop_));
  const SensitivityData data = LoadSensitivity(session);
  for (const TrialRecord& record : LoadSession(experiment.folder).records) {
    if (!record.plan.condition) continue;
    EXPECT_EQ(record.plan.grasp, "g2");
    const std::string& id = session.plan.at(static_cast<size_t>(record.plan.trial)).id;
    EXPECT_EQ(RecordToJson(data.at("grasp=g2").at(id)),
              RecordToJson(MakeTrialMeasures(record.result)));
  }
}

TEST_F(SessionExperiment, NeedsATrialAndNoConditions) {
  const auto explain = [&](const PreparedSession& prepared) {
    try {
      ExperimentRequest request;
      request.folder = prepared.folder;
      PrepareExperiment(request, "sensitivity", [](const SessionConfig&) {
        return std::vector<Condition>{{"x", {"model.mass_scale=2.0"}}};
      });
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(explain(Prepare("empty")).find("has no finished trial"), std::string::npos);
  config_.objects = {"golf_ball"};
  config_.trials = 1;
  config_.conditions = {{"heavy", {"model.mass_scale=2.0"}}};
  const PreparedSession sweep = Prepare("sweep");
  RunRound(kTrialRound, sweep, 1, observer_, stop_);
  EXPECT_NE(explain(sweep).find("has conditions of its own"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
