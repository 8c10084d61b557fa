#include "datasets/analysis/schedules/schedule_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

constexpr int kTrials = 8;

/** Of the tum on a can. @param late  the thumb after the other digits [s]. */
void AddSchedule(const std::string& grasp, double late, Session& session) {
  Session part = MakeSession({"tum"}, {"can"}, grasp, kTrials);
  for (size_t i = 0; i < part.records.size(); ++i) {
    TrialRecord& record = part.records[i];
    record.result.contacts = {{"FF", false, 0.4}, {"MF", false, 0.4}, {"TH", true, 0.4 + late}};
    record.plan.id = part.plan[i].id += grasp;
    session.plan.push_back(part.plan[i]);
    session.records.push_back(record);
  }
}

Session MakeScheduled() {
  Session session;
  AddSchedule("g3-natural", 0.1, session);
  AddSchedule("g3-simultaneous", 0.0, session);
  AddSchedule("g3-people-like", 0.4, session);
  return session;
}

/** Of the k-th draw 1 + k, times the factor. */
ThresholdSummary MakeThresholds(const Session& session,
                                const std::map<std::string, double>& factors) {
  ThresholdSummary summary;
  summary.scale = &kThresholdScales[0];
  for (const PlannedTrial& planned : session.plan) {
    DrawThreshold draw;
    draw.draw = planned;
    draw.value = factors.at(planned.grasp) * (1.0 + planned.trial);
    summary.draws.push_back(draw);
  }
  for (const auto& [grasp, factor] : factors) {
    CellThreshold cell;
    cell.hand = "tum";
    cell.object = "can";
    cell.grasp = grasp;
    cell.num_draws = kTrials;
    cell.median = 4.5 * factor;
    summary.cells.push_back(cell);
  }
  return summary;
}

PeopleFile MakePeopleFile() {
  std::vector<TrialTouches> people;
  for (int k = 0; k < 5; ++k) {
    people.push_back({"can", 1.0, {{"TH", true, 1.3}, {"FF", false, 1.24}, {"MF", false, 1.27}}});
  }
  const std::vector<std::string> digits = {"FF", "MF", "TH"};
  return {"pilot", {{"tum", "can", "g3", digits, SummarisePeople(people, "can", digits), {}}}};
}

TEST(ScheduleComparison, AGraspsIdSaysItsSchedule) {
  EXPECT_EQ(SplitSchedule("g3-people-like").grasp, "g3");
  EXPECT_EQ(SplitSchedule("g3-people-like").schedule, kPeopleLike);
  EXPECT_EQ(SplitSchedule("new-target-natural").grasp, "new-target");
  EXPECT_EQ(SplitSchedule("g3").schedule, kNatural);
  EXPECT_EQ(SplitSchedule("-natural").grasp, "-natural");
}

TEST(ScheduleComparison, IdenticalSchedulesCostNothingAndAPlantedCostComesBack) {
  const Session session = MakeScheduled();
  const ThresholdSummary thresholds = MakeThresholds(
      session, {{"g3-natural", 1.0}, {"g3-simultaneous", 1.0}, {"g3-people-like", 1.5}});
  const ScheduleComparison found = CompareSchedules(session, MakePeopleFile(), {thresholds});
  ASSERT_EQ(found.cells.size(), 1u);
  EXPECT_EQ(found.study, "pilot");
  ASSERT_TRUE(found.cells[0].of.people);
  EXPECT_NEAR(found.cells[0].of.people->Of("TH").median, 0.2, 1e-12);  // 60 of 300 ms
  const std::vector<ScheduleRow>& rows = found.cells[0].rows;
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].schedule, kNatural);
  EXPECT_NEAR(rows[0].lags->Of("TH").median, 0.1 / 0.5, 1e-12);
  EXPECT_NEAR(rows[1].lags->Of("TH").median, 0.0, 1e-12);
  EXPECT_NEAR(rows[2].lags->Of("TH").median, 0.4 / 0.8, 1e-12);
  EXPECT_NEAR(rows[2].lags->gft, 0.4, 1e-12);
  const double ratios[] = {1.0, 1.0, 1.5};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rows[i].num_pairs, kTrials);
    EXPECT_EQ(rows[i].ratio, ratios[i]);
    ASSERT_TRUE(rows[i].interval);
    EXPECT_EQ(rows[i].interval->low, ratios[i]);
    EXPECT_EQ(rows[i].interval->high, ratios[i]);
    EXPECT_EQ(rows[i].tally.successes(), kTrials);
  }
  EXPECT_EQ(rows[2].threshold, 6.75);
}

TEST(ScheduleComparison, ADrawThatNoGripHeldKeepsItsPlace) {
  const Session session = MakeScheduled();
  ThresholdSummary thresholds = MakeThresholds(
      session, {{"g3-natural", 1.0}, {"g3-simultaneous", 1.0}, {"g3-people-like", 1.0}});
  for (DrawThreshold& draw : thresholds.draws) {
    // The first never holds, the others do not under people-like.
    if (draw.draw.trial == 0 || draw.draw.grasp == "g3-people-like") draw.value = HUGE_VAL;
  }
  const ScheduleComparison found = CompareSchedules(session, {}, {thresholds});
  const std::vector<ScheduleRow>& rows = found.cells[0].rows;
  EXPECT_EQ(rows[1].num_pairs, kTrials);
  EXPECT_EQ(rows[1].num_not_known, 1);  // never under either
  EXPECT_EQ(rows[1].ratio, 1.0);
  EXPECT_TRUE(std::isinf(rows[2].ratio));
  EXPECT_TRUE(std::isinf(rows[2].interval->low));
  EXPECT_FALSE(found.cells[0].of.people);
}

// The least grip holds most draws under both: either may need less, so 1 is not their ratio.
TEST(ScheduleComparison, DrawsAtTheEndOfTheScaleHaveNoRatio) {
  const Session session = MakeScheduled();
  ThresholdSummary thresholds = MakeThresholds(
      session, {{"g3-natural", 1.0}, {"g3-simultaneous", 1.0}, {"g3-people-like", 1.0}});
  for (DrawThreshold& draw : thresholds.draws) draw.found.is_below_range = draw.draw.trial < 5;
  const ScheduleCell cell = CompareSchedules(session, {}, {thresholds}).cells[0];
  EXPECT_EQ(cell.rows[2].num_not_known, 5);
  EXPECT_TRUE(std::isnan(cell.rows[2].ratio));
  EXPECT_FALSE(cell.rows[2].interval);
  ASSERT_EQ(DescribeUnknown(cell).size(), 2u);
  EXPECT_EQ(DescribeUnknown(cell)[0],
            "simultaneous: in 5 of 8 draws the least grip of the scale holds here and under "
            "natural, or none does: such draws have no ratio");
}

TEST(ScheduleComparison, AScheduleThatMakesContactsNoMoreSimultaneousIsNamed) {
  Session session;
  AddSchedule("g3-natural", 0.1, session);
  AddSchedule("g3-simultaneous", 0.12, session);
  const std::vector<std::string> texts =
      DescribeUnknown(CompareSchedules(session, {}, {}).cells[0]);
  ASSERT_EQ(texts.size(), 1u);
  EXPECT_EQ(texts[0],
            "simultaneous: GFT is not smaller over the draws (120 ms, natural 100 ms): what it "
            "costs says nothing of simultaneity");
}

TEST(ScheduleComparison, AnObjectThatPeopleDidNotGraspIsNamedWithTheirs) {
  const std::vector<TrialTouches> people = {{"cylinder_30mm", 1.0, {{"TH", true, 1.3}}},
                                            {"ball", 1.0, {{"TH", true, 1.3}}}};
  EXPECT_EQ(SummarisePeople(people, "can", {"TH"}).reason(),
            "people grasped no can in a trial that counts, but ball, cylinder_30mm");
}

TEST(ScheduleComparison, WhatPeopleDidIsReadBackAndDamageIsRefused) {
  PeopleFile people = MakePeopleFile();
  people.cells.push_back(
      {"tum", "cup", "g1", {"FF"}, NoAnswer{"no cup"}, {{kPeopleLike, "no cup"}}});
  const Json json = ToJson(people);
  const PeopleFile read = PeopleFileFromJson(json, "people.json");
  EXPECT_EQ(ToJson(read), json);
  EXPECT_EQ(read.Find("tum", "cup", "g1")->people.reason(), "no cup");
  EXPECT_EQ(read.Find("tum", "cup", "g3"), nullptr);
  Json damaged = json;
  damaged["cells"][0].erase("digits");
  EXPECT_THROW(PeopleFileFromJson(damaged, "people.json"), Error);
  EXPECT_THROW(PeopleFileFromJson(Json(), "people.json"), Error);
}

TEST(ScheduleComparison, ASessionInNoFolderHasNone) {
  EXPECT_TRUE(LoadSchedules(MakeScheduled()).empty());
}

}  // namespace
}  // namespace graspbench
