#include "human_study/study/inference/closure_ends.h"

#include <gtest/gtest.h>

#include <cmath>

#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

EventTime MakeEvent(double time) {
  EventTime event;
  event.time = time;
  return event;
}

/** Opened widest at 1 s; the last digit touches `gct` later, the object moves and the tips rest. */
StudyTrial MakeReach(double gct, double moved, double slow) {
  StudyTrial trial;
  TrialAnalysis& analysis = trial.analysis.emplace();
  analysis.closure_start = MakeEvent(1.0);
  analysis.timing_all.gct = gct;
  analysis.object.moved = MakeEvent(moved);
  analysis.hold.time = analysis.hold.begin = slow;
  return trial;
}

TEST(ListClosureEnds, CountsEachEndOverTheTrialsThatHaveIt) {
  std::vector<StudyTrial> trials = {MakeReach(0.2, 1.25, 1.3), MakeReach(0.3, 1.4, kUnset),
                                    MakeReach(0.4, 1.35, 1.7), MakeReach(0.9, 1.9, 1.9)};
  trials.back().removed = "it was cut off";
  const std::vector<ClosureEnd> ends = ListClosureEnds(trials);
  ASSERT_EQ(ends.size(), 3u);
  EXPECT_EQ(ends[0].num_trials, 3);
  EXPECT_NEAR(ends[0].median, 0.3, 1e-12);
  EXPECT_NEAR(ends[0].median_after_contact, 0.0, 1e-12);
  EXPECT_EQ(ends[1].num_trials, 3);  // 0.25, 0.4, 0.35 s; 50, 100 and -50 ms after the last contact
  EXPECT_NEAR(ends[1].median, 0.35, 1e-12);
  EXPECT_NEAR(ends[1].lower_quartile, 0.3, 1e-12);
  EXPECT_NEAR(ends[1].median_after_contact, 0.05, 1e-12);
  EXPECT_EQ(ends[2].num_trials, 2);
  EXPECT_NEAR(ends[2].median, 0.5, 1e-12);
}

TEST(ListClosureEnds, WithoutTrialsNothingIsKnown) {
  for (const ClosureEnd& end : ListClosureEnds({})) {
    EXPECT_EQ(end.num_trials, 0);
    EXPECT_TRUE(std::isnan(end.median));
  }
}

}  // namespace
}  // namespace graspbench
