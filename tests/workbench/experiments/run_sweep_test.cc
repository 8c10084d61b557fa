#include "workbench/experiments/run_sweep.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "core/base/files/files.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/export_result.h"
#include "datasets/analysis/session_comparison.h"
#include "datasets/plan/sweep_design.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

constexpr char kSlippery[] = "model.friction_scale=0.7";

class RunSweepTest : public testing::Test {
 protected:
  PreparedSession Prepare(const std::string& name, const SessionConfig& config) {
    SessionRequest request;
    request.config = config;
    request.out = temporary_.path() / name;
    return PrepareSession(request);
  }
  Session Run(const std::string& name, const SessionConfig& config) {
    const PreparedSession prepared = Prepare(name, config);
    EXPECT_TRUE(RunSweep(prepared, nullptr, {}, 2, observer_, stop_));
    return LoadSession(prepared.folder);
  }
  /** The grasp that each object of a plan without conditions has. */
  static std::map<std::string, std::string> ListGrasps(const Session& session) {
    std::map<std::string, std::string> grasps;
    for (const PlannedTrial& planned : session.plan) grasps[planned.object] = planned.grasp;
    return grasps;
  }

  TemporaryFolder temporary_;
  Observer observer_;
  std::atomic<bool> stop_ = false;
};

TEST_F(RunSweepTest, RunsTrialsThenBisectionsAndGoesOnWhereItStopped) {
  SweepConfig config;
  config.hands = {"tum"};
  config.objects = {"can"};
  config.trials = 1;
  config.factors = {"model.mass_scale=1,2"};
  const PreparedSession sweep = Prepare("sweep", MakeSweep(config));
  const double plain = EstimateSweepTime(sweep, false, false);
  EXPECT_GT(plain, 0.0);
  stop_ = true;
  EXPECT_FALSE(RunSweep(sweep, &kThresholdScales[0], {}, 1, observer_, stop_));
  stop_ = false;
  ASSERT_TRUE(RunSweep(sweep, &kThresholdScales[0], {}, 1, observer_, stop_));
  const Session session = LoadSession(sweep.folder);
  EXPECT_TRUE(FindUnfinished(session).empty());
  const std::vector<ThresholdSummary> thresholds = LoadThresholds(session);
  ASSERT_EQ(thresholds.size(), 1u);
  ASSERT_EQ(thresholds[0].draws.size(), 2u);
  for (const DrawThreshold& draw : thresholds[0].draws) EXPECT_FALSE(draw.found.next);
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
  for (const auto& [draw, levels] : pairs) sum += levels.at("0.7") - levels.at("1.0");
  return sum / static_cast<double>(num_pairs);
}

// Another friction by itself would take other grasps of two objects; compared are the grasps of the
// base, whoever asks.
TEST_F(RunSweepTest, SweepSensitivityAndCompareGiveOneAnswerOverAllPairs) {
  SweepConfig config;
  config.hands = {"tum"};
  config.objects = {"pencil", "golf_ball", "cup", "eraser", "light_bulb"};
  config.trials = 2;
  const Session plain = Run("plain", config);
  const auto grasps = ListGrasps(plain);

  SessionConfig slippery = config;
  ApplySetting(kSlippery, slippery);
  const auto others = ListGrasps(Prepare("by itself", slippery).session);
  EXPECT_NE(others.at("pencil"), grasps.at("pencil"));
  EXPECT_NE(others.at("golf_ball"), grasps.at("golf_ball"));
  Session pinned;
  pinned.config = slippery;
  for (const std::string& object : config.objects) {
    slippery.objects = {object};
    slippery.grasps = {grasps.at(object)};
    const Session one = Run("slippery " + object, slippery);
    pinned.plan.insert(pinned.plan.end(), one.plan.begin(), one.plan.end());
    pinned.records.insert(pinned.records.end(), one.records.begin(), one.records.end());
  }
  const SessionComparison comparison = CompareSessions(plain, pinned);
  EXPECT_EQ(comparison.pairs.size(), 10u);
  ASSERT_EQ(comparison.changes.size(), 1u);
  Json compared = RecordToJson(comparison.changes[0]);

  config.factors = {"model.friction_scale=1,0.7"};
  const Session sweep = Run("sweep", MakeSweep(config));
  ExportResult(temporary_.path() / "sweep", sweep);
  const SweepSummary summary = SummariseSweep(sweep, {});
  const SweepEffect& effect = summary.effects.at(0);
  EXPECT_EQ(effect.measure, "success");
  EXPECT_EQ(effect.num_draws, 10);
  EXPECT_EQ(effect.num_objects, 5);
  EXPECT_EQ(effect.num_left_out, 0) << effect.why_left_out;
  EXPECT_DOUBLE_EQ(effect.estimate, comparison.changes[0].rate_change());
  EXPECT_DOUBLE_EQ(effect.estimate,
                   CalcChangeByHand(temporary_.path() / "sweep" / "export" / "trials.csv", 10));

  ExperimentRequest request;
  request.folder = plain.folder;
  const auto list_conditions = [](const SessionConfig& session) {
    return ListSensitivityConditions(session, {kSlippery});
  };
  const PreparedSession prepared = PrepareExperiment(request, "sensitivity", list_conditions);
  ASSERT_TRUE(RunExperiment(prepared, request, 2, observer_, stop_));
  const SensitivitySummary asked = SummariseSensitivity(plain, LoadSensitivity(plain));
  ASSERT_EQ(asked.changes.size(), 1u);
  EXPECT_EQ(CountPairs(asked.changes[0]), "10");
  Json sensitive = RecordToJson(asked.changes[0]);
  for (Json* json : {&compared, &sensitive}) {
    for (const char* key : {"setting", "session_value"}) json->erase(key);  // names of the question
    for (Json& measure : json->at("measures")) {  // resampled by the question's name
      for (const char* key : {"change_low", "change_high"}) measure.erase(key);
    }
  }
  EXPECT_EQ(sensitive, compared);
}

}  // namespace
}  // namespace graspbench
