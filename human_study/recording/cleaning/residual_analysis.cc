#include "human_study/recording/cleaning/residual_analysis.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "human_study/recording/cleaning/butterworth.h"
#include "human_study/recording/cleaning/resample.h"

namespace graspbench {
namespace {

/** Value at 0 of the least-squares line through the points from `first` on. */
double CalcIntercept(const std::vector<double>& x, const std::vector<double>& y, size_t first) {
  const auto n = static_cast<double>(x.size() - first);
  double mean_x = 0.0, mean_y = 0.0, sxx = 0.0, sxy = 0.0;
  for (size_t i = first; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  for (size_t i = first; i < x.size(); ++i) {
    sxx += (x[i] - mean_x) * (x[i] - mean_x);
    sxy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  return mean_y - sxy / sxx * mean_x;
}

}  // namespace

ResidualAnalysis FindCutoff(const Trajectory& trajectory) {
  const std::vector<SampleRun> runs = FindValidRuns(trajectory);
  const auto longest =
      std::max_element(runs.begin(), runs.end(),
                       [](const SampleRun& a, const SampleRun& b) { return a.size() < b.size(); });
  const SamplingReport sampling = FindSampling(trajectory.times);
  if (longest == runs.end() || longest->size() < 2 || !sampling.is_even) {
    throw Error(ErrorKind::kRange,
                "residual analysis needs evenly spaced samples of a visible marker");
  }
  const double duration = trajectory.times[longest->last - 1] - trajectory.times[longest->first];
  const double rate = static_cast<double>(longest->size() - 1) / duration;
  if (duration < 1.0 || rate < 20.0) {
    throw Error(ErrorKind::kRange,
                "residual analysis needs one second without a gap at 20 Hz or more; the longest "
                "run is " +
                    std::to_string(duration) + " s at " + std::to_string(rate) + " Hz");
  }
  ResidualAnalysis analysis;
  const Eigen::Matrix3Xd p = trajectory.p.middleCols(static_cast<Eigen::Index>(longest->first),
                                                     static_cast<Eigen::Index>(longest->size()));
  for (double cutoff = 1.0; cutoff <= rate / 4.0; cutoff += 0.5) {
    const Biquad pass = MakeLowPass(cutoff, rate);
    const Eigen::Matrix3Xd taken_away = FilterZeroPhase(pass, p) - p;
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::VectorXd signal = taken_away.row(axis).transpose();
      sum += signal.squaredNorm();
    }
    analysis.cutoffs.push_back(cutoff);
    analysis.residuals.push_back(std::sqrt(sum / static_cast<double>(p.cols())));
  }
  analysis.noise = CalcIntercept(analysis.cutoffs, analysis.residuals, analysis.cutoffs.size() / 2);
  analysis.cutoff = std::nan("");
  for (size_t i = 0; i < analysis.cutoffs.size(); ++i) {
    if (analysis.residuals[i] > analysis.noise) continue;
    analysis.cutoff = analysis.cutoffs[i];
    if (i > 0) {  // between this cut-off and the one before
      const double fall = analysis.residuals[i - 1] - analysis.residuals[i];
      analysis.cutoff -= 0.5 * (analysis.noise - analysis.residuals[i]) / fall;
    }
    break;
  }
  return analysis;
}

}  // namespace graspbench
