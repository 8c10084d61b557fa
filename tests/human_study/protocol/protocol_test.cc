/** @file
The analysis against reaches that share nothing with it, each condition on seeds of its own; the
whole table is human_study/ACCURACY.md. */

#include <gtest/gtest.h>

#include "tests/human_study/faults.h"
#include "tests/human_study/protocol/protocol_study.h"

namespace graspbench::protocol {
namespace {

StudyPlan MakePlan(const std::string& seed) {
  StudyPlan plan;
  plan.make_reach = MakeProtocolReach;
  plan.conditions = MakeProtocolConditions();
  plan.seed = seed;
  plan.num_people = 2;
  plan.trials_per_person = 6;
  return plan;
}

TEST(Protocol, ThreeMarkersAreNoWorseThanOne) {
  for (const bool has_shape : {true, false}) {
    StudyPlan plan = MakePlan("three or one");
    plan.conditions.rate = 100.0;
    plan.conditions.noise_sd = 0.5e-3;
    plan.has_shape = has_shape;
    plan.conditions.num_object_markers = 1;
    const Accuracy one = CompareWithTruth(RunPlan(plan));
    plan.conditions.num_object_markers = 3;
    for (const double edge : {15e-3, 30e-3, 60e-3}) {
      plan.conditions.triangle_edge = edge;
      const Accuracy three = CompareWithTruth(RunPlan(plan));
      EXPECT_LE(three.sd, 1.2 * one.sd) << edge;
      EXPECT_GE(three.num_kept, one.num_kept - 1) << edge;
    }
  }
}

TEST(Protocol, AnObjectThatIsCarriedUnseenIsNoticed) {
  StudyPlan plan = MakePlan("carried unseen");
  plan.conditions.num_object_markers = 0;
  const StudyResult result = RunPlan(plan).result;
  EXPECT_EQ(result.CountKept(), 0);
  EXPECT_GE(CountRemovals(result)["carried_unseen"], 11);
  for (const DigitContactEvents& digit : result.trials[0].analysis->contacts) {
    EXPECT_FALSE(digit.contact.IsFound());
  }
}

TEST(Protocol, ARecordingWithYUpIsNamedAsSuch) {
  StudyPlan plan = MakePlan("y up");
  plan.has_shape = false;
  plan.is_y_up = true;
  const StudyResult result = RunPlan(plan).result;
  EXPECT_EQ(CountRemovals(result)["other_lift_axis"], 12);
  ExpectHolds(result.trials[0].removed, "along +y");
  ExpectHolds(result.trials[0].removed, "lift_off: {up_x: 0, up_y: 1, up_z: 0}");
  plan.settings = "lift_off: {up_x: 0, up_y: 1, up_z: 0}\n";
  EXPECT_GE(RunPlan(plan).result.CountKept(), 11);
}

// The same reaches, recorded in a laboratory whose y axis is up: the height of the shape in
// objects.csv points up there, too, and every contact is found at the same instant.
TEST(Protocol, AShapeStandsUprightWhateverAxisIsUp) {
  StudyPlan plan = MakePlan("upright");
  const StudyResult z_up = RunPlan(plan).result;
  plan.is_y_up = true;
  plan.settings = "lift_off: {up_x: 0, up_y: 1, up_z: 0}\n";
  const StudyResult y_up = RunPlan(plan).result;
  ASSERT_GE(z_up.CountKept(), 11);
  for (size_t i = 0; i < z_up.trials.size(); ++i) {
    ASSERT_EQ(z_up.trials[i].IsKept(), y_up.trials[i].IsKept()) << i;
    if (!z_up.trials[i].IsKept()) continue;
    for (size_t d = 0; d < kNumDigits; ++d) {
      EXPECT_NEAR(z_up.trials[i].analysis->contacts[d].contact.time,
                  y_up.trials[i].analysis->contacts[d].contact.time, 1e-4)
          << i << " " << d;
    }
  }
}

TEST(Protocol, ADigitThatHoversIsNotTakenForOneThatTouches) {
  StudyPlan plan = MakePlan("hovers");
  plan.conditions.hovering_digit = 3;
  const Accuracy accuracy = CompareWithTruth(RunPlan(plan));
  EXPECT_GE(accuracy.num_kept, 11);
  EXPECT_LE(accuracy.num_false_contacts, 1);
  EXPECT_GE(accuracy.num_contacts, accuracy.num_true_contacts - 2);
}

// Much noise, slow closings, no shape: much is uncertain, but hardly anything is silently wrong.
TEST(Protocol, LargeErrorsAreStated) {
  for (const double noise : {1e-3, 2e-3}) {
    StudyPlan plan = MakePlan("slow and noisy");
    plan.has_shape = false;
    plan.conditions.noise_sd = noise;
    plan.conditions.min_touch_speed = 40e-3;
    plan.conditions.max_touch_speed = 65e-3;
    const auto [result, truth] = RunPlan(plan);
    EXPECT_GE(result.CountKept(), 11);
    int num_found = 0, num_silent = 0;
    for (size_t i = 0; i < truth.size(); ++i) {
      if (!result.trials[i].IsKept()) continue;
      const TrialAnalysis& analysis = *result.trials[i].analysis;
      EXPECT_EQ(analysis.num_unverified, analysis.num_touching);
      for (size_t d = 0; d < kNumDigits; ++d) {
        const EventTime& contact = analysis.contacts[d].contact;
        if (!contact.IsFound()) continue;
        ++num_found;
        const double error = std::abs(contact.time - truth[i].touch_times[d]);
        num_silent += error > std::max(0.05, 3.0 * contact.uncertainty);
      }
    }
    EXPECT_GE(num_found, 55) << noise;
    EXPECT_LE(num_silent, 1) << noise;
  }
}

TEST(Protocol, RigidContactsAreFoundAndCovered) {
  StudyPlan plan = MakePlan("rigid");
  const Accuracy accuracy = CompareWithTruth(RunPlan(plan));
  EXPECT_EQ(accuracy.num_kept, 12);
  EXPECT_EQ(accuracy.num_contacts, 60);
  EXPECT_LT(std::abs(accuracy.bias), 0.003);
  EXPECT_LT(accuracy.sd, 0.006);
  EXPECT_GE(accuracy.coverage, 0.9);
}

}  // namespace
}  // namespace graspbench::protocol
