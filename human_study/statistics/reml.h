#pragma once
/** @file
Restricted maximum likelihood for a linear mixed model with random effects of persons:

    y_p = X_p beta + Z_p b_p + e_p,   b_p ~ N(0, sigma^2 Lambda Lambda^T),   e ~ N(0, sigma^2 I)

Persons are independent of each other; factors nested in persons (sessions) are further columns of
Z_p. With V_p = I + Z_p Lambda Lambda^T Z_p^T, and beta and sigma profiled out, the criterion -2 log
L is

    sum log|V_p| + log|C| + (N - p) (1 + log(2 pi Q / (N - p))),
    C = sum X_p^T V_p^-1 X_p,   Q = sum r_p^T V_p^-1 r_p

(Bates, Maechler, Bolker and Walker, J. Stat. Softw. 67 (2015)), minimised over the entries of
Lambda by Newton steps with the absolute values of the curvature. The minimum may lie at the
boundary (a variance of zero, a correlation of 1): the fit is then singular. Degrees of freedom are
Satterthwaite's; for several contrasts they are combined as in lmerTest (Kuznetsova, Brockhoff and
Christensen, J. Stat. Softw. 82 (2017)); they are not valid for a singular fit.

Not modelled: groupings that cross persons, weights, correlated residuals. */

#include <Eigen/Core>
#include <vector>

#include "core/statistics/answer.h"

namespace graspbench {

/** One person's trials. */
struct RemlGroup {
  Eigen::MatrixXd x;  ///< fixed effects
  Eigen::MatrixXd z;  ///< the person's random effects, with columns as in RemlStructure
  Eigen::VectorXd y;
};

/** Structure of Lambda: the first columns of Z correlate freely; the next form blocks with one
variance each; all others (as many as a person needs) share one variance. */
struct RemlStructure {
  int num_correlated = 0;
  std::vector<int> blocks;  ///< number of columns of each
  bool has_shared = false;

  int num_parameters() const;
};

struct RemlFTest {
  double f = 0.0;
  double df_1 = 0.0, df_2 = 0.0;
  double p = 1.0;
};

struct RemlFit {
  Eigen::VectorXd beta;
  Eigen::MatrixXd covariance;           ///< of beta
  double sigma = 0.0;                   ///< residual standard deviation
  Eigen::VectorXd theta;                ///< lower triangle by columns, blocks, shared
  double criterion = 0.0;               ///< -2 log L at the optimum
  bool is_singular = false;             ///< an entry of Lambda's diagonal is 0
  std::vector<Eigen::VectorXd> random;  ///< predicted b_p, in the order of the groups

  /** sigma^2 Lambda Lambda^T of the correlated columns. */
  Eigen::MatrixXd CalcCovariance(int num_correlated) const;
  /** Computes Satterthwaite's degrees of freedom. No answer for a singular fit. */
  Answer<double> CalcDf(const Eigen::VectorXd& contrast) const;
  /** Tests that all rows of contrasts * beta are 0. No answer as CalcDf, or when the rows are
  linearly dependent. */
  Answer<RemlFTest> TestContrasts(const Eigen::MatrixXd& contrasts) const;

  // For CalcDf: covariance of (theta, sigma), and derivatives of `covariance` with respect to them.
  Eigen::MatrixXd parameter_covariance;
  std::vector<Eigen::MatrixXd> covariance_slopes;
};

/** Fits the model. No answer when the columns of X are linearly dependent, when fixed and random
effects leave no residual (fewer trials than effects, or no spread about them), or without a clear
optimum. @pre all groups have the same columns of x, and the columns of z that the structure
names. */
Answer<RemlFit> FitReml(const std::vector<RemlGroup>& groups, const RemlStructure& structure);

}  // namespace graspbench
