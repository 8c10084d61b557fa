#include "datasets/plan/session_config.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
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

std::string FindSettingProblem(const std::string& assignment) {
  SessionConfig config;
  try {
    ApplySetting(assignment, config);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUsage);
    return e.what();
  }
  return "";
}

TEST(SessionConfig, NoKeyLacksItsMeaning) {
  for (const FileKey& row : ListSessionKeys()) {
    EXPECT_NE(row.meaning, "") << row.key;
    EXPECT_EQ(row.fallback.empty(), row.key == "preset") << row.key;
  }
  const FileKey* step = FindFileKey(ListSessionKeys(), "sim.step_s");
  ASSERT_NE(step, nullptr);
  EXPECT_EQ(step->fallback, "0.002");
  EXPECT_EQ(FormatRange(*step), "0.0001 to 0.01");
}

TEST(SessionConfig, DefaultsAreTheBenchmark) {
  const SessionConfig config = ParseSessionConfig("# only a comment\n", "s.yaml");
  EXPECT_EQ(config.hands, (std::vector<std::string>{"tum", "shadow"}));
  EXPECT_EQ(config.objects, std::vector<std::string>{"all"});
  EXPECT_EQ(config.grasps, std::vector<std::string>{"best"});
  EXPECT_EQ(config.trials, 10);
  EXPECT_TRUE(Validate(config).empty());
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
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nis not in\n" << text;
  }
}

TEST(SessionConfig, TellsBrokenYaml) {
  EXPECT_EQ(FindProblems("hands: [tum\ntrials: 3\n").substr(0, 33),
            "s.yaml:2: error: not valid YAML: ");
  EXPECT_EQ(FindProblems("- tum\n"), "s.yaml:1: error: session: expected a map of keys and values");
  EXPECT_EQ(FindProblems("trials: [1, 2]\n"),
            "s.yaml:1: error: session, trials: expected a whole number");
  EXPECT_EQ(FindProblems("hands: {tum: 1}\n"),
            "s.yaml:1: error: session, hands: expected a list of texts");
  EXPECT_EQ(FindProblems("hands: ''\n"), "s.yaml:1: error: hands: a name is empty");
  EXPECT_EQ(FindProblems("sim: {step_s: .nan}\n"),
            "s.yaml:1: error: sim, step_s: expected a finite number");
}

TEST(SessionConfig, EveryNumberHasARange) {
  for (const std::string& key : ListConfigKeys(SessionConfig())) {
    if (key == "hands" || key == "objects" || key == "grasps") continue;
    if (key == "camera.shadows") continue;  // no number
    SessionConfig config;
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
  try {
    CheckSessionConfig(config);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kRange);
    EXPECT_STREQ(e.what(),
                 "the session cannot be run\n"
                 "trials: -5 is out of range; expected 1 to 100000\n"
                 "sim.step_s: nan is out of range; expected 0.0001 to 0.01\n"
                 "strategy.stabilisation_min_time_s: must not be longer than "
                 "strategy.stabilisation_max_time_s\n"
                 "sim.table_friction_dynamic: must not be higher than sim.table_friction_static");
  }
}

TEST(SessionConfig, AppliesSettings) {
  SessionConfig config;
  ApplySetting("sim.step_s=0.001", config);
  ApplySetting("trials = 3", config);
  ApplySetting("hands=shadow, tum", config);
  ApplySetting("objects=[\"a,b\"]", config);
  EXPECT_EQ(config.sim.step, 0.001);
  EXPECT_EQ(config.trials, 3);
  EXPECT_EQ(config.hands, (std::vector<std::string>{"shadow", "tum"}));
  EXPECT_EQ(config.objects, std::vector<std::string>{"a,b"});
  EXPECT_EQ(config.sim.contact_stiffness, SessionConfig().sim.contact_stiffness);
}

TEST(SessionConfig, TellsWrongSettings) {
  EXPECT_EQ(FindSettingProblem("trials"),
            "--set \"trials\": expected KEY=VALUE, for example hands=...");
  EXPECT_EQ(FindSettingProblem("sim.stp_s=1"),
            "--set \"sim.stp_s=1\": no setting \"sim.stp_s\"; did you mean \"sim.step_s\"?");
  EXPECT_EQ(FindSettingProblem("sim={}").substr(0, 39),
            "--set \"sim={}\": no setting \"sim\". Known");
  EXPECT_EQ(FindSettingProblem("trials="), "--set \"trials=\": the value is missing");
  EXPECT_EQ(FindSettingProblem("trials=ten"),
            "--set \"trials=ten\": setting, trials: expected a whole number");
  EXPECT_NE(FindSettingProblem("hands=[tum").find("not a YAML value"), std::string::npos);
}

TEST(SessionConfig, TheFrozenConfigurationIsCompleteAndReadsBack) {
  SessionConfig config;
  config.seed = 7;
  config.variation.yaw = 0.1 + 0.2;
  config.hands = {"../a \"hand\"", "tum"};
  config.approach = "side";
  config.positioning = "camera";
  config.touch = "sensed";
  config.imperfections.stick_slip = 0.1;
  config.strategy.grip = "margin";  // what a firm grip does not say is not frozen (firm_grip.h)
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

// Sessions of earlier versions stay readable and keep their names.
TEST(SessionConfig, AnAutomaticApproachIsNotWritten) {
  Json json = ToJson(SessionConfig());
  EXPECT_FALSE(json.contains("approach"));
  EXPECT_EQ(SessionConfigFromJson(json).approach, "automatic");
  json["approach"] = "above";
  EXPECT_EQ(SessionConfigFromJson(json).approach, "above");
}

// Likewise; and a session that does not look does not depend on its camera.
TEST(SessionConfig, NominalPositioningIsNotWritten) {
  SessionConfig config;
  config.camera.noise = 7.0;
  EXPECT_EQ(ToJson(config), ToJson(SessionConfig()));
  config.positioning = "true";
  EXPECT_FALSE(ToJson(config).contains("camera"));
  EXPECT_EQ(SessionConfigFromJson(ToJson(config)).positioning, "true");
  config.positioning = "camera";
  EXPECT_EQ(SessionConfigFromJson(ToJson(config)).camera.noise, 7.0);
  config.positioning = "nominal";
  config.grasps = {"g1", "by-sight"};
  EXPECT_EQ(SessionConfigFromJson(ToJson(config)).camera.noise, 7.0);
  EXPECT_TRUE(Validate(config).empty());
  EXPECT_EQ(SessionConfigFromJson(ToJson(SessionConfig())).positioning, "nominal");
}

TEST(SessionConfig, ExactTouchIsNotWritten) {
  SessionConfig config;
  config.sensors.noise = 0.5;
  EXPECT_EQ(ToJson(config), ToJson(SessionConfig()));
  config.touch = "sensed";
  EXPECT_EQ(SessionConfigFromJson(ToJson(config)).sensors.noise, 0.5);
  EXPECT_EQ(SessionConfigFromJson(ToJson(config)).touch, "sensed");
  EXPECT_EQ(SessionConfigFromJson(ToJson(SessionConfig())).touch, "exact");
  ApplySetting("touch=sense", config);
  const auto problems = Validate(config);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].text, "no touch \"sense\"; did you mean \"sensed\"? Known: exact, sensed");
}

// Whoever sets them expects something of them; so the session is refused before it begins.
TEST(SessionConfig, SettingsOfSensorsThatAreNotUsedAreTold) {
  SessionConfig config;
  ApplySetting("camera.table_colour=#ff00ff", config);
  ApplySetting("sensors.noise=0.01", config);
  EXPECT_EQ(config.camera.table_colour, "#ff00ff");
  const auto problems = Validate(config);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].key, "camera.table_colour");
  EXPECT_EQ(
      problems[0].text,
      "changes nothing while positioning is nominal; set positioning: camera or leave it out");
  EXPECT_EQ(problems[1].key, "sensors.noise");
  ApplySetting("positioning=camera", config);
  ApplySetting("touch=sensed", config);
  const auto noisy = Validate(config);
  ASSERT_EQ(noisy.size(), 1u);
  EXPECT_EQ(noisy[0].key, "sensors.threshold");
  EXPECT_EQ(noisy[0].text,
            "the elements would feel their own noise; expected at least five times sensors.noise");
  ApplySetting("sensors.threshold=0.05", config);
  EXPECT_TRUE(Validate(config).empty());
}

TEST(SessionConfig, AFilesGripThatIsNotUsedIsRefusedAtItsLine) {
  const auto read = [](const std::string& text) -> std::string {
    try {
      ParseSessionConfig(text, "mine.yaml");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(read("strategy:\n  grip: posture\n  grip_margin: 3\n")
                .find("mine.yaml:3: error: strategy.grip_margin: has no use where strategy.grip is "
                      "posture"),
            std::string::npos)
      << read("strategy:\n  grip: posture\n  grip_margin: 3\n");
  EXPECT_NE(read("preset: gentle\nstrategy:\n  grip_margin: 3\n").find("grip_margin"),
            std::string::npos);
  EXPECT_EQ(read("strategy:\n  grip: margin\n  grip_margin: 3\n  grip_force_n: 1\n"), "");
  EXPECT_EQ(read("strategy:\n  grip: posture\n  grip_margin: 2\n"), "") << "as presets say it";
}

TEST(SessionConfig, AnUnknownPositioningOrColourIsRefused) {
  SessionConfig config;
  ApplySetting("positioning=camra", config);
  ApplySetting("camera.table_colour=green", config);
  const auto problems = Validate(config);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].text,
            "no positioning \"camra\"; did you mean \"camera\"? Known: nominal, true, camera");
  EXPECT_EQ(problems[1].key, "camera.table_colour");
  EXPECT_EQ(problems[1].text, "\"green\" is no colour; expected one as \"#b4509b\"");
}

TEST(SessionConfig, AnUnknownApproachIsRefused) {
  SessionConfig config;
  ApplySetting("approach=sied", config);
  const auto problems = Validate(config);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "approach");
  EXPECT_EQ(problems[0].text,
            "no approach \"sied\"; did you mean \"side\"? Known: automatic, above, side");
}

TEST(SessionConfig, TellsEveryProblemOfAFrozenConfiguration) {
  Json json = ToJson(SessionConfig());
  json.erase("seed");
  json["trials"] = 1.5;
  json["hands"] = "tum";
  json["sim"] = Json::array();
  json["more"] = 1;
  try {
    SessionConfigFromJson(json, "x/session.json");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kFormat);
    EXPECT_STREQ(e.what(),
                 "the frozen configuration cannot be read\n"
                 "x/session.json: error: hands: expected a list of texts\n"
                 "x/session.json: error: trials: expected a whole number\n"
                 "x/session.json: error: seed: is missing\n"
                 "x/session.json: error: sim.: expected an object of keys and values\n"
                 "x/session.json: error: more: unknown key. Known: hands, objects, grasps, "
                 "trials, seed, variation, strategy, sim, model, approach, positioning, camera, "
                 "touch, sensors, imperfections");
  }
}

}  // namespace
}  // namespace graspbench
