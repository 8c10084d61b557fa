#include "datasets/analysis/grasp_course.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

// FF touches at 0.4, TH at 0.5, MF at 0.6 s in every trial.
TEST(GraspCourse, GapIsTheMeanOverTrialsInWhichBothTouched) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  session.records[0].result.contacts[1].time += 0.1;
  session.records[2].result.contacts[0].time = std::nan("");
  const CellSummary cell = SummariseSession(session).cells.at(0);
  EXPECT_NEAR(CalcContactGap(cell, "FF", "MF"), 0.25, 1e-12);
  EXPECT_NEAR(CalcContactGap(cell, "MF", "FF"), 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(CalcContactGap(cell, "FF", "LF")));
}

TEST(GraspCourse, FirstTouchesAreCountedByDigit) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 4);
  session.records[1].result.contacts[2].time = 0.1;  // the thumb
  for (DigitContact& contact : session.records[2].result.contacts) contact.time = std::nan("");
  const CellSummary cell = SummariseSession(session).cells.at(0);
  const std::map<std::string, int> expected = {{"FF", 2}, {"TH", 1}};
  EXPECT_EQ(CountFirstTouches(cell), expected);
  EXPECT_EQ(FindFirstDigit(cell), "FF");
  EXPECT_EQ(FindFirstDigit(CellSummary()), "");
}

}  // namespace
}  // namespace graspbench
