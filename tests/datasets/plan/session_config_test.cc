#include "datasets/plan/session_config.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/hand/load_hand.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/plan/session_plan.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

/** What is told about a session's text, after the headline; empty when it is fine. */
std::string FindProblems(const std::string& text) {
  try {
    ParseSessionConfig(text, "s.yaml");
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kFormat);
    const std::string what = e.what();
    return what.substr(what.find('\n') + 1);
  }
  return "";
}

TEST(SessionConfig, NoKeyLacksItsMeaning) {
  for (const FileKey& row : ListSessionKeys()) {
    EXPECT_NE(row.meaning, "") << row.key;
    EXPECT_EQ(row.fallback.empty(), row.key == "preset" || row.key == "policy.command") << row.key;
  }
  const FileKey* step = FindFileKey(ListSessionKeys(), "sim.step_s");
  ASSERT_NE(step, nullptr);
  EXPECT_EQ(step->fallback, "0.002");
  EXPECT_EQ(FormatRange(*step), "0.0001 to 0.01");
}

TEST(SessionConfig, ReadsYamlOverTheDefaults) {
  TemporaryFolder folder;
  const auto path = folder.path() / "session.yaml";
  WriteFileAtomically(path,
                      "hands: shadow\n"
                      "objects: [mug, ../my objects/vase]\n"
                      "grasps: g1, g2\n"
                      "sim: {step_s: 1.0e-3}\n"
                      "variation:\n");
  const SessionConfig config = LoadSessionConfig(path.string());
  EXPECT_EQ(config.hands, std::vector<std::string>{"shadow"});
  EXPECT_EQ(config.objects, (std::vector<std::string>{"mug", "../my objects/vase"}));
  EXPECT_EQ(config.grasps, (std::vector<std::string>{"g1", "g2"}));
  EXPECT_EQ(config.sim.step, 0.001);
  EXPECT_EQ(config.trials, 10);
}

TEST(SessionConfig, TellsEveryProblemWithItsLine) {
  const std::string text = FindProblems(
      "trails: 3\ntrials: 0\nhands: [tum, shadow, tum]\nobjects: []\ngrasps: all, g1\n"
      "sim:\n  step_s: 1\n  stp_s: 2\nseed: 3\nseed: 4\nvariation: 3\nstrategy:\n"
      "  lift_time_s: slow\n");
  for (const char* part :
       {"s.yaml:1: error: session: unknown key \"trails\"; did you mean \"trials\"?",
        "s.yaml:2: error: trials: 0 is out of range; expected 1 to 100000",
        "s.yaml:3: error: hands: \"tum\" is listed twice",
        "s.yaml:4: error: objects: the list is empty; name at least one, or \"all\"",
        "s.yaml:5: error: grasps: \"all\" must stand alone, without other names",
        "s.yaml:7: error: sim.step_s: 1 is out of range; expected 0.0001 to 0.01",
        "s.yaml:8: error: sim: unknown key \"stp_s\"; did you mean \"step_s\"?",
        "s.yaml:10: error: session: \"seed\" is given twice",
        "s.yaml:11: error: variation: expected a map of keys and values",
        "s.yaml:13: error: strategy, lift_time_s: expected a finite number"}) {
    EXPECT_TRUE(Has(text, part));
  }
}

TEST(SessionConfig, EveryNumberHasARange) {
  for (const std::string& key : ListConfigKeys(SessionConfig())) {
    if (key == "hands" || key == "objects" || key == "grasps") continue;
    if (key == "camera.shadows" || key == "policy.command" || key == "arm.model") {
      continue;  // no number
    }
    SessionConfig config;
    config.policy.command = "x";
    ApplySetting(key + "=-1", config);
    const auto problems = Validate(config);
    ASSERT_FALSE(problems.empty()) << key << " has no range in datasets/plan/session_config.cc";
    EXPECT_EQ(problems[0].key, key);
  }
}

TEST(SessionConfig, AllProblemsOfTheValuesAreTold) {
  SessionConfig config;
  config.trials = -5;
  config.sim.step = std::numeric_limits<double>::quiet_NaN();
  config.sim.table_friction_dynamic = 0.5;
  config.strategy.stabilisation_min_time = 3.0;
  EXPECT_EQ(FindError([&] { CheckSessionConfig(config); }),
            "the session cannot be run\n"
            "trials: -5 is out of range; expected 1 to 100000\n"
            "sim.step_s: nan is out of range; expected 0.0001 to 0.01\n"
            "strategy.stabilisation_min_time_s: must not be longer than "
            "strategy.stabilisation_max_time_s\n"
            "sim.table_friction_dynamic: must not be higher than sim.table_friction_static");
}

TEST(SessionConfig, TheFrozenConfigurationIsCompleteAndReadsBack) {
  SessionConfig config;
  config.seed = 7;
  config.variation.yaw = 0.1 + 0.2;
  config.hands = {"../a \"hand\"", "tum"};
  config.approach = "side";
  config.positioning = "camera";
  config.arm.model = "pa10";
  config.touch = "sensed";
  config.policy.command = "x";
  config.imperfections.stick_slip = 0.1;
  config.strategy.grip = "margin";  // what a firm grip does not say is not frozen (grip_check.h)
  config.strategy.drive_law = "saturating";
  config.strategy.touch_speed = 0.25;
  config.strategy.closure_lead = 0.1;
  const Json json = ToJson(config);
  for (const std::string& key : ListConfigKeys(config)) {
    const Json* value = &json;
    for (std::string rest = key; value != nullptr && !rest.empty();) {
      const size_t dot = std::min(rest.find('.'), rest.size());
      value = value->find(rest.substr(0, dot));
      rest.erase(0, dot + 1);
    }
    EXPECT_NE(value, nullptr) << key;
  }
  const SessionConfig read = SessionConfigFromJson(Json::parse(json.dump()));
  EXPECT_EQ(ToJson(read).dump(), json.dump());
  EXPECT_EQ(read.variation.yaw, config.variation.yaw);
  EXPECT_TRUE(FindConfigDifferences(config, read).empty());
}

/** The only problem of the configuration with these settings: its key, and its text. */
std::pair<std::string, std::string> FindProblem(const std::vector<std::string>& settings) {
  SessionConfig config;
  for (const std::string& setting : settings) ApplySetting(setting, config);
  const std::vector<ConfigProblem> problems = Validate(config);
  if (problems.size() != 1) ADD_FAILURE() << settings[0] << ": " << problems.size() << " problems";
  return problems.empty() ? std::pair("", "") : std::pair(problems[0].key, problems[0].text);
}

TEST(SessionConfig, UnknownNamesAreRefusedWithTheKnownOnes) {
  struct Case {
    const char *setting, *key, *text;
  };
  for (const Case& c : {
           Case{"approach=sied", "approach",
                "no approach \"sied\"; did you mean \"side\"? Known: automatic, above, side"},
           Case{"positioning=camra", "positioning",
                "no positioning \"camra\"; did you mean \"camera\"? Known: nominal, true, camera"},
           Case{"touch=sense", "touch",
                "no touch \"sense\"; did you mean \"sensed\"? Known: exact, sensed"},
           Case{"model.coupling_rule=evn", "model.coupling_rule",
                "no rule \"evn\"; did you mean \"even\"? Known: own, middle-first, even, fixed"},
       }) {
    EXPECT_EQ(FindProblem({c.setting}), std::pair(std::string(c.key), std::string(c.text)));
  }
  EXPECT_EQ(FindProblem({"positioning=camera", "camera.table_colour=green"}).second,
            "\"green\" is no colour; expected one as \"#b4509b\"");
}

// Sessions of earlier versions stay readable and keep their ids; and what a session does not use
// does not count.
TEST(SessionConfig, ADefaultChoiceIsNotWritten) {
  const Json plain = ToJson(SessionConfig());
  for (const auto& [setting, unused] : {std::pair("approach=above", ""),
                                        {"positioning=camera", "camera.noise_grey_levels=7"},
                                        {"arm.model=pa10", "arm.base_x_m=-0.7"},
                                        {"touch=sensed", "sensors.noise=0.01"},
                                        {"imperfections.stick_slip=0.1", ""}}) {
    SessionConfig config;
    if (*unused) ApplySetting(unused, config);
    EXPECT_EQ(ToJson(config), plain) << unused;
    ApplySetting(setting, config);
    const std::string key =
        std::string(setting).substr(0, std::string(setting).find_first_of("=."));
    EXPECT_FALSE(plain.contains(key));
    EXPECT_TRUE(ToJson(config).contains(key));
    EXPECT_TRUE(FindConfigDifferences(SessionConfigFromJson(ToJson(config)), config).empty());
  }
  SessionConfig by_sight;
  by_sight.grasps = {"g1", "by-sight"};
  EXPECT_TRUE(ToJson(by_sight).contains("camera"));
}

// A trial of other masses or drives is another trial, but meets the same pose and joint errors.
TEST(SessionConfig, SettingsOfTheModelChangeIdsAndNoDraws) {
  const SessionInputs inputs = MakeFakeInputs();
  const std::vector<PlannedTrial> plan = MakePlan(SessionConfig(), inputs);
  for (const char* setting : {"model.mass_scale=2", "imperfections.stiffness_scale=0.5"}) {
    SessionConfig changed;
    ApplySetting(setting, changed);
    const std::vector<PlannedTrial> other = MakePlan(changed, inputs);
    ASSERT_EQ(plan.size(), other.size());
    for (size_t i = 0; i < plan.size(); ++i) {
      EXPECT_NE(plan[i].id, other[i].id);
      const TrialDraw a = MakeTrialSetup(SessionConfig(), inputs, plan[i]).draw;
      const TrialDraw b = MakeTrialSetup(changed, inputs, other[i]).draw;
      EXPECT_EQ(a.offset_x, b.offset_x);
      EXPECT_EQ(a.offset_yaw, b.offset_yaw);
      EXPECT_EQ(a.joint_error, b.joint_error);
    }
  }
}

// Whoever sets them expects something of them; so the session is refused before it begins.
TEST(SessionConfig, SettingsOfSensorsThatAreNotUsedAreTold) {
  using Problem = std::pair<std::string, std::string>;
  EXPECT_EQ(FindProblem({"camera.table_colour=#ff00ff"}),
            Problem("camera.table_colour",
                    "changes nothing while positioning is nominal; set positioning: camera or "
                    "leave it out"));
  EXPECT_EQ(FindProblem({"sensors.noise=0.01"}).first, "sensors.noise");
  EXPECT_EQ(FindProblem({"touch=sensed", "sensors.noise=0.01"}),
            Problem("sensors.threshold",
                    "the elements would respond to their own noise; expected at least five times "
                    "sensors.noise"));
  SessionConfig config;
  for (const char* setting : {"positioning=camera", "camera.table_colour=#ff00ff", "touch=sensed",
                              "sensors.noise=0.01", "sensors.threshold=0.05"}) {
    ApplySetting(setting, config);
  }
  EXPECT_TRUE(Validate(config).empty());
}

TEST(SessionConfig, WrongArmsAreRefusedByName) {
  using Problem = std::pair<std::string, std::string>;
  EXPECT_EQ(FindProblem({"arm.base_x_m=-0.7"}),
            Problem("arm.base_x_m",
                    "changes nothing while arm.model is none; set arm.model or leave it out"));
  EXPECT_EQ(FindProblem({"arm.model=pa10", "arm.base_z_m=-0.1"}),
            Problem("arm.base_z_m",
                    "-0.1: the base would be inside the table, whose top is at 0; expected 0 or "
                    "more"));
  EXPECT_EQ(FindProblem({"arm.model=pa10", "arm.mount=up"}),
            Problem("arm.mount", "no mount \"up\". Known: x, -x, y, -y, z, -z"));
}

TEST(SessionConfig, AFilesGripThatIsNotUsedIsRefusedAtItsLine) {
  EXPECT_TRUE(
      Has(FindProblems("strategy:\n  grip: posture\n  grip_margin: 3\n"),
          "s.yaml:3: error: strategy.grip_margin: has no effect if strategy.grip is posture"));
  EXPECT_TRUE(Has(FindProblems("preset: gentle\nstrategy:\n  grip_margin: 3\n"), "grip_margin"));
  EXPECT_EQ(FindProblems("strategy:\n  grip: margin\n  grip_margin: 3\n  grip_force_n: 1\n"), "");
  EXPECT_EQ(FindProblems("strategy:\n  grip: posture\n  grip_margin: 2\n"), "")
      << "as presets say it";
}

TEST(SessionConfig, TellsEveryProblemOfAFrozenConfiguration) {
  Json json = ToJson(SessionConfig());
  json.erase("seed");
  json["trials"] = 1.5;
  json["hands"] = "tum";
  json["sim"] = Json::array();
  json["more"] = 1;
  EXPECT_EQ(FindError([&] { SessionConfigFromJson(json, "x/session.json"); }),
            "the frozen configuration cannot be read\n"
            "x/session.json: error: hands: expected a list of texts\n"
            "x/session.json: error: trials: expected a whole number\n"
            "x/session.json: error: seed: is missing\n"
            "x/session.json: error: sim.: expected an object of keys and values\n"
            "x/session.json: error: more: unknown key. Known: hands, objects, grasps, "
            "trials, seed, variation, strategy, sim, model, approach, positioning, arm, camera, "
            "touch, sensors, imperfections, policy");
}

TEST(ImperfectionConfigTest, EachOptionChangesItsNumbersAlone) {
  const Hand plain = LoadHand("tum");
  ImperfectionConfig config;
  config.hysteresis = 0.07;
  config.stick_slip = 0.1;
  config.stiffness_scale = 0.5;
  config.coupling_compliance = 0.4;
  Hand hand = plain;
  ApplyImperfections(config, hand);
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    const JointDrive &drive = hand.joints[j].drive, &before = plain.joints[j].drive;
    const bool is_coupled = plain.joints[j].coupled_to >= 0;
    EXPECT_EQ(drive.stiffness, 0.5 * before.stiffness);
    EXPECT_EQ(drive.damping, before.damping);
    EXPECT_EQ(drive.torque_limit, before.torque_limit);
    EXPECT_EQ(drive.hysteresis_width, is_coupled ? 0.0 : 0.07);
    EXPECT_EQ(drive.friction_static, is_coupled ? 0.0 : 0.1 * before.torque_limit);
    EXPECT_EQ(drive.friction_dynamic, 0.6 * drive.friction_static);
    EXPECT_EQ(hand.joints[j].coupling_compliance, is_coupled ? 0.4 : 0.0);
  }
}

TEST(ImperfectionConfigTest, WhatConcernsNoJointIsRefused) {
  ImperfectionConfig yields;
  yields.coupling_compliance = 0.4;
  ImperfectionConfig loop;
  loop.hysteresis = 0.07;
  Hand hand = LoadHand("tum");
  for (HandJoint& joint : hand.joints) joint.coupled_to = -1;
  Hand slides = hand;
  for (HandJoint& joint : slides.joints) joint.is_prismatic = true;
  ApplyImperfections(loop, hand);
  for (const auto& [config, which] : {std::pair(yields, &hand), std::pair(loop, &slides)}) {
    EXPECT_TRUE(Throws([&] { ApplyImperfections(config, *which); }, ErrorKind::kUsage,
                       "has no effect on the hand \"tum\""));
  }
}

SessionInputs LoadWith(const std::vector<std::string>& settings) {
  SessionConfig config;
  config.hands = {"shadow"};
  config.objects = {"can"};
  for (const std::string& setting : settings) ApplySetting(setting, config);
  return LoadSessionInputs(config);
}

TEST(ModelConfig, EachFactorChangesItsNumbersAlone) {
  const SessionInputs plain = LoadWith({});
  const SessionInputs scaled =
      LoadWith({"model.mass_scale=2", "model.friction_scale=0.5", "model.pad_torsion_scale=3",
                "model.pad_stiffness_scale=5", "model.drive_torque_scale=0.25",
                "model.joint_error_scale=4", "model.coupling_rule=even"});
  const GraspObject &can = *plain.objects[0], &other = *scaled.objects[0];
  EXPECT_EQ(other.mass_properties.mass, 2.0 * can.mass_properties.mass);
  EXPECT_EQ(other.mass_properties.I_OOcm, 2.0 * can.mass_properties.I_OOcm);
  EXPECT_EQ(other.mass_properties.p_OOcm, can.mass_properties.p_OOcm);
  EXPECT_EQ(other.surface.friction_static, 0.5 * can.surface.friction_static);
  EXPECT_EQ(other.surface.friction_dynamic, 0.5 * can.surface.friction_dynamic);
  const Hand &hand = *plain.hands[0].hand, &changed = *scaled.hands[0].hand;
  EXPECT_EQ(changed.coupling, CouplingRule::kEven);
  EXPECT_EQ(changed.joint_accuracy, 4.0 * hand.joint_accuracy);
  int num_pads = 0;
  for (size_t i = 0; i < hand.links.size(); ++i) {
    const SoftPad &before = hand.links[i].surface.pad, &after = changed.links[i].surface.pad;
    EXPECT_EQ(changed.links[i].mass, hand.links[i].mass);
    EXPECT_EQ(after.youngs_modulus, 5.0 * before.youngs_modulus);
    EXPECT_EQ(after.depth, before.depth);
    EXPECT_EQ(after.torsion_scale, 3.0);
    if (before.youngs_modulus > 0.0) ++num_pads;
  }
  EXPECT_EQ(num_pads, 17);
  for (size_t i = 0; i < hand.joints.size(); ++i) {
    EXPECT_EQ(changed.joints[i].drive.torque_limit, 0.25 * hand.joints[i].drive.torque_limit);
    EXPECT_EQ(changed.joints[i].drive.stiffness, hand.joints[i].drive.stiffness);
  }
  EXPECT_EQ(LoadWith({"model.coupling_rule=own"}).hands[0].hand->coupling, hand.coupling);
}

/** A data folder of the test's own, with these presets. */
class OwnPresets {
 public:
  OwnPresets() {
    const char* home = std::getenv("GRASPBENCH_HOME");
    if (home) former_ = home;
    MakeFolder(folder());
    ::setenv("GRASPBENCH_HOME", root_.path().c_str(), 1);
  }
  ~OwnPresets() {
    former_.empty() ? ::unsetenv("GRASPBENCH_HOME")
                    : ::setenv("GRASPBENCH_HOME", former_.c_str(), 1);
  }
  std::filesystem::path folder() const { return root_.path() / "datasets" / "presets"; }
  void Add(const std::string& name, const std::string& text) const {
    WriteFileAtomically(folder() / (name + ".yaml"), text);
  }

 private:
  TemporaryFolder root_;
  std::string former_;
};

TEST(Presets, TheBenchmarkIsWrittenOutInFull) {
  const Preset preset = FindPreset("benchmark");
  const YAML::Node root = YAML::LoadFile(preset.file.string());
  for (const std::string& key : ListConfigKeys(SessionConfig())) {
    EXPECT_GT(FindConfigLine(root, key), 0) << key;
  }
}

TEST(Presets, TheBenchmarkIsTodaysDefaults) {
  EXPECT_EQ(FindConfigDifferences(LoadPreset("benchmark"), SessionConfig()),
            std::vector<std::string>());
}

TEST(Presets, FirmIsWhatStoresWithoutAWordOfGripMean) {
  Json silent = ToJson(LoadPreset("firm"));
  EXPECT_FALSE(silent["strategy"].contains("grip"));
  SessionConfig defaults = LoadPreset("people");
  EXPECT_EQ(FindConfigDifferences(defaults, SessionConfig()), std::vector<std::string>());
  defaults.strategy = StrategyConfig();
  EXPECT_EQ(FindConfigDifferences(SessionConfigFromJson(silent), defaults),
            std::vector<std::string>());
}

TEST(Presets, EveryOneCanBeRunAndSaysWhatItIs) {
  ASSERT_FALSE(ListPresets().empty());
  for (const Preset& preset : ListPresets()) {
    EXPECT_TRUE(Validate(LoadPreset(preset.name)).empty()) << preset.name;
    EXPECT_GT(preset.about.size(), 10u) << preset.name;
  }
}

TEST(Presets, ASessionFileChangesWhatItNames) {
  const OwnPresets presets;
  presets.Add("short", "# a quick look\ntrials: 2\nsim: {step_s: 0.004}\n");
  const SessionConfig config =
      ParseSessionConfig("seed: 7\npreset: short\nsim: {hand_friction_static: 0.9}\n", "s.yaml");
  EXPECT_EQ(config.trials, 2);
  EXPECT_EQ(config.seed, 7);
  EXPECT_EQ(config.sim.step, 0.004);
  EXPECT_EQ(config.sim.hand_friction_static, 0.9);
  EXPECT_EQ(config.hands, SessionConfig().hands);
  EXPECT_EQ(ListPresets().front().about, "a quick look");
  // What is frozen is the content: it does not depend on the file any more.
  const Json frozen = ToJson(config);
  EXPECT_FALSE(frozen.contains("preset"));
  presets.Add("short", "trials: 3\n");
  EXPECT_EQ(SessionConfigFromJson(frozen).trials, 2);
}

TEST(Presets, AnUnknownNameHasItsLineAndASuggestion) {
  EXPECT_EQ(FindProblems("trials: 2\npreset: benchmrak\n"),
            "s.yaml:2: error: preset: no preset \"benchmrak\"; did you "
            "mean \"benchmark\"? Known: benchmark, firm, gentle, margin-1.5, margin-2, people");
  EXPECT_TRUE(Has(FindProblems("preset: ../plan/x\n"), "s.yaml:1"));
  EXPECT_TRUE(Has(FindProblems("preset: [benchmark]\n"), "s.yaml:1"));
}

TEST(Presets, FaultsOfAPresetAreToldAtItsOwnLines) {
  const OwnPresets presets;
  presets.Add("broken", "# broken\ntrials: 2\ntrails: 3\nseed: -1\n");
  const std::string fault = FindProblems("preset: broken\n");
  const std::string file = (presets.folder() / "broken.yaml").string();
  EXPECT_TRUE(Has(fault, file + ":3"));
  EXPECT_TRUE(Has(fault, file + ":4"));
  presets.Add("twice", "preset: broken\n");  // none names another, so none names itself
  EXPECT_TRUE(Has(FindProblems("preset: twice\n"), "twice.yaml:1"));
}

}  // namespace

}  // namespace graspbench
