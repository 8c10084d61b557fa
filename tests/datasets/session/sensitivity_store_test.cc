#include "datasets/session/sensitivity_store.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

constexpr char kHalf[] = "model.mass_scale=0.5";

class SensitivityStore : public ::testing::Test {
 protected:
  void SetUp() override {
    plan_ = CreateFakeSession(folder(), 2);
    JournalWriter journal(folder(), 0);
    for (const PlannedTrial& planned : plan_) journal.Append(MakeFakeRecord(planned));
  }
  std::filesystem::path folder() const { return temporary_.path() / "session"; }
  SensitivityData Load(OnDamage on_damage = OnDamage::kRefuse) {
    findings_ = {};
    return LoadSensitivity(LoadSession(folder(), on_damage), findings_);
  }
  TrialMeasures Measure(size_t place) const {
    return MakeTrialMeasures(MakeFakeRecord(plan_[place]).result);
  }

  TemporaryFolder temporary_;
  std::vector<PlannedTrial> plan_;
  Diagnostics findings_;
};

TEST_F(SensitivityStore, GivesBackWhatWasAppendedWhoeverWroteIt) {
  EXPECT_TRUE(Load().empty());
  SensitivityWriter(folder(), 0).Append(kHalf, plan_[0].id, Measure(0));
  SensitivityWriter(folder(), 1).Append(kHalf, plan_[1].id, Measure(1));
  SensitivityWriter(folder(), 1).Append(kHalf, plan_[0].id, Measure(0));
  SensitivityWriter(folder(), 1).Append("sim.step_s=0.001", plan_[0].id, Measure(1));
  const SensitivityData data = Load();
  EXPECT_TRUE(findings_.entries().empty()) << findings_.Format();
  ASSERT_EQ(data.size(), 2u);
  ASSERT_EQ(data.at(kHalf).size(), 2u);
  for (const size_t place : {0, 1}) {
    EXPECT_EQ(RecordToJson(data.at(kHalf).at(plan_[place].id)), RecordToJson(Measure(place)));
  }
}

TEST_F(SensitivityStore, DamageCostsTheLineAlone) {
  SensitivityWriter(folder(), 0).Append(kHalf, plan_[0].id, Measure(0));
  SensitivityWriter(folder(), 0).Append(kHalf, "0123456789abcdef", Measure(0));
  std::ofstream(folder() / "sensitivity" / "0.jsonl", std::ios::app) << "{\"x\":1}\n{\"cut";
  const SensitivityData data = Load(OnDamage::kAccept);
  EXPECT_EQ(data.at(kHalf).size(), 1u);
  const std::string text = findings_.Format();
  EXPECT_NE(text.find("sensitivity/0.jsonl:2: warning: skipped: trial 0123456789abcdef is not "
                      "finished; it counts as not run"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("sensitivity/0.jsonl:3: "), std::string::npos) << text;
  EXPECT_NE(text.find("sensitivity/0.jsonl:4: "), std::string::npos) << text;
}

TEST_F(SensitivityStore, TwoDifferentResultsAreRefused) {
  SensitivityWriter(folder(), 0).Append(kHalf, plan_[0].id, Measure(0));
  SensitivityWriter(folder(), 1).Append(kHalf, plan_[0].id, Measure(1));
  EXPECT_THROW(Load(), Error);
}

TEST(NormaliseSetting, GivesOneNameToOneSetting) {
  const SessionConfig config;
  for (const char* same : {"sim.step_s=0.001", "sim.step_s=1e-3", " sim.step_s = 1.0e-03"}) {
    EXPECT_EQ(NormaliseSetting(same, config), "sim.step_s=0.001");
  }
  EXPECT_EQ(NormaliseSetting("model.coupling_rule=even", config), "model.coupling_rule=even");
  EXPECT_EQ(NormaliseSetting("positioning=camera", config), "positioning=camera");
}

TEST(NormaliseSetting, RefusesWhatCannotBePaired) {
  const auto explain = [](const std::string& assignment) -> std::pair<ErrorKind, std::string> {
    try {
      return {ErrorKind::kUnsupported, NormaliseSetting(assignment, SessionConfig())};
    } catch (const Error& e) {
      return {e.kind(), e.what()};
    }
  };
  struct Case {
    const char* assignment;
    ErrorKind kind;
    const char* text;
  };
  for (const Case& c : {
           Case{"seed=2", ErrorKind::kUsage, "decides which trials there are"},
           Case{"hands=tum", ErrorKind::kUsage, "decides which trials there are"},
           Case{"positioning=eyes", ErrorKind::kRange, "nominal, true, camera"},
           Case{"sensors.rate_hz=100", ErrorKind::kUsage,
                "changes nothing here: the session has touch: exact, not sensed"},
           Case{"camera.noise_grey_levels=5", ErrorKind::kUsage,
                "positioning: nominal, not camera"},
           Case{"model.mas_scale=2", ErrorKind::kUsage, "did you mean \"model.mass_scale\"?"},
           Case{"model.mass_scale", ErrorKind::kUsage, "expected KEY=VALUE"},
           Case{"model.mass_scale=heavy", ErrorKind::kUsage, "expected a finite number"},
           Case{"model.mass_scale=0", ErrorKind::kRange, "expected 0.01 to 100"},
           Case{"model.coupling_rule=evn", ErrorKind::kRange, "did you mean \"even\"?"},
           Case{"sim.table_friction_dynamic=1", ErrorKind::kRange, "must not be higher"},
       }) {
    const auto [kind, text] = explain(c.assignment);
    EXPECT_EQ(kind, c.kind) << c.assignment;
    EXPECT_NE(text.find(c.text), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace graspbench
