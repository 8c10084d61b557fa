#pragma once
/** @file
A straight line with an intercept and a slope of its own for each person:

    y = (beta_0 + b_0p) + (beta_1 + b_1p) x + e,   (b_0p, b_1p) ~ N(0, Psi),   e ~ N(0, sigma^2)

fitted by restricted maximum likelihood (reml.h); lme4's y ~ x + (x | person). All trials enter,
persons may have different numbers of them. Where that is singular FitMixedModelLadder goes on to
uncorrelated intercepts and slopes, x counted from its mean (x || person), then without the one
whose variance is zero, and says what it took.

Not modelled: further predictors (effects_model.h). The exported R script is the way to others. */

#include <string>
#include <vector>

#include "core/statistics/proportion.h"
#include "human_study/statistics/line_fit.h"

namespace graspbench {

/** A t test of one coefficient against 0. */
struct CoefficientTest {
  double df = 0.0;
  double p = 1.0;
  Interval interval;  ///< 95 %
};

struct FixedEffect {
  double estimate = 0.0;
  double standard_error = 0.0;
  double t = 0.0;
  Answer<CoefficientTest> test;  ///< none for a singular fit
};

struct PersonEffect {
  std::string person;
  double intercept = 0.0;  ///< of this person's line: fixed effect plus predicted deviation
  double slope = 0.0;
};

/** What varies between persons. */
enum class LineStructure { kCorrelated, kUncorrelated, kIntercept, kSlope };

/** For notes: "an intercept and a slope for each person". */
const char* NameOf(LineStructure structure);

struct MixedModel {
  LineStructure structure = LineStructure::kCorrelated;
  std::string fallback;  ///< why the fuller structures were left; empty: none was
  int num_persons = 0;
  int num_observations = 0;
  FixedEffect intercept;
  FixedEffect slope;
  double intercept_sd = 0.0;   ///< between persons, at x = 0
  double slope_sd = 0.0;       ///< between persons
  Answer<double> correlation;  ///< of the two; none when either is 0
  double residual_sd = 0.0;
  double reml_criterion = 0.0;
  bool is_singular = false;  ///< Psi has no full rank: the data ask for a simpler model
  std::vector<PersonEffect> persons;
};

/** No answer below two persons or with no more observations than two per person, when all x are
equal, a value is not finite or every person's points lie on a line. */
Answer<MixedModel> FitMixedModel(const std::vector<PersonPoint>& points,
                                 LineStructure structure = LineStructure::kCorrelated);

/** The fullest structure that is not singular. No answer as above, and when persons differ in
neither intercept nor slope. */
Answer<MixedModel> FitMixedModelLadder(const std::vector<PersonPoint>& points);

}  // namespace graspbench
