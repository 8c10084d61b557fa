#include "datasets/plan/presets.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/plan/session_config.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

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

std::string FindPresetFault(const std::string& session) {
  try {
    ParseSessionConfig(session, "s.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

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
}

// What is frozen is the content: it does not depend on the file any more.
TEST(Presets, TheFrozenConfigurationHoldsWhatAPresetContains) {
  const OwnPresets presets;
  presets.Add("short", "trials: 2\n");
  const Json frozen = ToJson(ParseSessionConfig("preset: short\n", "s.yaml"));
  presets.Add("short", "trials: 3\n");
  EXPECT_EQ(frozen, ToJson(ParseSessionConfig("trials: 2\n", "s.yaml")));
  EXPECT_EQ(SessionConfigFromJson(frozen).trials, 2);
  EXPECT_FALSE(frozen.contains("preset"));
}

TEST(Presets, AnUnknownNameHasItsLineAndASuggestion) {
  EXPECT_EQ(FindPresetFault("trials: 2\npreset: benchmrak\n"),
            "the session cannot be run\ns.yaml:2: error: preset: no preset \"benchmrak\"; did you "
            "mean \"benchmark\"? Known: benchmark, firm, gentle, margin-1.5, margin-2, people");
  EXPECT_NE(FindPresetFault("preset: ../plan/x\n").find("s.yaml:1"), std::string::npos);
  EXPECT_NE(FindPresetFault("preset: [benchmark]\n").find("s.yaml:1"), std::string::npos);
}

TEST(Presets, FaultsOfAPresetAreToldAtItsOwnLines) {
  const OwnPresets presets;
  presets.Add("broken", "# broken\ntrials: 2\ntrails: 3\nseed: -1\n");
  const std::string fault = FindPresetFault("preset: broken\n");
  const std::string file = (presets.folder() / "broken.yaml").string();
  EXPECT_NE(fault.find(file + ":3"), std::string::npos) << fault;
  EXPECT_NE(fault.find(file + ":4"), std::string::npos) << fault;
  presets.Add("twice", "preset: broken\n");  // none names another, so none names itself
  EXPECT_NE(FindPresetFault("preset: twice\n").find("twice.yaml:1"), std::string::npos);
}

TEST(Presets, WithoutTheFolderThereAreNone) {
  const OwnPresets presets;
  std::filesystem::remove(presets.folder());
  EXPECT_TRUE(ListPresets().empty());
  EXPECT_NE(FindPresetFault("preset: benchmark\n").find("Known: none"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
