#include "human_study/study/design/study_cutoffs.h"

#include <gtest/gtest.h>

#include "core/base/config.h"

namespace graspbench {
namespace {

StudyConfig Parse(const std::string& text, const std::vector<std::string>& settings = {}) {
  Diagnostics problems;
  const StudyConfig config =
      ParseStudyConfig("markers: {thumb: t, index: i}\n" + text, "study.yaml", problems, settings);
  EXPECT_EQ(problems.num_errors(), 0) << problems.Format();
  return config;
}

TEST(StudyCutoffs, OnlyStatedKeysAreKept) {
  const StudyConfig config = Parse("contact: {cutoff_hz: 20}\n",
                                   {"multiverse.cutoff_hz=[8, 20]", "hold.rule=longest_rest"});
  EXPECT_EQ(config.analysis.stated_cutoffs,
            (std::set<std::string>{"contact.cutoff_hz", "multiverse.cutoff_hz"}));
  EXPECT_TRUE(Parse("opening: {measure: aperture}\n").analysis.stated_cutoffs.empty());
}

TEST(StudyCutoffs, WithoutAnyThatIsStatedEveryRateFits) {
  const StudyConfig config = Parse("");
  for (const double rate : {10.0, 25.0, 30.0, 50.0, 100.0, 240.0}) {
    EXPECT_EQ(FindCutoffFault(config, rate), "") << rate;
  }
  EXPECT_EQ(FitCutoffs(config, 100.0).multiverse.cutoff, config.multiverse.cutoff);
  for (const double cutoff : FitCutoffs(config, 30.0).multiverse.cutoff) EXPECT_LT(cutoff, 12.0);
}

// The filter allows less than 12 Hz at 30 Hz: all keys are named at once, and what is proposed fits.
TEST(StudyCutoffs, AStatedOneThatDoesNotFitIsRefusedWithAProposalThatFits) {
  StudyConfig config = Parse("contact: {cutoff_hz: 15}\nmultiverse: {cutoff_hz: [10, 20]}\n");
  EXPECT_EQ(FindCutoffFault(config, 30.0),
            "contact.cutoff_hz is 15, multiverse.cutoff_hz is 20; this recording of 30 Hz allows "
            "less than 12. Choose a lower one, or leave the key out: the cut-off then follows the "
            "rate");
  const std::vector<std::string> proposed = LowerStatedCutoffs(config, 30.0);
  EXPECT_EQ(proposed.size(), 2u);
  for (const std::string& setting : proposed) SetConfigValue(setting, config);
  EXPECT_EQ(FindCutoffFault(config, 30.0), "");
}

}  // namespace
}  // namespace graspbench
