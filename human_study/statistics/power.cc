#include "human_study/statistics/power.h"

#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/statistics/distributions.h"
#include "human_study/statistics/location_tests.h"

namespace graspbench {
namespace {

constexpr double kLevel = 0.05;
constexpr int kMaxPersons = 1000;

double CalcStandardError(const PowerDesign& design, int num_persons, int num_trials) {
  return CalcPersonSpread(design, num_trials) *
         std::sqrt((design.is_between ? 2.0 : 1.0) / num_persons);
}

double CountDf(const PowerDesign& design, int num_persons) {
  return design.is_between ? 2.0 * num_persons - 2.0 : num_persons - 1.0;
}

}  // namespace

double CalcPersonSpread(const PowerDesign& design, int num_trials) {
  const double trials = (design.is_between ? 1.0 : 2.0) / num_trials;
  return std::sqrt(design.person_sd * design.person_sd +
                   trials * design.trial_sd * design.trial_sd);
}

PowerEstimate SimulatePower(const PowerDesign& design, int num_persons, int num_trials,
                            int num_simulations, const std::string& id) {
  RandomStream random(id, "power");
  const double spread = CalcPersonSpread(design, num_trials);
  const auto draw = [&](double mean) {
    std::vector<double> values(static_cast<size_t>(num_persons));
    for (double& value : values) value = mean + spread * random.NextNormal();
    return values;
  };
  int num_significant = 0;
  double half_widths = 0.0;
  for (int i = 0; i < num_simulations; ++i) {
    double p = 1.0, t = 0.0;
    Interval interval;
    if (design.is_between) {
      const Answer<WelchTest> test = CalcWelchTest(draw(design.difference), draw(0.0));
      p = test->p;
      t = test->t;
      interval = test->interval;
    } else {
      const Answer<TTest> test = CalcTTest(draw(design.difference));
      p = test->p;
      t = test->t;
      interval = test->interval;
    }
    num_significant += p < kLevel && t > 0.0;  // a difference of the wrong sign is no success
    half_widths += 0.5 * (interval.high - interval.low);
  }
  return {static_cast<double>(num_significant) / num_simulations,
          CalcWilsonInterval(num_significant, num_simulations), half_widths / num_simulations};
}

double CalcPower(const PowerDesign& design, int num_persons, int num_trials) {
  const double df = CountDf(design, num_persons);
  const double shift = design.difference / CalcStandardError(design, num_persons, num_trials);
  const double critical = CalcStudentQuantile(1.0 - kLevel / 2.0, df);
  if (shift > critical + 30.0) return 1.0;  // the series would need too many terms
  return CalcNoncentralStudentUpperP(critical, df, shift);
}

Answer<int> FindPersons(const PowerDesign& design, int num_trials, double wanted) {
  int low = 1, high = kMaxPersons;  // the power grows with persons
  if (CalcPower(design, high, num_trials) < wanted) {
    return NoAnswer{"more than " + std::to_string(kMaxPersons) + " persons"};
  }
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (CalcPower(design, middle, num_trials) < wanted ? low : high) = middle;
  }
  return high;
}

}  // namespace graspbench
