#include "datasets/plan/conditions.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/base/error.h"
#include "datasets/plan/session_plan.h"
#include "tests/datasets/find_error.h"

namespace graspbench {

namespace {

TEST(NormaliseSetting, GivesOneNameToOneSetting) {
  const SessionConfig config;
  for (const char* same : {"sim.step_s=0.001", "sim.step_s=1e-3", " sim.step_s = 1.0e-03"}) {
    EXPECT_EQ(NormaliseSetting(same, config), "sim.step_s=0.001");
  }
  EXPECT_EQ(NormaliseSetting("model.coupling_rule=even", config), "model.coupling_rule=even");
  EXPECT_EQ(NormaliseSetting("positioning=camera", config), "positioning=camera");
  EXPECT_EQ(NormaliseSetting("delay.last=1e-1", config), "delay.last=0.1");
  EXPECT_EQ(NormaliseSetting("grasp=g2", config), "grasp=g2");
}

TEST(NormaliseSetting, RefusesWhatCannotBePaired) {
  const auto explain = [](const std::string& assignment) -> std::pair<ErrorKind, std::string> {
    try {
      SessionConfig config;
      config.strategy.grip = "posture";
      return {ErrorKind::kUnsupported, NormaliseSetting(assignment, config)};
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
           Case{"seed=2", ErrorKind::kUsage, "changes the plan; only settings that keep the draws"},
           Case{"hands=tum", ErrorKind::kUsage,
                "changes the plan; only settings that keep the draws"},
           Case{"positioning=eyes", ErrorKind::kRange, "nominal, true, camera"},
           Case{"sensors.rate_hz=100", ErrorKind::kUsage,
                "has no effect here: the session has touch: exact, not sensed"},
           Case{"camera.noise_grey_levels=5", ErrorKind::kUsage,
                "positioning: nominal, not camera"},
           Case{"strategy.grip_force_n=5", ErrorKind::kUsage, "has no effect here"},
           Case{"model.mas_scale=2", ErrorKind::kUsage, "did you mean \"model.mass_scale\"?"},
           Case{"model.mass_scale", ErrorKind::kUsage, "expected KEY=VALUE"},
           Case{"model.mass_scale=heavy", ErrorKind::kUsage, "expected a finite number"},
           Case{"model.mass_scale=0", ErrorKind::kRange, "expected 0.01 to 100"},
           Case{"model.coupling_rule=evn", ErrorKind::kRange, "did you mean \"even\"?"},
           Case{"sim.table_friction_dynamic=1", ErrorKind::kRange, "must not be higher"},
           Case{"delay.last=-0.1", ErrorKind::kRange, "expected a time from 0 to 10"},
           Case{"delay.last=soon", ErrorKind::kRange, "expected a time from 0 to 10"},
           Case{"backend=simbody", ErrorKind::kUsage, "no backend \"simbody\""},
           Case{"grasp=my.yaml", ErrorKind::kUsage, "named by --grasp"},
           Case{"grasp=all", ErrorKind::kUsage, "expected best or the id of one grasp"},
       }) {
    const auto [kind, text] = explain(c.assignment);
    EXPECT_EQ(kind, c.kind) << c.assignment;
    EXPECT_TRUE(Has(text, c.text));
  }
}

TEST(Conditions, TheCompliantBackendRefusesAnArm) {
  SweepConfig sweep;
  sweep.arm.model = "pa10";
  sweep.factors = {"backend=implicit,compliant"};
  try {
    MakeSweep(sweep);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUnsupported);
    EXPECT_TRUE(Has(error.what(),
                    "the condition \"backend=compliant\" has arm.model pa10 and the compliant "
                    "backend, which has no robot arm; leave one of them out"));
  }
}

class PlannedConditions : public testing::Test {
 protected:
  PlannedConditions() {
    config_.hands = {"tum"};
    config_.objects = {"golf_ball"};
    config_.trials = 2;
  }
  /** The trials under one condition; none: of the base. */
  std::vector<PlannedTrial> FindTrials(const std::optional<std::string>& condition) const {
    std::vector<PlannedTrial> trials;
    for (const PlannedTrial& planned : MakePlan(config_, LoadSessionInputs(config_))) {
      if (planned.condition == condition) trials.push_back(planned);
    }
    return trials;
  }
  SessionConfig config_;
};

// The base is the session's own trials, and a condition of settings those of the session that has
// them: so what is known already need not run again.
TEST_F(PlannedConditions, HaveTheIdsOfTheSessionsThatTheyAre) {
  const SessionConfig plain = config_;
  config_.conditions = {{"heavy", {"model.mass_scale=2.0"}}, {"late", {"delay.last=0.1"}}};
  const std::vector<PlannedTrial> base = MakePlan(plain, LoadSessionInputs(plain));
  EXPECT_EQ(FindTrials(std::nullopt), base);
  SessionConfig heavy = plain;
  ApplySetting("model.mass_scale=2", heavy);
  const std::vector<PlannedTrial> expected = MakePlan(heavy, LoadSessionInputs(heavy));
  const std::vector<PlannedTrial> found = FindTrials("heavy");
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].id, expected[i].id);
  std::set<std::string> ids;
  for (const PlannedTrial& planned : MakePlan(config_, LoadSessionInputs(config_))) {
    EXPECT_TRUE(ids.insert(planned.id).second) << DescribeTrial(planned);
  }
  EXPECT_EQ(ids.size(), 6u);
}

// The same unit variates in a box twice as wide: every offset is twice what it was.
TEST_F(PlannedConditions, ScaleTheSameDraws) {
  config_.conditions = {{"wide", {"variation.offset_m=0.01"}}};
  const SessionInputs inputs = LoadSessionInputs(config_);
  const std::vector<PlannedTrial> base = FindTrials(std::nullopt), wide = FindTrials("wide");
  ASSERT_EQ(wide.size(), base.size());
  for (size_t i = 0; i < wide.size(); ++i) {
    const TrialDraw narrow = MakeTrialSetup(config_, inputs, base[i]).draw;
    const TrialDraw broad = MakeTrialSetup(config_, inputs, wide[i]).draw;
    EXPECT_NEAR(broad.offset_x, 2.0 * narrow.offset_x, 1e-15);
    EXPECT_NEAR(broad.offset_y, 2.0 * narrow.offset_y, 1e-15);
    EXPECT_EQ(broad.offset_yaw, narrow.offset_yaw);
    EXPECT_EQ(broad.joint_error, narrow.joint_error);
  }
}

TEST_F(PlannedConditions, ThatComeToOneTrialAreRefused) {
  // A condition that changes nothing shows that nothing changes; the best grasp has another name.
  config_.conditions = {{"nothing", {"model.mass_scale=1.0"}}};
  EXPECT_EQ(MakePlan(config_, LoadSessionInputs(config_)).size(), 4u);
  config_.conditions = {{"same", {"grasp=g6"}}};
  EXPECT_THROW(MakePlan(config_, LoadSessionInputs(config_)), Error);
}

TEST_F(PlannedConditions, AreFrozenWithTheSession) {
  config_.conditions = {{"heavy", {"model.mass_scale=2.0"}}, {"late", {"delay.last=0.1"}}};
  config_.draws = "halton";
  const SessionConfig read = SessionConfigFromJson(ToJson(config_));
  EXPECT_EQ(ToJson(read), ToJson(config_));
  ASSERT_EQ(read.conditions.size(), 2u);
  EXPECT_EQ(read.conditions[1].settings, config_.conditions[1].settings);
  // Sessions without them are written as ever.
  EXPECT_FALSE(ToJson(SessionConfig()).contains("conditions"));
  EXPECT_FALSE(ToJson(SessionConfig()).contains("draws"));
}

TEST_F(PlannedConditions, HaveFactorsWithTheBasesLevelFirst) {
  config_.conditions = {{"a", {"model.mass_scale=2.0"}},
                        {"b", {"delay.last=0.1", "model.mass_scale=0.5"}}};
  const std::vector<SweepFactor> factors = ListFactors(config_);
  ASSERT_EQ(factors.size(), 2u);
  EXPECT_EQ(factors[0].levels, (std::vector<std::string>{"1.0", "2.0", "0.5"}));
  EXPECT_EQ(factors[1].levels, (std::vector<std::string>{"0.0", "0.1"}));
  EXPECT_EQ(FindLevel(config_, "a", "delay.last"), "0.0");
  EXPECT_EQ(FindLevel(config_, "b", "delay.last"), "0.1");
  EXPECT_EQ(FindLevel(config_, std::nullopt, "model.mass_scale"), "1.0");
}

SweepConfig MakeTwoFactors(const std::string& design) {
  SweepConfig sweep;
  sweep.factors = {"model.mass_scale=2,1,0.5", "delay.last=0,0.1"};
  sweep.design = design;
  return sweep;
}

TEST(SweepDesign, FullHasEveryCombinationAndTheFirstLevelsAsItsBase) {
  const SessionConfig config = MakeSweep(MakeTwoFactors("full"));
  EXPECT_EQ(config.model.mass_scale, 2.0);
  ASSERT_EQ(config.conditions.size(), 5u);  // 3 x 2 less the base
  EXPECT_EQ(config.conditions[0].name, "delay.last=0.1");
  EXPECT_EQ(config.conditions[4].name, "model.mass_scale=0.5, delay.last=0.1");
  const std::vector<SweepFactor> factors = ListFactors(config);
  EXPECT_EQ(factors[1].key, "model.mass_scale");
  EXPECT_EQ(factors[1].levels.front(), "2.0");
}

TEST(SweepDesign, OneAtATimeChangesOneFactorEach) {
  const SessionConfig config = MakeSweep(MakeTwoFactors("one-at-a-time"));
  ASSERT_EQ(config.conditions.size(), 3u);
  for (const Condition& condition : config.conditions) EXPECT_EQ(condition.settings.size(), 1u);
}

// Of a Latin hypercube every level of a factor is in as many points as any other.
TEST(SweepDesign, LatinHasEveryLevelEquallyOften) {
  SweepConfig sweep;
  sweep.factors = {"model.mass_scale=1,0.5,2", "model.friction_scale=1,0.8",
                   "sim.step_s=0.002,0.001", "variation.offset_m=0.005,0.01,0.02"};
  sweep.design = "latin:12";
  const SessionConfig config = MakeSweep(sweep);
  std::map<std::string, int> counts;
  for (const Condition& condition : config.conditions) {
    for (const std::string& setting : condition.settings) ++counts[setting];
  }
  EXPECT_LE(config.conditions.size(), 12u);  // a point that falls on another is tried once
  if (config.conditions.size() == 12u) {
    EXPECT_EQ(counts["model.mass_scale=0.5"], 4);
    EXPECT_EQ(counts["model.friction_scale=0.8"], 6);
    EXPECT_EQ(counts["variation.offset_m=0.02"], 4);
  }
  EXPECT_EQ(ToJson(MakeSweep(sweep)), ToJson(config));
  sweep.seed = 2;
  EXPECT_NE(ToJson(MakeSweep(sweep)).at("conditions"), ToJson(config).at("conditions"));
}

TEST(SweepDesign, RefusesWhatIsNoDesign) {
  const auto explain = [](std::vector<std::string> factors, const std::string& design) {
    SweepConfig sweep;
    sweep.factors = std::move(factors);
    sweep.design = design;
    try {
      MakeSweep(sweep);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  const auto expect = [](const std::string& text, const char* part) {
    EXPECT_TRUE(Has(text, part));
  };
  expect(explain({}, "full"), "a sweep needs a factor");
  expect(explain({"model.mass_scale"}, "full"), "expected KEY=VALUE,VALUE");
  expect(explain({"model.mass_scale=1"}, "full"), "expected two levels or more");
  expect(explain({"model.mass_scale=1,1.0"}, "full"), "is given twice");
  expect(explain({"model.mass_scale=1,2", "model.mass_scale=3,4"}, "full"), "is named twice");
  expect(explain({"model.mass_scale=1,2"}, "half"), "no design \"half\"");
  expect(explain({"model.mass_scale=1,2"}, "latin:x"), "no design \"latin:x\"");
  expect(explain({"model.mass_scale=1,2", "sim.step_s=0.002,0.001"}, "latin:4"),
         "the factors have 4 combinations in all");
  expect(explain({"seed=1,2"}, "full"), "changes the plan; only settings that keep the draws");
  expect(explain({"delay.last=0.1,0.2"}, "full"), "the first (base) level of delay.last");
  expect(explain({"delay.last=0,0.2", "delay.first=0,0.1"}, "full"), "cannot delay two digits");
  expect(explain({"model.mass_scale=1,200"}, "full"), "out of range");
  std::string many = "variation.offset_m=0";
  for (int i = 1; i <= 150; ++i) many += "," + std::to_string(0.0001 * i);
  expect(explain({many, "variation.yaw_rad" + many.substr(many.find('='))}, "full"),
         "more than 10000 conditions");
}

// What no trial looks at would be told as a factor without effect.
TEST(SweepDesign, RefusesAFactorThatNoTrialLooksAt) {
  const auto explain = [](const std::string& grip, std::vector<std::string> factors) {
    SweepConfig sweep;
    sweep.strategy.grip = grip;
    sweep.factors = std::move(factors);
    try {
      MakeSweep(sweep);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string margin = "strategy.grip_margin=1,4", force = "strategy.grip_force_n=1,4";
  EXPECT_EQ(explain("force", {margin}),
            "the factor \"strategy.grip_margin\" has no effect if strategy.grip is force; leave it "
            "out, or set strategy.grip");
  EXPECT_NE(explain("posture", {force, margin}), "accepted");
  EXPECT_EQ(explain("force", {force}), "accepted");
  EXPECT_EQ(explain("margin", {force, margin}), "accepted");
  EXPECT_EQ(explain("margin", {"strategy.grip=force,margin", margin}),
            "the factor \"strategy.grip_margin\" has no effect under the condition "
            "\"strategy.grip_margin=4.0\", whose trials would not change; use --design "
            "one-at-a-time, or sweep each grip separately");
}

// A base of posture keeps no margin: the condition of margin would have the default for its level 1.
TEST(SweepDesign, RefusesAFactorWhoseFirstLevelTheBaseLeavesOut) {
  SweepConfig sweep;
  sweep.factors = {"strategy.grip=posture,margin", "strategy.grip_margin=1,4"};
  try {
    MakeSweep(sweep);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "the factor \"strategy.grip_margin\" has no effect if strategy.grip is posture, the base "
        "level; list the grip that uses it first: --factor strategy.grip=margin,posture");
  }
  sweep.factors = {"strategy.grip=margin,posture", "strategy.grip_margin=1,4"};
  sweep.design = "one-at-a-time";
  const SessionConfig config = MakeSweep(sweep);
  EXPECT_EQ(config.strategy.grip_margin, 1.0);
  EXPECT_EQ(config.conditions.size(), 2u);
}

TEST(SweepFile, IsASessionWithFactors) {
  const SweepConfig sweep = ParseSweepConfig(
      "factors:\n  - model.mass_scale=1,2\n  - grasp=g1,g2\ndesign: one-at-a-time\ntrials: 3\n",
      "sweep.yaml");
  EXPECT_EQ(sweep.factors, (std::vector<std::string>{"model.mass_scale=1,2", "grasp=g1,g2"}));
  EXPECT_EQ(sweep.trials, 3);
  EXPECT_EQ(MakeSweep(sweep).grasps, std::vector<std::string>{"g1"});
  try {
    ParseSweepConfig("factor: model.mass_scale=1,2\nsim:\n  step_s: 5\n", "sweep.yaml");
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    EXPECT_TRUE(Has(e.what(), "sweep.yaml:1"));
    EXPECT_TRUE(Has(e.what(), "sweep.yaml:3"));
  }
}

}  // namespace

}  // namespace graspbench
