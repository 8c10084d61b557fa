#pragma once
/** @file
Restricted maximum likelihood of a linear mixed model whose random effects belong to persons:

    y_p = X_p beta + Z_p b_p + e_p,   b_p ~ N(0, sigma^2 Lambda Lambda^T),   e ~ N(0, sigma^2 I)

Persons are independent of each other; what is nested in them (sessions) are further columns of Z_p.
With V_p = I + Z_p Lambda Lambda^T Z_p^T and beta, sigma profiled out the criterion -2 log L is

    sum log|V_p| + log|C| + (N - p) (1 + log(2 pi Q / (N - p))),
    C = sum X_p^T V_p^-1 X_p,   Q = sum r_p^T V_p^-1 r_p

(Bates, Maechler, Bolker and Walker, J. Stat. Softw. 67 (2015)), minimised over the entries of
Lambda by Newton steps with the curvature's magnitude. The minimum may lie at the boundary (a
variance of zero, a correlation of 1): the fit is then singular. Degrees of freedom are
Satterthwaite's, for several contrasts together as lmerTest combines them (Kuznetsova, Brockhoff and
Christensen, J. Stat. Softw. 82 (2017)); they do not hold where the fit is singular.

Not modelled: groupings that cross persons, weights, correlated residuals. */

#include <Eigen/Core>
#include <vector>

#include "core/statistics/answer.h"

namespace graspbench {

/** One person's trials. */
struct RemlGroup {
  Eigen::MatrixXd x;  ///< fixed effects
  Eigen::MatrixXd z;  ///< the person's random effects, columns as in RemlStructure
  Eigen::VectorXd y;
};

/** What Lambda looks like: the first columns of Z correlate freely, the next come in blocks with one
variance each, all others (as many as that person needs) share one. */
struct RemlStructure {
  int num_correlated = 0;
  std::vector<int> blocks;  ///< columns of each
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
  /** Satterthwaite's. No answer for a singular fit. */
  Answer<double> CalcDf(const Eigen::VectorXd& contrast) const;
  /** That all rows of contrasts * beta are 0. No answer as CalcDf, or when the rows depend on each
  other. */
  Answer<RemlFTest> TestContrasts(const Eigen::MatrixXd& contrasts) const;

  // For CalcDf: covariance of (theta, sigma), derivatives of `covariance` by them.
  Eigen::MatrixXd parameter_covariance;
  std::vector<Eigen::MatrixXd> covariance_slopes;
};

/** @pre all groups have the same columns of x, and those of z that the structure names.
No answer when the columns of X depend on each other, when fixed and random effects leave no residual
(fewer trials than effects, or values without spread about them), or without a clear optimum. */
Answer<RemlFit> FitReml(const std::vector<RemlGroup>& groups, const RemlStructure& structure);

}  // namespace graspbench
