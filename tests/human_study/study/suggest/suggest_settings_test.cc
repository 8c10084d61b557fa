#include "human_study/study/suggest/suggest_settings.h"

#include <gtest/gtest.h>

#include "human_study/study/run/run_study.h"
#include "human_study/study/synthetic/demo_study.h"
#include "tests/human_study/faults.h"
#include "tests/support/mocap_data.h"

namespace graspbench {
namespace {

using SuggestSettingsTest = FolderTest;

std::vector<std::string> ListSettings(const StudySuggestions& suggestions) {
  std::vector<std::string> settings;
  for (const Suggestion& suggestion : suggestions.suggestions) {
    settings.insert(settings.end(), suggestion.settings.begin(), suggestion.settings.end());
  }
  return settings;
}

Study MakeDemo(const std::filesystem::path& folder, const std::vector<std::string>& settings) {
  SyntheticOptions options;
  options.seed = "suggest_settings_test";
  options.num_people = 2;
  options.trials_per_size = 2;
  options.diameters = {0.03, 0.06};
  WriteDemoStudy(MakeSyntheticStudy(options), folder);
  return LoadStudy(folder / "study.yaml", {}, settings);
}

TEST_F(SuggestSettingsTest, AStudyThatIsRightNeedsNothing) {
  const StudySuggestions suggestions = SuggestSettings(MakeDemo(folder_, {"bias_trials=0"}));
  EXPECT_EQ(suggestions.num_kept, suggestions.num_trials);
  EXPECT_TRUE(suggestions.suggestions.empty());
  EXPECT_EQ(suggestions.num_kept_then, suggestions.num_kept);
}

// The demo's z is up.
TEST_F(SuggestSettingsTest, FindsTheLiftsDirectionAndNoOther) {
  const StudySuggestions suggestions =
      SuggestSettings(MakeDemo(folder_, {"lift_off.up_x=0", "lift_off.up_y=1", "lift_off.up_z=0"}));
  EXPECT_EQ(suggestions.num_kept, 0);
  EXPECT_EQ(ListSettings(suggestions),
            (std::vector<std::string>{"lift_off.up_x=0", "lift_off.up_y=0", "lift_off.up_z=1"}));
  EXPECT_EQ(suggestions.num_kept_then, suggestions.num_trials);
}

// From markers and cut alone, following what is printed.
TEST_F(SuggestSettingsTest, TheSharedRecordingGoesFromOneToFourteenOfTwentyOne) {
  GRASPBENCH_REQUIRE_MOCAP(recording, "dfki-hand_embodiment/recording.tsv");
  Write("trials.csv", "participant,file\np1,dfki-hand_embodiment/recording.tsv\n");
  Write("study.yaml",
        "markers:\n  thumb: thumb_tip\n  index: index_tip\n  middle: middle_tip\n"
        "  ring: ring_tip\n  little: little_tip\n  wrist: hand_top\n"
        "  object: [pillow_top, pillow_left, pillow_right]\ncut: {near_m: 0.08, far_m: 0.15}\n");
  Study study = LoadStudy(folder_ / "study.yaml", FindMocapData());
  const StudySuggestions suggestions = SuggestSettings(study);
  EXPECT_EQ(suggestions.num_trials, 21);
  EXPECT_EQ(suggestions.num_kept, 1);
  EXPECT_GE(suggestions.num_kept_then, 14);
  study = LoadStudy(folder_ / "study.yaml", FindMocapData(), ListSettings(suggestions));
  EXPECT_EQ(RunTrials(LeaveOutReport(study)).CountKept(), suggestions.num_kept_then);
  for (const Suggestion& suggestion : suggestions.suggestions) {
    EXPECT_FALSE(suggestion.reason.empty());
    EXPECT_FALSE(suggestion.cost.empty());
  }
}

}  // namespace
}  // namespace graspbench
