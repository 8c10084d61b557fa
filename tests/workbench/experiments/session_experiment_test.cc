#include "workbench/experiments/session_experiment.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/analysis/conditions/delay_summary.h"
#include "datasets/analysis/conditions/numerics_summary.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/export_result.h"
#include "datasets/analysis/session_comparison.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/map_design.h"
#include "datasets/session/merge_sessions.h"
#include "tests/workbench/experiments/small_sessions.h"
#include "workbench/experiments/machines/run_shard.h"

namespace graspbench {
namespace {

class SessionExperiment : public SmallSessions {
 protected:
  static std::string ReadTables(const std::filesystem::path& folder) {
    ExportResult(folder, LoadSession(folder));
    return ReadFile(folder / "export" / "trials.csv") +
           ReadFile(folder / "export" / "effects.csv") +
           ReadFile(folder / "export" / "conditions.csv") + ReadFile(folder / "index.sqlite");
  }
  PreparedSession PrepareSensitivity(const ExperimentRequest& request,
                                     const std::vector<std::string>& settings) const {
    return PrepareExperiment(request, "sensitivity", [&](const SessionConfig& config) {
      return ListSensitivityConditions(config, settings);
    });
  }
  bool RunSensitivity(const ExperimentRequest& request, const std::vector<std::string>& settings) {
    return RunExperiment(PrepareSensitivity(request, settings), request, observer_);
  }

  SessionConfig config_ = MakeConfig({"golf_ball", "tea_light"}, 2);
};

// Shards in folders of their own, worked on and merged in another order, are one run.
TEST_F(SessionExperiment, ShardsOfASweepAreOneRun) {
  config_.conditions = {{"heavy", {"model.mass_scale=2.0"}},
                        {"late", {"delay.last=0.1"}},
                        {"heavy and late", {"model.mass_scale=2.0", "delay.last=0.1"}}};
  const PreparedSession whole = Prepare("whole", config_);
  EXPECT_EQ(whole.session.plan.size(), 16u);
  ASSERT_EQ(RunRound(kTrialRound, whole, 2, observer_).ending, RunEnding::kFinished);
  const std::filesystem::path folder = Prepare("planned", config_).folder;
  std::vector<std::filesystem::path> others;
  for (const int number : {5, 2, 7, 1, 3, 6, 4}) {
    others.push_back(temporary_.path() / ("machine" + std::to_string(number)));
    std::filesystem::copy(folder, others.back(), std::filesystem::copy_options::recursive);
    ShardRequest request;
    request.folder = others.back();
    request.shard = {number, 7};
    EXPECT_EQ(WorkOnShard(request, observer_).num_left, 0);
  }
  EXPECT_EQ(MergeSessions(folder, others), 16);
  EXPECT_EQ(ReadTables(folder), ReadTables(whole.folder));
}

TEST_F(SessionExperiment, TakesWhatTheSessionKnowsAndStandsWithinIt) {
  const PreparedSession session = Prepare("session", config_);
  RunRound(kTrialRound, session, 2, observer_);
  ExperimentRequest request;
  request.folder = session.folder;
  const std::vector<Condition> conditions = {{"heavy", {"model.mass_scale=2.0"}}};
  const PreparedSession experiment =
      PrepareExperiment(request, "sensitivity", [&](const SessionConfig&) { return conditions; });
  EXPECT_EQ(experiment.session.plan.size(), 8u);
  EXPECT_EQ(experiment.session.records.size(), 4u) << "the base is the session's";
  EXPECT_TRUE(RunExperiment(experiment, request, observer_));
  const Session found = LoadSession(experiment.folder);
  EXPECT_EQ(found.records.size(), 8u);
  // The door of the session is the experiment's, too.
  std::string journal = ReadFile(experiment.folder / "journal" / "0.jsonl");
  journal[journal.size() / 2] ^= 1;
  WriteFile(experiment.folder / "journal" / "0.jsonl", journal);
  EXPECT_THROW(LoadSession(session.folder), Error);
  EXPECT_FALSE(CheckStore(session.folder).damages.empty());
}

// Under less friction these would be grasped otherwise; no pair may vanish for it.
TEST_F(SessionExperiment, EveryConditionHasTheDrawsOfTheBase) {
  config_.objects = {"light_bulb", "bunch_of_keys"};
  config_.grasps = {"predicted"};
  SessionConfig slippery = config_;
  slippery.model.friction_scale = 0.5;
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
  const std::string best = Prepare("best", config_).session.plan.at(0).grasp;
  config_.grasps = {"g3"};
  config_.conditions = {{"best", {"grasp=best"}},
                        {"slippery", {"model.friction_scale=0.7"}},
                        {"both", {"grasp=best", "model.friction_scale=0.7"}}};
  std::vector<std::string> grasps;
  for (const PlannedTrial& planned : Prepare("sweep", config_).session.plan)
    grasps.push_back(planned.grasp);
  EXPECT_EQ(grasps, (std::vector<std::string>{"g3", best, "g3", best}));
}

// Where the grasp is the setting, each draw is compared with itself under another grasp.
TEST_F(SessionExperiment, AGraspAsTheSettingIsComparedDrawByDraw) {
  config_.objects = {"golf_ball"};
  config_.grasps = {"g1"};
  const PreparedSession prepared = Prepare("session", config_);
  RunRound(kTrialRound, prepared, 1, observer_);
  const Session session = LoadSession(prepared.folder, OnDamage::kRefuse, RecordParts::kBrief);
  ExperimentRequest request;
  request.folder = prepared.folder;
  const PreparedSession experiment =
      PrepareExperiment(request, "sensitivity", [](const SessionConfig&) {
        return std::vector<Condition>{{"grasp=g2", {"grasp=g2"}}};
      });
  EXPECT_TRUE(RunExperiment(experiment, request, observer_));
  const SensitivityData data = LoadSensitivity(session);
  for (const TrialRecord& record : LoadSession(experiment.folder).records) {
    if (!record.plan.condition) continue;
    EXPECT_EQ(record.plan.grasp, "g2");
    const std::string& id = session.plan.at(static_cast<size_t>(record.plan.trial)).id;
    EXPECT_EQ(RecordToJson(data.at("grasp=g2").at(id)), RecordToJson(MakeTrialMeasures(record)));
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
  EXPECT_NE(explain(Prepare("empty", config_)).find("has no finished trial"), std::string::npos);
  config_.objects = {"golf_ball"};
  config_.trials = 1;
  config_.conditions = {{"heavy", {"model.mass_scale=2.0"}}};
  const PreparedSession sweep = Prepare("sweep", config_);
  RunRound(kTrialRound, sweep, 1, observer_);
  EXPECT_NE(explain(sweep).find("already has conditions"), std::string::npos);
}

// Without a delay it is the session's trial; with one the digit comes later.
TEST_F(SessionExperiment, ADelayedDigitTouchesLater) {
  SessionConfig config = MakeConfig({"golf_ball"}, 2);
  config.grasps = {"g2"};
  ExperimentRequest request = RunNew("session", config);
  request.trials_per_cell = 1;
  const Session session = LoadSession(request.folder);
  const PreparedSession experiment = PrepareExperiment(request, "delays", ListDelayConditions);
  ASSERT_TRUE(RunExperiment(experiment, request, observer_));
  const std::vector<DelayedTrial> trials = ListDelayedTrials(LoadSession(experiment.folder));
  ASSERT_EQ(trials.size(), 4 * 2 * ListDelays().size());
  const double gft = session.records[0].result.timing.gft;
  int num_undelayed = 0;
  for (const DelayedTrial& trial : trials) {
    EXPECT_EQ(trial.record.plan.trial, 0);
    if (trial.condition == "as run" && trial.delay == 0.0) {
      EXPECT_EQ(ToJson(trial.record.result), ToJson(session.records[0].result));
      ++num_undelayed;
    }
    // The last digit comes later still, by the delay or nearly: the others push the object to it.
    if (trial.condition == "as run" && trial.digit == "last" && trial.delay == 0.1) {
      EXPECT_GT(trial.record.result.timing.gft, gft + 0.03);
      EXPECT_LT(trial.record.result.timing.gft, gft + 0.12);
    }
  }
  EXPECT_EQ(num_undelayed, 2);  // one for each digit that may be late
}

// What a session of this setting finds from the start is what the same trials find here.
TEST_F(SessionExperiment, ASettingFindsWhatASessionOfItFinds) {
  const SessionConfig plain = MakeConfig({"golf_ball"}, 2);
  const ExperimentRequest request = RunNew("plain", plain);
  const Session session = LoadSession(request.folder);
  const std::vector<std::string> settings = {"model.mass_scale=3.0", "variation.offset_m=0.01",
                                             "model.mass_scale=1.0"};
  ASSERT_TRUE(RunSensitivity(request, settings));
  const SensitivityData data = LoadSensitivity(session);
  ASSERT_EQ(data.size(), settings.size());
  for (const std::string& setting : settings) {
    SessionConfig changed = plain;
    ApplySetting(setting, changed);
    const Session other = LoadSession(RunNew("with " + setting, changed).folder);
    for (size_t i = 0; i < other.records.size(); ++i) {
      EXPECT_EQ(RecordToJson(data.at(setting).at(session.records[i].plan.id)),
                RecordToJson(MakeTrialMeasures(other.records[i])))
          << setting;
    }
  }
  for (const TrialRecord& record : session.records) {
    const Json measures = RecordToJson(MakeTrialMeasures(record));
    EXPECT_EQ(RecordToJson(data.at("model.mass_scale=1.0").at(record.plan.id)), measures);
    EXPECT_NE(RecordToJson(data.at("variation.offset_m=0.01").at(record.plan.id)), measures);
  }
}

TEST_F(SessionExperiment, RefusesSettingsNamedTwiceOrWithoutUseBeforeAnythingRuns) {
  SessionConfig config = MakeConfig({"golf_ball"}, 1);
  ApplySetting("strategy.grip=force", config);
  const ExperimentRequest request = RunNew("gentle", config);
  EXPECT_THROW(PrepareSensitivity(request, {"strategy.grip_margin=3"}), Error);
  EXPECT_THROW(PrepareSensitivity(request, {"model.mass_scale=2", "model.mass_scale=2.0"}), Error);
  EXPECT_TRUE(LoadSensitivity(LoadSession(request.folder)).empty());
}

TEST_F(SessionExperiment, GoesOnWhereItStopped) {
  ExperimentRequest request = RunNew("plain", MakeConfig({"golf_ball"}, 2));
  const Session session = LoadSession(request.folder);
  const std::vector<std::string> settings = {"model.mass_scale=3", "model.mass_scale=2"};
  request.num_workers = 1;
  request.trials_per_cell = 1;
  stop_ = true;
  EXPECT_FALSE(RunSensitivity(request, settings));
  stop_ = false;
  ASSERT_TRUE(RunSensitivity(request, settings));
  EXPECT_EQ(LoadSensitivity(session).at("model.mass_scale=2.0").size(), 1u);
  request.trials_per_cell = 0;
  ASSERT_TRUE(RunSensitivity(request, settings));
  const SensitivityData data = LoadSensitivity(session);
  EXPECT_EQ(data.at("model.mass_scale=2.0").size(), 2u);
  EXPECT_EQ(data.at("model.mass_scale=3.0").size(), 2u);
  // Of the session and of the experiment with one trial a cell nothing has run again.
  const std::filesystem::path journal =
      PrepareSensitivity(request, settings).folder / "journal" / "0.jsonl";
  EXPECT_EQ(ReadFile(journal).find("\"trial\":0"), std::string::npos);
  // Nothing is left: nothing is written.
  const auto size = std::filesystem::file_size(journal);
  ASSERT_TRUE(RunSensitivity(request, settings));
  EXPECT_EQ(std::filesystem::file_size(journal), size);
}

TEST(DefaultVariations, AreUsableAndDifferFromTheSession) {
  SessionConfig config;
  const std::vector<Condition> conditions = ListSensitivityConditions(config);
  EXPECT_EQ(conditions.size(), 25u);
  for (const Condition& condition : conditions) {
    EXPECT_EQ(NormaliseSetting(condition.name, config), condition.name);
    EXPECT_EQ(condition.settings, (std::vector<std::string>{condition.name}));
  }
  // Twice the largest offset is out of range, and no offset cannot be halved or doubled.
  config.variation.offset = 0.1;
  EXPECT_EQ(ListSensitivityConditions(config).size(), 24u);
  config.variation.offset = 0.0;
  EXPECT_EQ(ListSensitivityConditions(config).size(), 23u);
}

/** Mean change of success over the pairs of a sweep's trials.csv, which must be `num_pairs`. */
double CalcChangeByHand(const std::filesystem::path& csv, size_t num_pairs) {
  std::istringstream lines(ReadFile(csv));
  std::vector<std::string> heading;
  std::map<std::string, std::map<std::string, int>> pairs;  // by draw: level -> success
  for (std::string line; std::getline(lines, line);) {
    std::map<std::string, std::string> row;
    std::istringstream cells(line);
    std::vector<std::string> all;
    for (std::string cell; std::getline(cells, cell, ',');) all.push_back(cell);
    if (heading.empty()) {
      heading = all;
      continue;
    }
    for (size_t i = 0; i < 9; ++i) row[heading[i]] = all.at(i);
    pairs[row["object"] + " " + row["grasp"] + " " + row["trial"]][row["model_friction_scale"]] =
        std::stoi(row["success"]);
  }
  EXPECT_EQ(pairs.size(), num_pairs);
  double sum = 0.0;
  for (const auto& [draw, levels] : pairs) sum += levels.at("0.5") - levels.at("1.0");
  return sum / static_cast<double>(num_pairs);
}

// Another friction by itself would take other grasps of two objects; compared are the grasps of the
// base, whoever asks.
TEST_F(SessionExperiment, SweepSensitivityAndCompareGiveOneAnswerOverAllPairs) {
  const std::string setting = "model.friction_scale=0.5";
  SweepConfig config;
  static_cast<SessionConfig&>(config) =
      MakeConfig({"bunch_of_keys", "golf_ball", "cup", "eraser", "light_bulb"}, 2);
  config.grasps = {"predicted"};
  const auto run = [this](const std::string& name, const SessionConfig& asked) {
    return LoadSession(RunNew(name, asked).folder);
  };
  /** The grasp that each object of a plan without conditions has. */
  const auto list_grasps = [](const Session& session) {
    std::map<std::string, std::string> grasps;
    for (const PlannedTrial& planned : session.plan) grasps[planned.object] = planned.grasp;
    return grasps;
  };
  const Session plain = run("plain", config);
  const auto grasps = list_grasps(plain);

  SessionConfig slippery = config;
  ApplySetting(setting, slippery);
  const auto others = list_grasps(Prepare("by itself", slippery).session);
  EXPECT_NE(others.at("bunch_of_keys"), grasps.at("bunch_of_keys"));
  EXPECT_NE(others.at("light_bulb"), grasps.at("light_bulb"));
  Session pinned;
  pinned.config = slippery;
  for (const std::string& object : config.objects) {
    slippery.objects = {object};
    slippery.grasps = {grasps.at(object)};
    const Session one = run("slippery " + object, slippery);
    pinned.plan.insert(pinned.plan.end(), one.plan.begin(), one.plan.end());
    pinned.records.insert(pinned.records.end(), one.records.begin(), one.records.end());
  }
  const SessionComparison comparison = CompareSessions(plain, pinned);
  EXPECT_EQ(comparison.pairs.size(), 10u);
  ASSERT_EQ(comparison.changes.size(), 1u);
  Json compared = RecordToJson(comparison.changes[0]);

  config.factors = {"model.friction_scale=1,0.5"};
  const Session sweep = run("sweep", MakeSweep(config));
  ExportResult(temporary_.path() / "sweep", sweep);
  const SweepSummary summary = SummariseSweep(sweep, {});
  const SweepEffect& effect = summary.effects.at(0);
  EXPECT_EQ(effect.measure, "success");
  EXPECT_EQ(effect.change.num_draws, 10);
  EXPECT_EQ(effect.change.num_objects, 5);
  EXPECT_EQ(effect.num_left_out, 0) << effect.why_left_out;
  EXPECT_DOUBLE_EQ(effect.change.estimate, comparison.changes[0].rate_change());
  ASSERT_TRUE(effect.change.interval);
  EXPECT_EQ(effect.change.interval->low, comparison.changes[0].rate_change_low);
  EXPECT_EQ(effect.change.interval->high, comparison.changes[0].rate_change_high);
  EXPECT_DOUBLE_EQ(effect.change.estimate,
                   CalcChangeByHand(temporary_.path() / "sweep" / "export" / "trials.csv", 10));

  ExperimentRequest request;
  request.folder = plain.folder;
  ASSERT_TRUE(RunSensitivity(request, {setting}));
  const SensitivitySummary asked = SummariseSensitivity(plain, LoadSensitivity(plain));
  ASSERT_EQ(asked.changes.size(), 1u);
  EXPECT_EQ(CountPairs(asked.changes[0]), "10");
  Json sensitive = RecordToJson(asked.changes[0]);
  for (Json* json : {&compared, &sensitive}) {
    for (const char* key : {"setting", "session_value"}) json->erase(key);  // names of the question
  }
  EXPECT_EQ(sensitive, compared);
}

TEST(RunMap, IsASessionThatGoesOnAndRefusesAnother) {
  const TemporaryFolder temporary;
  MapRequest request;
  request.base.hands = {"tum"};
  request.base.objects = {"golf_ball"};
  request.is_quick = true;
  request.out = temporary.path() / "map";
  const std::atomic<bool> stop = true;
  Observer observer(stop);
  const PreparedSession map = PrepareMap(request);
  EXPECT_FALSE(RunMap(map, request, observer));
  EXPECT_TRUE(IsMap(LoadSession(request.out).config));
  EXPECT_EQ(PrepareMap(request).session.plan.size(), map.session.plan.size());
  request.base.objects = {"can"};
  EXPECT_THROW(PrepareMap(request), Error);
}

TEST(RunMap, CopiesOfOneBodyAreRefusedBeforeAnythingIsMade) {
  const TemporaryFolder temporary;
  const std::filesystem::path ball = FindDataRoot() / "objects" / "catalogue" / "golf_ball";
  MapRequest request;
  request.base.hands = {"tum"};
  for (const char* id : {"one", "two"}) {
    std::filesystem::copy(ball, temporary.path() / id, std::filesystem::copy_options::recursive);
    request.base.objects.push_back((temporary.path() / id).string());
  }
  request.base.objects.erase(request.base.objects.begin());  // "all"
  request.out = temporary.path() / "map";
  try {
    PrepareMap(request);
    FAIL() << "copies were taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("\"one\" and \"two\" are the same body"),
              std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(request.out));
}

}  // namespace
}  // namespace graspbench
