#include "workbench/tables/schedule_tables.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

Answer<TouchLags> MakeLags(double thumb) {
  TouchLags lags;
  lags.num_trials = 8;
  lags.closing_time = 0.5;
  lags.gft = 0.5 * thumb;
  lags.shares = {{"TH", thumb, thumb, thumb, 0}, {"FF", 0.0, 0.0, 0.0, 0}};
  return lags;
}

TEST(ScheduleTables, ARowASchedulePeopleFirstThenWhatIsMissing) {
  ScheduleComparison comparison;
  comparison.study = "pilot";
  comparison.scale = &kThresholdScales[0];
  ScheduleCell cell;
  cell.of = {"tum", "can", "g3", {"TH", "FF"}, MakeLags(0.2), {{kPeopleLike, "TH does not touch"}}};
  ScheduleRow natural = {kNatural, MakeLags(HUGE_VAL), {}};
  natural.threshold_text = "1.41";
  natural.ratio = 1.0;
  natural.interval = Interval{1.0, 1.0};
  cell.rows = {natural};
  comparison.cells = {cell};
  const std::string text = FormatSchedules(comparison);
  const auto expect = [&](const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is missing in\n" << text;
  };
  expect("FF 0, TH 20 ");
  expect("FF 0, TH never ");
  expect(" 100\n");  // GFT of people [ms]
  expect("0 of 0");
  expect("1.00 (1.00 to 1.00)");
  expect("not compared: can, tum g3, people-like: TH does not touch\n");
}

TEST(ScheduleTables, ThePlanCountsTrialsAndSaysWhatIsMissing) {
  Session session;
  for (const char* grasp : {"g3-natural", "g3-simultaneous", "g30-natural"}) {
    for (int trial = 0; trial < 4; ++trial) {
      session.plan.push_back({"id", "tum", "can", grasp, trial});
    }
  }
  session.plan.push_back({"id", "tum", "cup", "g3-natural", 0});
  SchedulePlan plan;
  plan.session = &session;
  plan.people.cells = {{"tum", "can", "g3", {}, {}, {{kPeopleLike, "TH never touched"}}}};
  const Json json = ToJson(plan);
  ASSERT_EQ(json.size(), 3u);
  EXPECT_EQ(json[0]["trials"], 4);
  EXPECT_EQ(json[1]["trials"], 4);
  EXPECT_EQ(json[1]["missing"], "");
  EXPECT_EQ(json[2]["trials"], 0);
  EXPECT_EQ(json[2]["missing"], "TH never touched");
  const std::string text = FormatSchedulePlan(plan);
  EXPECT_NE(text.find("TH never touched"), std::string::npos) << text;
}

}  // namespace
}  // namespace graspbench
