#pragma once
/** @file
A straight line with an intercept and a slope of its own for each person:

    y = (beta_0 + b_0p) + (beta_1 + b_1p) x + e,   (b_0p, b_1p) ~ N(0, Psi),   e ~ N(0, sigma^2)

fitted by restricted maximum likelihood; lme4's y ~ x + (x | person). All trials enter, persons may
have different numbers of them. With Z_p = [1 x], V_p = I + Z_p G Z_p^T, G = Psi / sigma^2, the
criterion -2 log L with beta and sigma profiled out is

    sum log|V_p| + log|C| + (N - 2) (1 + log(2 pi Q / (N - 2))),
    C = sum Z_p^T V_p^-1 Z_p,   Q = sum r_p^T V_p^-1 r_p

(Bates, Maechler, Bolker and Walker, J. Stat. Softw. 67 (2015)). It is minimised over the Cholesky
factor of G by Newton steps, which may reach the boundary (a variance of zero, a correlation of 1):
the fit is then called singular. Degrees of freedom of the fixed effects are Satterthwaite's
(Kuznetsova, Brockhoff and Christensen, J. Stat. Softw. 82 (2017)), which do not hold there.

Not modelled: further predictors, other groupings. The exported R script is the way to those. */

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

struct MixedModel {
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
Answer<MixedModel> FitMixedModel(const std::vector<PersonPoint>& points);

}  // namespace graspbench
