#include "reports/people_and_robots.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

Answer<TouchLags> MakeLags(double thumb) {
  TouchLags lags;
  lags.num_trials = 8;
  lags.closing_time = 0.5;
  lags.gft = thumb * lags.closing_time;
  lags.shares = {{"FF", 0.0, 0.0, 0.0, 0}, {"TH", thumb, thumb, thumb + 0.1, 0}};
  return lags;
}

ScheduleComparison MakeComparison() {
  ScheduleComparison comparison;
  comparison.study = "pilot";
  comparison.scale = &kThresholdScales[0];
  ScheduleCell cell;
  cell.of = {"a hand", "a cup", "g3", {"FF", "TH"}, MakeLags(0.123), {}};
  cell.of.missing[kPeopleLike] = "its lags deviate by 30 ms";
  ScheduleRow natural = {kNatural, MakeLags(0.3), {}};
  natural.threshold_text = "1.41";
  natural.num_pairs = 8;
  natural.ratio = 1.0;
  ScheduleRow simultaneous = {kSimultaneous, MakeLags(0.0), {}};
  simultaneous.threshold_text = "2.00";
  simultaneous.num_pairs = 8;
  simultaneous.ratio = 1.25;
  simultaneous.interval = Interval{1.09, 1.41};
  cell.rows = {natural, simultaneous};
  comparison.cells = {cell};
  return comparison;
}

std::string ShowText(const Html& html) {
  tinyxml2::XMLDocument document;
  const std::string page = "<div>" + html.markup() + "</div>";
  EXPECT_EQ(document.Parse(page.c_str()), tinyxml2::XML_SUCCESS);
  return ListText(*document.RootElement());
}

TEST(PeopleAndRobots, PeopleStandBesideEachScheduleWithWhatItCosts) {
  const std::string text = ShowText(DrawPeopleAndRobots(MakeComparison(), {}));
  ExpectParts(text, {"12.3 (12.3 to 22.3)", "30.0 (30.0 to 40.0)", "1.25 (1.09 to 1.41)", "1.41",
                     "People: pilot.", "people-like: its lags deviate by 30 ms"});
}

TEST(PeopleAndRobots, ADigitThatNeverTouchesIsSaidAndNotDrawn) {
  ScheduleComparison comparison = MakeComparison();
  TouchLags lags = *comparison.cells[0].rows[1].lags;
  lags.shares[1] = {"TH", 0.1, HUGE_VAL, HUGE_VAL, 5};
  lags.gft = HUGE_VAL;
  comparison.cells[0].rows[1].lags = lags;
  const Html html = DrawPeopleAndRobots(comparison, {});
  ExpectParts(ShowText(html), {"never (10.0 to never), 5 of 8 never"});
  EXPECT_EQ(html.markup().find("inf"), std::string::npos);
  EXPECT_EQ(html.markup().find("nan"), std::string::npos);
}

TEST(PeopleAndRobots, WhatIsNotComparedHasItsReasonAndWithoutSchedulesTheCommand) {
  ScheduleComparison comparison = MakeComparison();
  comparison.cells[0].of.people = NoAnswer{"people grasped no a cup"};
  comparison.cells[0].rows[0].lags = NoAnswer{"there is no trial"};
  const std::string text = ShowText(DrawPeopleAndRobots(comparison, {}));
  ExpectParts(text, {"people: people grasped no a cup", "natural: there is no trial"});
  ExpectParts(ShowText(DrawSchedules({}, {}, "results/pilot")),
              {"graspbench simultaneity results/pilot --schedules --people STUDY"});
}

}  // namespace
}  // namespace graspbench
