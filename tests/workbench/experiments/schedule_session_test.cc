#include "workbench/experiments/schedule_session.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "datasets/journal/sealed_store.h"
#include "tests/workbench/experiments/small_sessions.h"

namespace graspbench {
namespace {

class ScheduleSessionTest : public SmallSessions {
 protected:
  void SetUp() override {
    SessionConfig config = MakeConfig({kObject}, 2);
    config.hands = {"shadow"};
    config.variation.offset = 0.001;
    config.variation.yaw = 0.01;
    request_ = RunNew("session", config);
  }

  /** People who touch in the order of the list, at these shares of a closing time of 0.4 s. */
  People MakePeople(const std::vector<std::pair<std::string, double>>& shares,
                    const std::string& object) {
    double latest = 0.0;
    for (const auto& [digit, share] : shares) latest = std::max(latest, share);
    People people = {"planted", {}};
    for (int k = 0; k < 5; ++k) {
      TrialTouches trial = {object, 10.0 * k, {}};
      for (const auto& [digit, share] : shares) {
        trial.contacts.push_back(
            {digit, digit == "TH", trial.start + 0.4 * (1.0 - latest + share)});
      }
      people.touches.push_back(trial);
    }
    return people;
  }

  std::string FindFault(const People& people) {
    try {
      PrepareSchedules(request_, people);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  static constexpr char kObject[] = "can";
  ExperimentRequest request_;
};

TEST_F(ScheduleSessionTest, PlantedSharesComeBackAndSimultaneousDigitsTouchTogether) {
  const Session before = LoadSession(request_.folder);
  std::vector<std::string> digits;
  for (const DigitContact& contact : before.records[0].result.contacts) {
    digits.push_back(contact.digit.str());
  }
  ASSERT_EQ(digits.size(), 5u);
  const std::vector<std::pair<std::string, double>> planted = {
      {digits[4], 0.0}, {digits[2], 0.1}, {digits[1], 0.15}, {digits[3], 0.2}, {digits[0], 0.35}};
  const People people = MakePeople(planted, kObject);
  const PreparedSession schedules = PrepareSchedules(request_, people);
  EXPECT_EQ(schedules.session.plan.size(), 6u);
  request_.thresholds = &kThresholdScales[1];
  ASSERT_TRUE(RunExperiment(schedules, request_, observer_));
  const std::vector<ScheduleComparison> found = LoadSchedules(before);
  ASSERT_EQ(found.size(), 1u);
  ASSERT_EQ(found[0].cells.size(), 1u);
  const std::vector<ScheduleRow>& rows = found[0].cells[0].rows;
  ASSERT_EQ(rows.size(), 3u);
  // Rounding of the grasp file apart, the natural schedule is the session's own grasp.
  const Session after = LoadSession(schedules.folder);
  for (size_t k = 0; k < 2; ++k) {
    const TrialResult& own = before.records[k].result;
    const TrialResult& again = after.records[k].result;
    for (size_t d = 0; d < digits.size(); ++d) {
      EXPECT_NEAR(own.contacts[d].time, again.contacts[d].time, 2e-3) << k << digits[d];
    }
  }
  EXPECT_LT(rows[1].lags->gft, 0.5 * rows[0].lags->gft);
  for (const auto& [digit, share] : planted) {
    EXPECT_NEAR(rows[2].lags->Of(digit).median, share, 0.06) << digit;
  }
  EXPECT_EQ(rows[0].ratio, 1.0);
  EXPECT_EQ(rows[2].num_pairs, 2);
  EXPECT_TRUE(VerifyStore(request_.folder, OnDamage::kAccept).damages.empty());
  EXPECT_EQ(PrepareSchedules(request_, people).folder, schedules.folder);
}

TEST_F(ScheduleSessionTest, WhatCannotBeComparedIsRefusedBeforeATrialRuns) {
  const std::vector<std::pair<std::string, double>> shares = {{"TH", 0.1}, {"FF", 0.0}};
  EXPECT_NE(FindFault(MakePeople(shares, "cup")).find("people grasped no can"), std::string::npos)
      << FindFault(MakePeople(shares, "cup"));
  EXPECT_NE(FindFault(MakePeople({{"TH", 0.1}, {"FF", 0.0}}, kObject)).find("no contact is known"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(request_.folder / "schedules"));
  const PreparedSession without = PrepareSchedules(request_, {});
  EXPECT_EQ(without.session.plan.size(), 4u);
  EXPECT_EQ(LoadPeopleFile(without.folder).cells[0].missing.at(kPeopleLike),
            "no study of participants was named");
  request_.folder = without.folder;
  EXPECT_NE(FindFault({}).find("has its own conditions or schedules"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
