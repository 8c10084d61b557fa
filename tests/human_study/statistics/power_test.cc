#include "human_study/statistics/power.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

/** Differences of conditions with an SD of 1. */
PowerDesign MakeWithin(double difference) {
  PowerDesign design;
  design.difference = difference;
  design.person_sd = 1.0;
  return design;
}

TEST(Power, IsThatOfPublishedTables) {
  // Cohen (1988) and G*Power 3.1, two-sided 0.05: paired d = 0.5 needs 34 pairs, two groups with
  // d = 0.5 need 64 each; R 4.2: power.t.test(n = 20, delta = 1) is 0.8689528.
  EXPECT_EQ(*FindPersons(MakeWithin(0.5), 10, 0.8), 34);
  PowerDesign groups = MakeWithin(0.5);
  groups.is_between = true;
  EXPECT_EQ(*FindPersons(groups, 10, 0.8), 64);
  groups.difference = 1.0;
  EXPECT_NEAR(CalcPower(groups, 20, 10), 0.8689528, 1e-6);
}

TEST(Power, SimulationAgreesWithTheClosedForm) {
  for (const bool is_between : {false, true}) {
    PowerDesign design = MakeWithin(0.8);
    design.is_between = is_between;
    design.trial_sd = 1.5;
    const PowerEstimate estimate = SimulatePower(design, 15, 5, 4000, "test");
    const double exact = CalcPower(design, 15, 5);
    EXPECT_NEAR(estimate.power, exact, 0.02);
    EXPECT_LT(estimate.interval.low, estimate.power);
    EXPECT_GT(estimate.interval.high, estimate.power);
  }
}

TEST(Power, TrialsHelpAsFarAsTheyCount) {
  PowerDesign design = MakeWithin(0.5);
  design.trial_sd = 2.0;
  EXPECT_NEAR(CalcPersonSpread(design, 8), std::sqrt(1.0 + 2.0 * 4.0 / 8.0), 1e-12);
  EXPECT_GT(*FindPersons(design, 1, 0.8), *FindPersons(design, 8, 0.8));
  // Persons differ all the same: no number of trials does with fewer than without any noise.
  EXPECT_GE(*FindPersons(design, 10000, 0.8), *FindPersons(MakeWithin(0.5), 1, 0.8));
  EXPECT_EQ(FindPersons(MakeWithin(0.01), 1, 0.8).reason(), "more than 1000 persons");
}

}  // namespace
}  // namespace graspbench
