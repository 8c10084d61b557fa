#include <Eigen/Dense>
#include <algorithm>

#include "core/base/text/text.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"
#include "human_study/study/inference/independence_null.h"

namespace graspbench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTrusted = 0.5;  // share of the clock's variance that the regression removes
constexpr double kLeastDf = 5.0;
constexpr double kRank = 1e-7;

/** Successive differences over sqrt(2), which keep the variance of independent values, less the mean
of each run. */
struct Differences {
  MatrixXd times;                    // [difference][digit] [s]
  MatrixXd transport;                // [difference][feature]
  std::vector<Eigen::Index> firsts;  // of each run
  double weight = 0.0;               // sum of squares of independent values of variance one
  double df = 0.0;  // of a variance made of them, after von Neumann: neighbours share a trial
};

Differences TakeDifferences(const std::vector<SharedTimingRun>& runs) {
  Eigen::Index count = 0;
  for (const SharedTimingRun& run : runs) count += static_cast<Eigen::Index>(run.size()) - 1;
  const auto num_digits = static_cast<Eigen::Index>(runs.front().front().contacts.size());
  const auto num_features = static_cast<Eigen::Index>(runs.front().front().transport.size());
  Differences differences{MatrixXd(count, num_digits), MatrixXd(count, num_features), {}, 0.0, 0.0};
  Eigen::Index row = 0;
  for (const SharedTimingRun& run : runs) {
    const double n = static_cast<double>(run.size());
    // Eigenvalues of the quadratic form: their sum, and its square over the sum of their squares.
    const double m = n - 1.0, weight = m - 1.0 / m;
    differences.weight += weight;
    differences.df += 4.0 * weight * weight / (6.0 * m - 2.0 - 4.0 / m + 4.0 / (m * m));
    differences.firsts.push_back(row);
    for (size_t i = 1; i < run.size(); ++i, ++row) {
      for (Eigen::Index d = 0; d < num_digits; ++d) {
        const auto digit = static_cast<size_t>(d);
        differences.times(row, d) = (run[i].contacts[digit] - run[i].clock -
                                     run[i - 1].contacts[digit] + run[i - 1].clock) /
                                    std::sqrt(2.0);
      }
      for (Eigen::Index f = 0; f < num_features; ++f) {
        const auto feature = static_cast<size_t>(f);
        differences.transport(row, f) =
            (run[i].transport[feature] - run[i - 1].transport[feature]) / std::sqrt(2.0);
      }
    }
    const auto length = static_cast<Eigen::Index>(run.size()) - 1;
    for (MatrixXd* values : {&differences.times, &differences.transport}) {
      auto own = values->middleRows(row - length, length);
      own.rowwise() -= Eigen::RowVectorXd(own.colwise().mean());
    }
  }
  return differences;
}

/** Takes out what follows the transport. @returns the number of features that say something. */
double Adjust(Differences& differences) {
  MatrixXd& features = differences.transport;
  for (Eigen::Index f = 0; f < features.cols(); ++f) {
    const double length = features.col(f).norm();
    if (length > 0.0) features.col(f) /= length;
  }
  if (features.cols() == 0) return 0.0;
  Eigen::ColPivHouseholderQR<MatrixXd> solver(features);
  solver.setThreshold(kRank);
  differences.times -= features * solver.solve(differences.times);
  return static_cast<double>(solver.rank());
}

/** Variance of independent values by the products of neighbouring differences: each shared trial
counts in both, with opposite sign. */
double CalcAlternating(const VectorXd& means, const std::vector<Eigen::Index>& firsts) {
  double sum = 0.0, count = 0.0;
  for (Eigen::Index row = 1; row < means.size(); ++row) {
    if (std::find(firsts.begin(), firsts.end(), row) != firsts.end()) continue;
    sum -= 2.0 * means[row] * means[row - 1];
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/** Variance that the clock may keep. */
double BoundClock(const std::vector<SharedTimingRun>& runs) {
  double noise = 0.0, squares = 0.0, count = 0.0, df = 0.0;
  for (const SharedTimingRun& run : runs) {
    std::vector<double> late;
    for (const SharedTimingTrial& trial : run) {
      noise += trial.clock_noise * trial.clock_noise + trial.shared_variance;
      count += 1.0;
      if (std::isfinite(trial.start)) late.push_back(trial.clock - trial.start);
    }
    if (late.size() < 2) continue;
    squares += CalcMoments(late).sum_of_squares;
    df += static_cast<double>(late.size()) - 1.0;
  }
  return noise / count + (df > 0.0 ? (1.0 - kTrusted) * squares / df : 0.0);
}

}  // namespace

Answer<SharedTiming> CalcSharedTiming(const std::vector<SharedTimingRun>& runs) {
  if (runs.empty() || runs.front().front().contacts.size() < 2) return NoAnswer{"no two digits"};
  Differences differences = TakeDifferences(runs);
  const double rows = differences.weight;
  const double rank = Adjust(differences);
  SharedTiming timing;
  timing.df = differences.df - rank;
  if (timing.df < kLeastDf) {
    return NoAnswer{"only " + FormatFixed(std::max(0.0, timing.df), 0) +
                    " degrees of freedom beside what the transport explains; expected 5 or more"};
  }
  const double num_digits = static_cast<double>(differences.times.cols());
  const VectorXd means = differences.times.rowwise().mean();
  const double of_means = means.squaredNorm() / (rows - rank);
  const double own = (differences.times.colwise() - means).squaredNorm() /
                     ((rows - rank) * (num_digits - 1.0) * num_digits);
  timing.shared_sd = std::sqrt(std::max(0.0, of_means - own));
  // Both variances are estimates.
  const double own_df = timing.df * (num_digits - 1.0);
  const double low = of_means / CalcFisherQuantile(0.95, timing.df, own_df) - own;
  timing.shared_low_sd = std::sqrt(std::max(0.0, low));
  timing.alternating_sd =
      std::sqrt(std::max(0.0, CalcAlternating(means, differences.firsts) - own));
  timing.clock_sd = std::sqrt(BoundClock(runs));
  return timing;
}

}  // namespace graspbench
