#include "human_study/study/run/trial_removal.h"

#include <gtest/gtest.h>

#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

TEST(FindRemoval, ADoubtAboutTheTrialComesBeforeWhatItExplains) {
  TrialAnalysis analysis;
  analysis.movement.onset = MissingEvent("it never moves");
  analysis.trial_doubts = {{"carried_unseen", "the hand carried it"}};
  analysis.doubts = analysis.trial_doubts;
  EXPECT_EQ(FindRemoval(analysis, {}).code, "carried_unseen");
  RemovalConfig lenient;
  lenient.implausible = false;
  EXPECT_EQ(FindRemoval(analysis, lenient).code, "no_onset");
}

TEST(GroupRemoved, TextsThatDifferInNumbersAreOneReason) {
  std::vector<StudyTrial> trials(4);
  const char* texts[] = {"late by 3 ms", "", "late by 4.5 ms", "hidden"};
  for (size_t i = 0; i < 4; ++i) {
    trials[i].id = std::to_string(i);
    trials[i].removed = texts[i];
  }
  const std::vector<RemovalGroup> groups = GroupRemoved(trials);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].text, "late by 3..4.5 ms");
  EXPECT_EQ(groups[0].trials, (std::vector<std::string>{"0", "2"}));
  EXPECT_EQ(groups[1].text, "hidden");
}

TEST(MergeNumbers, GivesTheRangeOfWhatDiffersAndKeepsTheRest) {
  EXPECT_EQ(MergeNumbers({"10 mm away (at most 20).", "9.5 mm away (at most 20).",
                          "31 mm away (at most 20)."}),
            "9.5..31 mm away (at most 20).");
  EXPECT_EQ(MergeNumbers({"are 5.2e-05 m apart", "are 7e-06 m apart", "are 0.001 m apart"}),
            "are 7e-06..0.001 m apart");
  EXPECT_EQ(MergeNumbers({"trial-3.c3d: 7 frames", "trial-12.c3d: 7 frames"}),
            "trial-\u2026.c\u2026d: 7 frames");
  EXPECT_EQ(MergeNumbers({"trial-3.c3d: cut", "trial-3.c3d: cut"}), "trial-3.c3d: cut");
}

}  // namespace
}  // namespace graspbench
