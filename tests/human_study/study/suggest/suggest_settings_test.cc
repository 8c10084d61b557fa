#include "human_study/study/suggest/suggest_settings.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "human_study/study/run/run_study.h"
#include "human_study/study/synthetic/demo_study.h"
#include "tests/support/mocap_data.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

fs::path MakeFolderOfTest() {
  const fs::path folder =
      fs::path(::testing::TempDir()) /
      (std::string("suggest_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  fs::remove_all(folder);
  MakeFolder(folder);
  return folder;
}

std::vector<std::string> ListSettings(const StudySuggestions& suggestions) {
  std::vector<std::string> settings;
  for (const Suggestion& suggestion : suggestions.suggestions) {
    settings.insert(settings.end(), suggestion.settings.begin(), suggestion.settings.end());
  }
  return settings;
}

Study MakeDemo(const fs::path& folder, const std::string& settings) {
  SyntheticOptions options;
  options.seed = "suggest_settings_test";
  options.num_people = 2;
  options.trials_per_size = 2;
  options.diameters = {0.03, 0.06};
  WriteDemoStudy(MakeSyntheticStudy(options), folder);
  std::ofstream(folder / "study.yaml", std::ios::app) << settings;
  return LoadStudy(folder / "study.yaml");
}

TEST(SuggestSettings, AStudyThatIsRightNeedsNothing) {
  const StudySuggestions suggestions =
      SuggestSettings(MakeDemo(MakeFolderOfTest(), "bias_trials: 0\n"));
  EXPECT_EQ(suggestions.num_kept, suggestions.num_trials);
  EXPECT_TRUE(suggestions.suggestions.empty());
  EXPECT_EQ(suggestions.num_kept_then, suggestions.num_kept);
}

// The demo's z is up.
TEST(SuggestSettings, FindsTheLiftsDirectionAndNoOther) {
  const fs::path folder = MakeFolderOfTest();
  const StudySuggestions suggestions =
      SuggestSettings(MakeDemo(folder, "lift_off: {up_x: 0, up_y: 1, up_z: 0}\n"));
  EXPECT_EQ(suggestions.num_kept, 0);
  EXPECT_EQ(ListSettings(suggestions),
            (std::vector<std::string>{"lift_off.up_x=0", "lift_off.up_y=0", "lift_off.up_z=1"}));
  EXPECT_EQ(suggestions.num_kept_then, suggestions.num_trials);
  EXPECT_NE(ReadFile(folder / "study.yaml").find("up_y: 1"), std::string::npos)
      << "study.yaml is never changed";
}

// From markers and cut alone, following what is printed.
TEST(SuggestSettings, TheSharedRecordingGoesFromNoneToFourteenOfTwentyOne) {
  GRASPBENCH_REQUIRE_MOCAP(recording, "dfki-hand_embodiment/recording.tsv");
  const fs::path folder = MakeFolderOfTest();
  std::ofstream(folder / "trials.csv")
      << "participant,file\np1,dfki-hand_embodiment/recording.tsv\n";
  std::ofstream(folder / "study.yaml")
      << "markers:\n  thumb: thumb_tip\n  index: index_tip\n  middle: middle_tip\n"
         "  ring: ring_tip\n  little: little_tip\n  wrist: hand_top\n"
         "  object: [pillow_top, pillow_left, pillow_right]\ncut: {near_m: 0.08, far_m: 0.15}\n";
  Study study = LoadStudy(folder / "study.yaml", FindMocapData());
  const StudySuggestions suggestions = SuggestSettings(study);
  EXPECT_EQ(suggestions.num_trials, 21);
  EXPECT_EQ(suggestions.num_kept, 0);
  EXPECT_GE(suggestions.num_kept_then, 14);
  study = LoadStudy(folder / "study.yaml", FindMocapData(), ListSettings(suggestions));
  EXPECT_EQ(RunTrials(LeaveOutReport(study)).CountKept(), suggestions.num_kept_then);
  for (const Suggestion& suggestion : suggestions.suggestions) {
    EXPECT_FALSE(suggestion.reason.empty());
    EXPECT_FALSE(suggestion.cost.empty());
  }
}

}  // namespace
}  // namespace graspbench
