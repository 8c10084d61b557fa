#pragma once
/** @file
Tail probabilities and quantiles of the distributions that tests are read from.

Upper tails are computed as such, never as 1 - p: a p value of 1e-30 keeps its digits. Degrees of
freedom are real numbers, as sphericity corrections and Satterthwaite need.
@pre for all: degrees of freedom > 0, probabilities strictly between 0 and 1, no NaN. */

namespace graspbench {

double CalcStudentUpperP(double t, double df);
double CalcStudentTwoSidedP(double t, double df);
double CalcStudentQuantile(double probability, double df);

double CalcFisherUpperP(double f, double df_1, double df_2);
double CalcFisherQuantile(double probability, double df_1, double df_2);

double CalcChiSquaredUpperP(double x, double df);
double CalcChiSquaredQuantile(double probability, double df);

/** 95 % of normally distributed errors lie within so many standard deviations; as published tables
round it. */
inline constexpr double kNormal95 = 1.96;

/** P(so many successes or more) in so many trials. @pre 0 <= num_successes <= num_trials. */
double CalcBinomialUpperP(int num_successes, int num_trials, double probability);

double CalcNormalP(double z);  ///< lower tail
double CalcNormalQuantile(double probability);

/** The noncentral t distribution: of a t value when the mean is not zero, from which the power of
a t test is read.

P(T > t) with the noncentrality `shift`, the true difference over its standard error.
@pre df > 0, no NaN; |shift| up to some hundreds. */
double CalcNoncentralStudentUpperP(double t, double df, double shift);

}  // namespace graspbench
