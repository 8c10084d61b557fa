#include "datasets/analysis/schedules/schedule_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

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
    people.push_back({"can", 1.0, {{"TH", true, 1.3}, {"FF", false, 1.15}, {"MF", false, 1.17}}});
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
  EXPECT_NEAR(found.cells[0].of.people->Of("TH").median, 0.5, 1e-12);  // 150 of 300 ms
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
    EXPECT_EQ(rows[i].missed, "");
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
  const ScheduleComparison found = CompareSchedules(session, MakePeopleFile(), {thresholds});
  const std::vector<ScheduleRow>& rows = found.cells[0].rows;
  EXPECT_EQ(rows[1].num_pairs, kTrials);
  EXPECT_EQ(rows[1].num_not_known, 1);  // never under either
  EXPECT_EQ(rows[1].ratio, 1.0);
  EXPECT_TRUE(std::isinf(rows[2].ratio));
  EXPECT_TRUE(std::isinf(rows[2].interval->low));
}

// The least grip holds most draws under both: either may need less, so 1 is not their ratio.
TEST(ScheduleComparison, DrawsAtTheEndOfTheScaleHaveNoRatio) {
  const Session session = MakeScheduled();
  ThresholdSummary thresholds = MakeThresholds(
      session, {{"g3-natural", 1.0}, {"g3-simultaneous", 1.0}, {"g3-people-like", 1.0}});
  for (DrawThreshold& draw : thresholds.draws) draw.found.is_below_range = draw.draw.trial < 5;
  const ScheduleCell cell = CompareSchedules(session, MakePeopleFile(), {thresholds}).cells[0];
  EXPECT_EQ(cell.rows[2].num_not_known, 5);
  EXPECT_TRUE(std::isnan(cell.rows[2].ratio));
  EXPECT_FALSE(cell.rows[2].interval);
  ASSERT_EQ(DescribeUnknown(cell).size(), 2u);
  EXPECT_EQ(DescribeUnknown(cell)[0],
            "simultaneous: 5 of 8 draws have no ratio, because the smallest grip succeeds under "
            "both schedules or no grip does");
}

// Closing takes 400 ms and the lag: 40 of 440 ms is within 10 %, 50 of 450 ms is not. People's
// thumb comes at half of the closing time.
TEST(ScheduleComparison, AScheduleThatMissesItsLabelIsNamedAndComparedWithNothing) {
  for (const double late : {0.04, 0.05}) {
    Session session;
    AddSchedule("g3-natural", 0.1, session);
    AddSchedule("g3-simultaneous", late, session);
    AddSchedule("g3-people-like", late, session);
    const ThresholdSummary thresholds = MakeThresholds(
        session, {{"g3-natural", 1.0}, {"g3-simultaneous", 2.0}, {"g3-people-like", 2.0}});
    const ScheduleCell cell = CompareSchedules(session, MakePeopleFile(), {thresholds}).cells[0];
    const std::vector<std::string> texts = DescribeUnknown(cell);
    EXPECT_EQ(texts.back(),
              late < 0.045
                  ? "people-like: does not match its label and is not compared: TH touches at 9 % "
                    "of the closing time, people's at 50 %, at most 10 points apart allowed"
                  : "people-like: does not match its label and is not compared: TH touches at 11 % "
                    "of the closing time, people's at 50 %, at most 10 points apart allowed");
    EXPECT_TRUE(std::isnan(cell.rows[2].ratio));
    EXPECT_EQ(cell.rows[2].num_pairs, 0);
    if (late < 0.045) {
      EXPECT_EQ(texts.size(), 1u);
      EXPECT_EQ(cell.rows[1].ratio, 2.0);
      continue;
    }
    ASSERT_EQ(texts.size(), 2u);
    EXPECT_EQ(texts[0],
              "simultaneous: does not match its label and is not compared: GFT is 50 ms, 11 % of "
              "the closing time, at most 10 % allowed");
    EXPECT_TRUE(std::isnan(cell.rows[1].ratio));
  }
  Session alone;
  AddSchedule("g3-natural", 0.1, alone);
  AddSchedule("g3-people-like", 0.1, alone);
  EXPECT_NE(CompareSchedules(alone, {}, {}).cells[0].rows[1].missed.find("without participants"),
            std::string::npos);
}

TEST(ScheduleComparison, AnObjectThatPeopleDidNotGraspIsNamedWithTheirs) {
  const std::vector<TrialTouches> people = {{"cylinder_30mm", 1.0, {{"TH", true, 1.3}}},
                                            {"ball", 1.0, {{"TH", true, 1.3}}}};
  EXPECT_EQ(SummarisePeople(people, "can", {"TH"}).reason(),
            "people grasped no can in an included trial, but ball, cylinder_30mm");
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

const std::vector<std::string> kDigits = {"TH", "FF", "MF"};

/** Trials that differ in clock and closing time; their digits touch at these shares of it, give or
take a scatter that is symmetric over the trials. */
std::vector<TrialTouches> MakeTrials(const std::map<std::string, double>& shares, int count,
                                     double scatter) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> clock(1.0, 9.0), closing(0.2, 0.5);
  double latest = 0.0;
  for (const auto& [digit, share] : shares) latest = std::max(latest, share);
  std::vector<TrialTouches> trials;
  for (int k = 0; k < count; ++k) {
    TrialTouches trial = {"can", clock(random), {}};
    const double length = closing(random);
    for (const auto& [digit, share] : shares) {
      // The first and the last digit do not scatter, so that they span what was planted.
      const bool is_between = share > 0.0 && share < latest;
      const double off = is_between ? scatter * (k - 0.5 * (count - 1)) / count : 0.0;
      trial.contacts.push_back(
          {digit, digit == "TH", trial.start + length * (1.0 - latest + share + off)});
    }
    trials.push_back(trial);
  }
  return trials;
}

TEST(TouchLags, PlantedSharesComeBackWhateverTheClockAndTheClosingTime) {
  const auto trials = MakeTrials({{"TH", 0.25}, {"FF", 0.0}, {"MF", 0.1}}, 21, 0.08);
  const Answer<TouchLags> lags = SummariseTouches(trials, kDigits);
  ASSERT_TRUE(lags) << lags.reason();
  EXPECT_EQ(lags->num_trials, 21);
  EXPECT_NEAR(lags->Of("TH").median, 0.25, 1e-12);
  EXPECT_NEAR(lags->Of("FF").median, 0.0, 1e-12);
  EXPECT_NEAR(lags->Of("MF").median, 0.1, 1e-12);
  EXPECT_NEAR(lags->Of("TH").high - lags->Of("TH").low, 0.0, 1e-12);
  // Quartiles of 21 even steps of 0.08 / 21 about 0.1: 5 steps to each side.
  EXPECT_NEAR(lags->Of("MF").low, 0.1 - 5.0 * 0.08 / 21.0, 1e-12);
  EXPECT_NEAR(lags->Of("MF").high, 0.1 + 5.0 * 0.08 / 21.0, 1e-12);
}

TEST(TouchLags, OnlyTheDigitsThatAreAskedForDecideWhoIsFirstAndLast) {
  const auto trials =
      MakeTrials({{"TH", 0.25}, {"FF", 0.05}, {"MF", 0.1}, {"LF", 0.0}, {"RF", 0.3}}, 4, 0.0);
  const Answer<TouchLags> lags = SummariseTouches(trials, kDigits);
  ASSERT_TRUE(lags);
  // Without the little and the ring finger closing takes 0.95 of what it took with them.
  EXPECT_NEAR(lags->Of("TH").median, 0.2 / 0.95, 1e-12);
  EXPECT_NEAR(lags->Of("FF").median, 0.0, 1e-12);
}

TEST(TouchLags, ADigitThatNeverTouchesIsTheLastAndNoneIsDropped) {
  auto trials = MakeTrials({{"TH", 0.25}, {"FF", 0.0}, {"MF", 0.1}}, 4, 0.0);
  trials[0].contacts[1].time = NAN;  // by id: FF, MF, TH
  Answer<TouchLags> lags = SummariseTouches(trials, kDigits);
  ASSERT_TRUE(lags);
  EXPECT_EQ(lags->num_trials, 4);
  EXPECT_EQ(lags->Of("MF").num_never, 1);
  EXPECT_NEAR(lags->Of("MF").median, 0.1, 1e-12);
  EXPECT_TRUE(std::isinf(lags->Of("MF").high));
  EXPECT_FALSE(std::isinf(lags->gft));
  for (TrialTouches& trial : trials) trial.contacts[1].time = NAN;
  lags = SummariseTouches(trials, kDigits);
  ASSERT_TRUE(lags);
  EXPECT_TRUE(std::isinf(lags->Of("MF").median));
  EXPECT_TRUE(std::isinf(lags->gft));
  const TouchLags read = TouchLagsFromJson(ToJson(*lags));
  EXPECT_EQ(ToJson(read), ToJson(*lags));
  EXPECT_TRUE(std::isinf(read.Of("MF").median));
  for (TrialTouches& trial : trials) {
    for (DigitContact& contact : trial.contacts) contact.time = NAN;
  }
  EXPECT_EQ(SummariseTouches(trials, kDigits).reason(), "no digit touched in any trial");
}

TEST(TouchLags, WhatCannotBeComparedIsLeftOutAndCounted) {
  auto trials = MakeTrials({{"TH", 0.25}, {"FF", 0.0}, {"MF", 0.1}}, 4, 0.0);
  trials[0].start = NAN;
  trials[1].contacts.pop_back();                        // not known
  trials[2].start = trials[2].contacts[0].time + 0.01;  // it touched before
  const Answer<TouchLags> lags = SummariseTouches(trials, kDigits);
  ASSERT_TRUE(lags);
  EXPECT_EQ(lags->num_trials, 1);
  EXPECT_EQ(lags->num_left_out, 3);
  trials.pop_back();
  EXPECT_EQ(SummariseTouches(trials, kDigits).reason(),
            "none of 3 trials has a known start of closure and known contacts after it");
  EXPECT_EQ(SummariseTouches(trials, {"TH", "LF", "RF"}).reason(), "no contact is known of LF, RF");
  EXPECT_EQ(SummariseTouches({}, kDigits).reason(), "there is no trial");
}

TEST(TouchLags, TimesInMillisecondsAreRefused) {
  auto trials = MakeTrials({{"TH", 0.25}, {"FF", 0.0}, {"MF", 0.1}}, 4, 0.0);
  for (TrialTouches& trial : trials) {
    trial.start *= 1000.0;
    for (DigitContact& contact : trial.contacts) contact.time *= 1000.0;
  }
  const Answer<TouchLags> lags = SummariseTouches(trials, kDigits);
  ASSERT_FALSE(lags);
  EXPECT_NE(lags.reason().find("are its times in seconds?"), std::string::npos) << lags.reason();
}

}  // namespace

}  // namespace graspbench
