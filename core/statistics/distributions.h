#pragma once
/** @file
Tail probabilities and quantiles of the distributions used in tests.

Upper tails are computed directly, never as 1 - p, so a p value of 1e-30 keeps its digits. Degrees
of freedom are real numbers, as sphericity corrections and Satterthwaite's method need.
@pre for all: degrees of freedom > 0, probabilities strictly between 0 and 1, no NaN. */

namespace graspbench {

double CalcStudentUpperP(double t, double df);
double CalcStudentTwoSidedP(double t, double df);
double CalcStudentQuantile(double probability, double df);

double CalcFisherUpperP(double f, double df_1, double df_2);
double CalcFisherQuantile(double probability, double df_1, double df_2);

double CalcChiSquaredUpperP(double x, double df);
double CalcChiSquaredQuantile(double probability, double df);

/** 95 % of normally distributed errors are within this many standard deviations; rounded as in
published tables. */
inline constexpr double kNormal95 = 1.96;

/** Probability of at least `num_successes` successes in `num_trials` trials.
@pre 0 <= num_successes <= num_trials. */
double CalcBinomialUpperP(int num_successes, int num_trials, double probability);

double CalcNormalP(double z);  ///< lower tail
double CalcNormalQuantile(double probability);

/** P(T > t) for the noncentral t distribution, from which the power of a t test follows. The
noncentrality `shift` is the true difference divided by its standard error.
@pre df > 0, no NaN; |shift| up to some hundreds. */
double CalcNoncentralStudentUpperP(double t, double df, double shift);

}  // namespace graspbench
