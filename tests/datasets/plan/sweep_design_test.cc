#include "datasets/plan/sweep_design.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/error.h"
#include "datasets/plan/conditions.h"

namespace graspbench {
namespace {

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
    EXPECT_NE(text.find(part), std::string::npos) << text;
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
  expect(explain({"seed=1,2"}, "full"), "decides which trials there are");
  expect(explain({"delay.last=0.1,0.2"}, "full"), "the first level of delay.last");
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
            "the factor \"strategy.grip_margin\" has no use where strategy.grip is force; leave it "
            "out, or set strategy.grip");
  EXPECT_NE(explain("posture", {force, margin}), "accepted");
  EXPECT_EQ(explain("force", {force}), "accepted");
  EXPECT_EQ(explain("margin", {force, margin}), "accepted");
  EXPECT_EQ(explain("margin", {"strategy.grip=force,margin", margin}),
            "the factor \"strategy.grip_margin\" has no use under the condition "
            "\"strategy.grip_margin=4.0\", whose trials would be those without it; use --design "
            "one-at-a-time, or sweep each grip by itself");
}

// A base of posture keeps no margin: the condition of margin would have the default for its level 1.
TEST(SweepDesign, RefusesAFactorWhoseFirstLevelTheBaseLeavesOut) {
  SweepConfig sweep;
  sweep.factors = {"strategy.grip=posture,margin", "strategy.grip_margin=1,4"};
  try {
    MakeSweep(sweep);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "the factor \"strategy.grip_margin\" has no use where strategy.grip is posture, "
                 "the base's; name the grip that has one first: --factor "
                 "strategy.grip=margin,posture");
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
    EXPECT_NE(std::string(e.what()).find("sweep.yaml:1"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("sweep.yaml:3"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace graspbench
