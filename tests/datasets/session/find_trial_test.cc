#include "datasets/session/find_trial.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

Session MakeSession(int trials) {
  Session session;
  session.config.trials = trials;
  session.plan = MakePlan(session.config, MakeFakeInputs());
  for (const PlannedTrial& planned : session.plan) {
    session.records.push_back(MakeFakeRecord(planned));
  }
  return session;
}

std::string FindMessage(const Session& session, const std::string& name) {
  try {
    FindPlannedTrial(session, name);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(FindTrial, EveryTrialHasThreeNames) {
  const Session session = MakeSession(12);
  for (const PlannedTrial& planned : session.plan) {
    EXPECT_EQ(FindPlannedTrial(session, planned.id), planned);
    EXPECT_EQ(FindPlannedTrial(session, planned.id.substr(0, 12)), planned);
    EXPECT_EQ(FindPlannedTrial(session, NameTrial(planned)), planned);
  }
  std::string id = session.plan[3].id;
  std::transform(id.begin(), id.end(), id.begin(), ::toupper);
  EXPECT_EQ(FindPlannedTrial(session, id), session.plan[3]);
  EXPECT_EQ(NameTrial(session.plan[3]), "tum-mug-g2:3");
}

TEST(FindTrial, ANameWithoutANumberGetsItsTrials) {
  const Session session = MakeSession(2);
  EXPECT_TRUE(Has(FindMessage(session, "tum-mug-g2"), "; did you mean tum-mug-g2:0?; name a"));
  EXPECT_TRUE(Has(FindMessage(session, "TUM-mug"), "; did you mean tum-mug-g2:0"));
  EXPECT_FALSE(Has(FindMessage(session, "nobody"), "did you mean"));
}

TEST(FindTrial, UnderAConditionTheNameHasIt) {
  Session session = MakeSession(2);
  for (PlannedTrial planned : std::vector<PlannedTrial>(session.plan)) {
    planned.condition = "Heavy";
    planned.id.front() = planned.id.front() == 'f' ? '0' : 'f';
    session.plan.push_back(planned);
  }
  for (const PlannedTrial& planned : session.plan) {
    EXPECT_EQ(FindPlannedTrial(session, NameTrial(planned)), planned);
  }
  EXPECT_EQ(FindPlannedTrial(session, "tum-mug-g2:1@heavy").condition, "Heavy");
  EXPECT_FALSE(FindPlannedTrial(session, "tum-mug-g2:1").condition);
  EXPECT_TRUE(Has(FindMessage(session, "tum-mug-g2:2"), "has tum-mug-g2:0 to tum-mug-g2:1"));
  EXPECT_NE(FindMessage(session, "tum-mug-g2:1@light"), "");
}

TEST(FindTrial, NamesThatDifferInCapitalsAreKeptApart) {
  Session session = MakeSession(2);
  for (const char* condition : {"grasp=Pinch", "grasp=pinch"}) {
    PlannedTrial planned = session.plan.front();
    planned.condition = condition;
    planned.id = condition;
    session.plan.push_back(planned);
  }
  const std::string name = NameTrial(session.plan.front());
  for (const char* condition : {"grasp=Pinch", "grasp=pinch"}) {
    EXPECT_EQ(FindPlannedTrial(session, name + "@" + condition).condition, condition);
  }
  EXPECT_TRUE(Has(FindMessage(session, name + "@grasp=PINCH"), "differ only in capital letters"));
}

TEST(FindTrial, WhatIsNoneIsRefusedWithWhatThereIs) {
  Session session = MakeSession(3);
  EXPECT_TRUE(Has(FindMessage(session, "tum-mug-g2:3"), "has tum-mug-g2:0 to tum-mug-g2:2"));
  EXPECT_TRUE(Has(FindMessage(session, "tum-mug-g2:-1"), "has tum-mug-g2:0 to"));
  EXPECT_TRUE(Has(FindMessage(session, "tum-mugg-g2:1"), "did you mean \"tum-mug-g2\""));
  EXPECT_TRUE(Has(FindMessage(session, session.plan[0].id.substr(0, 3)), "no trial"))
      << "three letters are too few";
  EXPECT_TRUE(Has(FindMessage(session, ""), "no trial"));
  session.plan[1].id = session.plan[0].id.substr(0, 8) + "00000000";
  EXPECT_TRUE(Has(FindMessage(session, session.plan[0].id.substr(0, 6)), "several trials"));
}

// By trying all of them.
TEST(FindTrial, TheNearestSuccessIsNearerThanAnyOther) {
  Session session = MakeSession(20);
  constexpr double kRadius = 0.04;
  for (const PlannedTrial& planned : session.plan) {
    const NearestSuccess nearest = FindNearestSuccess(session, planned, kRadius);
    double smallest = 1e9;
    for (const TrialRecord& record : session.records) {
      const bool is_of_cell = NameTrial(record.plan).substr(0, NameTrial(record.plan).find(':')) ==
                              NameTrial(planned).substr(0, NameTrial(planned).find(':'));
      if (!is_of_cell || record.plan.id == planned.id) continue;
      if (record.result.outcome != Outcome::kSuccess) continue;
      const TrialDraw a = MakeObjectDraw(session.config, planned.object, planned.trial);
      const TrialDraw b = MakeObjectDraw(session.config, planned.object, record.plan.trial);
      smallest = std::min(smallest, std::hypot(a.offset_x - b.offset_x, a.offset_y - b.offset_y,
                                               kRadius * (a.offset_yaw - b.offset_yaw)));
    }
    if (smallest == 1e9) {
      EXPECT_EQ(nearest.record, nullptr);
    } else {
      ASSERT_NE(nearest.record, nullptr);
      EXPECT_TRUE(IsSuccess(nearest.record->result.outcome));
      EXPECT_NEAR(nearest.distance, smallest, 1e-15);
    }
  }
  session.records.clear();
  EXPECT_EQ(FindNearestSuccess(session, session.plan[0], kRadius).record, nullptr);
  EXPECT_EQ(FindRecord(session, session.plan[0]), nullptr);
}

class SessionExperiments : public testing::Test {
 protected:
  SessionExperiments() {
    CreateFakeSession(folder_.path(), 2);
    session_ = LoadSession(folder_.path());
  }

  /** Below the session, with the configuration given. */
  void Create(const std::string& name, const SessionConfig& config,
              const std::vector<PlannedTrial>& plan) {
    CreateSession(folder_.path() / name, config, plan);
  }
  std::string FindComplaint() {
    try {
      LoadExperiments(session_, "sensitivity");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kFormat);
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  Session session_;
};

TEST_F(SessionExperiments, OfAnotherSeedAreRefused) {
  SessionConfig config = session_.config;
  config.seed = 7;
  Create("sensitivity/2", config, {session_.plan.front()});
  const std::string complaint = FindComplaint();
  EXPECT_TRUE(Has(complaint, "\"sensitivity/2\" is an experiment on another session"));
  EXPECT_TRUE(Has(complaint, "seed: 1 and 7"));
}

}  // namespace

}  // namespace graspbench
