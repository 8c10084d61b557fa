#include "datasets/analysis/simultaneity_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {

namespace {

/** Cells that differ much in GFT and in sigma; inside them sigma falls by `effect` for every second
of GFT. */
Session MakeTimedSession(double effect, unsigned seed) {
  Session session = MakeSession({"tum"}, {"a", "b", "c", "d", "e", "f", "g", "h"}, "g1", 10);
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  double cell = 0.0;
  for (TrialRecord& record : session.records) {
    if (record.plan.trial == 0) cell = normal(generator);
    const double late = 0.01 * normal(generator);
    record.result.timing.gft = 0.2 + 0.05 * cell + late;
    record.result.stability.sigma = 5.0 + 3.0 * cell - effect * late + 0.1 * normal(generator);
  }
  return session;
}

const SimultaneityRelation& Find(const std::vector<SimultaneityRelation>& relations,
                                 const std::string& measure, const std::string& response) {
  for (const SimultaneityRelation& row : relations) {
    if (row.measure == measure && row.response->shown.id == response) return row;
  }
  throw std::runtime_error(measure + " " + response);
}

TEST(SimultaneitySummary, APlantedEffectIsFoundAmongTheOthers) {
  const auto relations = SummariseSimultaneity(MakeTimedSession(20.0, 1));
  const SimultaneityRelation& row = Find(relations, "gft_s", "sigma_n");
  ASSERT_TRUE(row.relation && row.relation->interval);
  EXPECT_LT(row.relation->interval->high, -0.5);
  EXPECT_LE(row.p_holm, 0.05);
  EXPECT_EQ(row.relation->num_groups, 8);
  EXPECT_EQ(row.relation->num_pairs, 80);
}

TEST(SimultaneitySummary, PlantedIndependenceIsNotCalledAnEffect) {
  int num_found = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    for (const SimultaneityRelation& row : SummariseSimultaneity(MakeTimedSession(0.0, seed))) {
      num_found += row.p_holm <= 0.05 ? 1 : 0;
    }
  }
  EXPECT_LE(num_found, 6);  // of 40 sessions; 5 % are 2
}

TEST(SimultaneitySummary, WhatDoesNotVarySaysWhy) {
  const auto relations = SummariseSimultaneity(MakeTimedSession(0.0, 1));
  EXPECT_FALSE(Find(relations, "gft_s", "success").relation);  // all succeed
  EXPECT_TRUE(std::isnan(Find(relations, "gft_s", "success").p_holm));
  for (const SimultaneityRelation& row : relations) {
    EXPECT_NE(row.response->shown.id, std::string("breaking_force_n"));  // nobody judged
  }
  EXPECT_TRUE(
      MakeRelationsJson({Find(relations, "gft_s", "success")})[0].at("correlation").is_null());
}

TEST(SimultaneitySummary, MeasuresHaveTheirNames) {
  EXPECT_EQ(NameTimingMeasure("gft_ratio"), "GFT%");
  EXPECT_EQ(NameTimingMeasure("got_s"), "GOT");
}

std::map<std::string, double> ListValues(const TrialRecord& record) {
  std::map<std::string, double> values;
  for (const GraspResponse& response : ListGraspResponses()) {
    values[response.shown.id] = response.value(record);
  }
  return values;
}

TrialRecord MakeLift(Outcome outcome) {
  TrialRecord record = MakeRecord({"id", "tum", "can", "g1", 0}, outcome);
  record.result.stability.sigma = 2.5;
  for (const Moment moment : {Moment::kPreGrasp, Moment::kClosed, Moment::kLifted}) {
    SceneSnapshot snapshot;
    snapshot.moment = moment;
    if (moment != Moment::kPreGrasp) snapshot.X_WO = MakePose({0.003, 0.0, 0.0});
    record.result.snapshots.push_back(snapshot);
  }
  record.judgement = Judgement();
  record.judgement->breaking_force = 7.5;
  return record;
}

TEST(GraspResponses, ASuccessHasAll) {
  const auto values = ListValues(MakeLift(Outcome::kSuccess));
  EXPECT_EQ(values.at("success"), 1.0);
  EXPECT_NEAR(values.at("shift_m"), 0.003, 1e-15);
  EXPECT_NEAR(values.at("shift_in_hand_m"), 0.003, 1e-15);
  EXPECT_EQ(values.at("hold_slip_m"), 0.0012);
  EXPECT_EQ(values.at("sigma_n"), 2.5);
  EXPECT_EQ(values.at("breaking_force_n"), 7.5);
}

// A lost object has no sigma of 0 and no way in the hand of half a metre: it has none.
TEST(GraspResponses, AFailureHasOnlyWhatClosingDid) {
  const auto values = ListValues(MakeLift(Outcome::kPushedAway));
  EXPECT_EQ(values.at("success"), 0.0);
  EXPECT_NEAR(values.at("shift_m"), 0.003, 1e-15);
  for (const char* id :
       {"shift_in_hand_m", "turn_in_hand_rad", "hold_slip_m", "sigma_n", "breaking_force_n"}) {
    EXPECT_TRUE(std::isnan(values.at(id))) << id;
  }
}

TEST(GraspResponses, ANumericalFailureIsNoFailureOfTheGrasp) {
  EXPECT_TRUE(std::isnan(ListValues(MakeLift(Outcome::kNumericalFailure)).at("success")));
}

}  // namespace

}  // namespace graspbench
