#include "reports/scenes/shown_trials.h"

#include <gtest/gtest.h>

#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

TEST(ShownTrials, AreAllTrialsOfMostSessions) {
  const Session session = MakeSession({"tum"}, {"can", "cup", "mug"}, "g3", 1000);
  const SessionSummary summary = SummariseSession(session);
  for (const CellSummary& cell : summary.cells) {
    EXPECT_EQ(ChooseShownTrials(cell, summary), cell.records);
    EXPECT_TRUE(IsDrawnInFull(cell, summary));
  }
  EXPECT_EQ(DescribeShownTrials(1000, summary.cells[0]), "");
}

TEST(ShownTrials, AreEvenlySpacedInALargeSessionWhichSaysSo) {
  const Session session = MakeSession({"tum", "shadow"}, {"can", "cup"}, "g3", 2000);
  const SessionSummary summary = SummariseSession(session);
  const std::vector<const TrialRecord*> shown = ChooseShownTrials(summary.cells[1], summary);
  ASSERT_EQ(shown.size(), 750u);
  for (size_t i = 0; i < shown.size(); ++i) {
    EXPECT_EQ(shown[i]->plan.trial, static_cast<int>(i * 2000 / 750));
  }
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);
  EXPECT_NE(page.find("750 of 2000 trials, evenly spaced; export/trials.csv has all of them."),
            std::string::npos);
  EXPECT_LT(page.size(), 10'000'000u);
}

TEST(ShownTrials, OfManyCellsTheFirstAreDrawnInFull) {
  std::vector<std::string> objects;
  for (int i = 0; i < 260; ++i) objects.push_back("object" + std::to_string(i));
  const Session session = MakeSession({"tum"}, objects, "g3", 1);
  const SessionSummary summary = SummariseSession(session);
  EXPECT_TRUE(IsDrawnInFull(summary.cells[249], summary));
  EXPECT_FALSE(IsDrawnInFull(summary.cells[250], summary));
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);  // every link to a cell has its place
  EXPECT_NE(page.find("too many conditions for one page"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
