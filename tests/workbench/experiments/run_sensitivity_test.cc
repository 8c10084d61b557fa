#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "datasets/plan/conditions.h"
#include "tests/datasets/session/fake_session.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {
namespace {

class RunSensitivityTest : public testing::Test {
 protected:
  /** Two trials of a session with one setting changed. */
  Session RunWith(const std::string& name, const std::string& setting) {
    SessionRequest request;
    request.config = SessionConfig();
    request.config->hands = {"tum"};
    request.config->objects = {"golf_ball"};
    request.config->trials = 2;
    if (!setting.empty()) ApplySetting(setting, *request.config);
    request.out = temporary_.path() / name;
    RunRound(kTrialRound, PrepareSession(request), 1, observer_, stop_);
    return LoadSession(request.out);
  }
  PreparedSession Prepare(const ExperimentRequest& request) const {
    return PrepareExperiment(request, "sensitivity", [this](const SessionConfig& config) {
      return ListSensitivityConditions(config, settings_);
    });
  }
  bool Run(const ExperimentRequest& request, int num_workers) {
    return RunExperiment(Prepare(request), request, num_workers, observer_, stop_);
  }

  TemporaryFolder temporary_;
  std::vector<std::string> settings_;
  Observer observer_;
  std::atomic<bool> stop_ = false;
};

// What a session of this setting finds from the start is what the same trials find here.
TEST_F(RunSensitivityTest, FindsWhatASessionOfThatSettingFinds) {
  const Session session = RunWith("plain", "");
  const std::vector<std::string> settings = {"model.mass_scale=3.0", "variation.offset_m=0.01",
                                             "model.mass_scale=1.0"};
  ExperimentRequest request;
  request.folder = session.folder;
  settings_ = settings;
  ASSERT_TRUE(Run(request, 2));
  const SensitivityData data = LoadSensitivity(session);
  ASSERT_EQ(data.size(), settings.size());
  for (const std::string& setting : settings) {
    const Session other = RunWith("with " + setting, setting);
    for (size_t i = 0; i < other.records.size(); ++i) {
      EXPECT_EQ(RecordToJson(data.at(setting).at(session.records[i].plan.id)),
                RecordToJson(MakeTrialMeasures(other.records[i].result)))
          << setting;
    }
  }
  for (const TrialRecord& record : session.records) {
    const Json plain = RecordToJson(MakeTrialMeasures(record.result));
    EXPECT_EQ(RecordToJson(data.at("model.mass_scale=1.0").at(record.plan.id)), plain);
    EXPECT_NE(RecordToJson(data.at("variation.offset_m=0.01").at(record.plan.id)), plain);
  }
}

TEST_F(RunSensitivityTest, AGripThatTheSessionDoesNotUseIsRefused) {
  const Session session = RunWith("gentle", "strategy.grip=force");
  ExperimentRequest request;
  request.folder = session.folder;
  settings_ = {"strategy.grip_margin=3"};
  EXPECT_THROW(Prepare(request), Error);
}

TEST_F(RunSensitivityTest, GoesOnWhereItStopped) {
  const Session session = RunWith("plain", "");
  ExperimentRequest request;
  request.folder = session.folder;
  settings_ = {"model.mass_scale=3", "model.mass_scale=2"};
  request.trials_per_cell = 1;
  stop_ = true;
  EXPECT_FALSE(Run(request, 1));
  stop_ = false;
  ASSERT_TRUE(Run(request, 1));
  EXPECT_EQ(LoadSensitivity(session).at("model.mass_scale=2.0").size(), 1u);
  request.trials_per_cell = 0;
  ASSERT_TRUE(Run(request, 1));
  const SensitivityData data = LoadSensitivity(session);
  EXPECT_EQ(data.at("model.mass_scale=2.0").size(), 2u);
  EXPECT_EQ(data.at("model.mass_scale=3.0").size(), 2u);
  // Of the session and of the experiment with one trial a cell nothing has run again.
  const PreparedSession experiment = Prepare(request);
  EXPECT_EQ(ReadFile(experiment.folder / "journal" / "0.jsonl").find("\"trial\":0"),
            std::string::npos);
  // Nothing is left: nothing is written.
  const auto size = std::filesystem::file_size(experiment.folder / "journal" / "0.jsonl");
  ASSERT_TRUE(Run(request, 1));
  EXPECT_EQ(std::filesystem::file_size(experiment.folder / "journal" / "0.jsonl"), size);
}

TEST_F(RunSensitivityTest, RefusesASettingNamedTwiceBeforeAnythingRuns) {
  const Session session = RunWith("plain", "");
  ExperimentRequest request;
  request.folder = session.folder;
  settings_ = {"model.mass_scale=2", "model.mass_scale=2.0"};
  EXPECT_THROW(Run(request, 1), Error);
  EXPECT_TRUE(LoadSensitivity(session).empty());
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

}  // namespace
}  // namespace graspbench
