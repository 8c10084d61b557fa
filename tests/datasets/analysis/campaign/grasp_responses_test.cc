#include "datasets/analysis/campaign/grasp_responses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

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
