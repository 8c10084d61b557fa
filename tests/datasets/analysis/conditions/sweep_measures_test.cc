#include "datasets/analysis/conditions/sweep_measures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

TEST(SweepMeasures, AThresholdEntersEffectsAsItsLogarithm) {
  const SweepMeasure& measure = FindSweepMeasure("threshold_margin");
  const TrialRecord record;
  SweepTrial trial;
  trial.record = &record;
  EXPECT_TRUE(std::isnan(measure.CalcEffectValue(trial)));
  trial.thresholds[0] = 4.0;
  EXPECT_DOUBLE_EQ(measure.CalcEffectValue(trial), 2.0);
  // Never held: one of sixteen equal steps above the largest margin, 16.
  trial.thresholds[0] = HUGE_VAL;
  EXPECT_DOUBLE_EQ(measure.CalcEffectValue(trial), 4.25);
  EXPECT_DOUBLE_EQ(FindSweepMeasure("success").CalcEffectValue(trial), 0.0);
}

TEST(SweepMeasures, AChangeOfAThresholdIsShownAsARatio) {
  const SweepMeasure& measure = FindSweepMeasure("threshold_force_n");
  EXPECT_EQ(FormatChange(measure, 1.0), "x 2.00");
  EXPECT_EQ(FormatChangeInterval(measure, {-1.0, 1.0}), "x 0.50 to 2.00");
  EXPECT_EQ(FormatValue(measure, HUGE_VAL), "none held");
  EXPECT_EQ(FormatValue(measure, kUnset), "n/a");
  EXPECT_EQ(FormatChange(FindSweepMeasure("success"), -0.25), "-25.0");
}

}  // namespace
}  // namespace graspbench
