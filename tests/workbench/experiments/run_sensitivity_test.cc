#include "workbench/experiments/run_sensitivity.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/plan/conditions.h"
#include "datasets/session/sensitivity_store.h"
#include "tests/datasets/session/fake_session.h"

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
  bool Run(const SensitivityRequest& request, int num_workers) {
    return RunExperiment(PrepareSensitivity(request), request, num_workers, observer_, stop_);
  }

  TemporaryFolder temporary_;
  Observer observer_;
  std::atomic<bool> stop_ = false;
};

// What a session of this setting finds from the start is what the same trials find here.
TEST_F(RunSensitivityTest, FindsWhatASessionOfThatSettingFinds) {
  const Session session = RunWith("plain", "");
  const std::vector<std::string> settings = {"model.mass_scale=3.0", "variation.offset_m=0.01",
                                             "model.mass_scale=1.0"};
  SensitivityRequest request;
  request.folder = session.folder;
  request.settings = settings;
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
  SensitivityRequest request;
  request.folder = session.folder;
  request.settings = {"strategy.grip_margin=3"};
  EXPECT_THROW(PrepareSensitivity(request), Error);
}

TEST_F(RunSensitivityTest, GoesOnWhereItStopped) {
  const Session session = RunWith("plain", "");
  SensitivityRequest request;
  request.folder = session.folder;
  request.settings = {"model.mass_scale=3", "model.mass_scale=2"};
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
  const PreparedSession experiment = PrepareSensitivity(request);
  EXPECT_EQ(ReadFile(experiment.folder / "journal" / "0.jsonl").find("\"trial\":0"),
            std::string::npos);
  // Nothing is left: nothing is written.
  const auto size = std::filesystem::file_size(experiment.folder / "journal" / "0.jsonl");
  ASSERT_TRUE(Run(request, 1));
  EXPECT_EQ(std::filesystem::file_size(experiment.folder / "journal" / "0.jsonl"), size);
}

TEST_F(RunSensitivityTest, RefusesASettingNamedTwiceBeforeAnythingRuns) {
  const Session session = RunWith("plain", "");
  SensitivityRequest request;
  request.folder = session.folder;
  request.settings = {"model.mass_scale=2", "model.mass_scale=2.0"};
  EXPECT_THROW(Run(request, 1), Error);
  EXPECT_TRUE(LoadSensitivity(session).empty());
}

TEST(DefaultVariations, AreUsableAndDifferFromTheSession) {
  SessionConfig config;
  const std::vector<std::string> settings = ListDefaultVariations(config);
  EXPECT_EQ(settings.size(), 25u);
  for (const std::string& setting : settings) {
    EXPECT_EQ(NormaliseSetting(setting, config), setting);
  }
  // Twice the largest offset is out of range, and no offset cannot be halved or doubled.
  config.variation.offset = 0.1;
  EXPECT_EQ(ListDefaultVariations(config).size(), 24u);
  config.variation.offset = 0.0;
  EXPECT_EQ(ListDefaultVariations(config).size(), 23u);
}

}  // namespace
}  // namespace graspbench
