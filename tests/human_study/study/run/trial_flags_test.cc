#include "human_study/study/run/trial_flags.h"

#include <gtest/gtest.h>

#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

TEST(TrialFlags, AreCountedOverTheTrialsThatCount) {
  StudyResult result;
  result.trials.resize(4);
  for (StudyTrial& trial : result.trials) trial.analysis.emplace();
  result.trials[0].analysis->used_filled = true;
  result.trials[1].analysis->used_filled = true;
  result.trials[1].analysis->used_gap = true;
  result.trials[2].analysis->used_filled = true;
  result.trials[2].removed = "no contact";
  EXPECT_EQ(FormatFlags(*result.trials[1].analysis), "filled, gap");
  EXPECT_EQ(FormatFlags(*result.trials[3].analysis), "");
  for (const FlagCount& counted : CountFlags(result)) {
    const std::string name = counted.flag->name;
    EXPECT_EQ(counted.count, name == "filled" ? 2 : name == "gap" ? 1 : 0) << name;
    EXPECT_DOUBLE_EQ(counted.share, counted.count / 3.0) << name;
  }
}

// The one to begin with has no flag and a usual GFT.
TEST(FindGoodTrial, IsWithoutFlagAndNearTheMedian) {
  StudyResult result;
  EXPECT_EQ(FindGoodTrial(result), nullptr);
  const double gfts[] = {0.01, 0.03, 0.0325, 0.2, 0.031};
  for (const double gft : gfts) {
    StudyTrial trial;
    trial.id = std::to_string(result.trials.size());
    trial.analysis.emplace();
    trial.analysis->timing.gft = gft;
    result.trials.push_back(trial);
  }
  result.trials[4].analysis->used_gap = true;  // the median itself, but in a gap
  EXPECT_EQ(FindGoodTrial(result)->id, "1");
  result.trials[1].removed = "late";
  EXPECT_EQ(FindGoodTrial(result)->id, "2");
}

TEST(TrialFlags, RoughTouchesAndFilteredExportsAreFlagged) {
  TrialAnalysis analysis;
  DigitContactEvents& digit = analysis.contacts.emplace_back();
  digit.contact.time = 1.0;
  digit.contact.uncertainty = 0.0101;
  digit.is_verified = true;
  analysis.num_touching = 1;
  EXPECT_EQ(FormatFlags(analysis), "");
  digit.contact.uncertainty = 0.0103;  // 1.96 times that is more than 20 ms
  EXPECT_EQ(FormatFlags(analysis), "uncertain touch");
  analysis.low_pass = 6.0;
  EXPECT_EQ(FormatFlags(analysis), "uncertain touch, filtered export");
}

}  // namespace
}  // namespace graspbench
