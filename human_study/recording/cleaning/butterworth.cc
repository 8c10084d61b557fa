#include "human_study/recording/cleaning/butterworth.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

namespace {

/** Both passes in place over signals side by side, a column a sample. Each sample waits for the one
before it, so that four signals take little longer than one. */
template <int kNumSignals>
void FilterBothWays(const Biquad& f, double* samples, Eigen::Index count) {
  using Sample = Eigen::Array<double, kNumSignals, 1>;
  const auto pass = [&](double* at, Eigen::Index step) {
    // At rest on the first value: past inputs and outputs equal it, as the gain at 0 Hz is one.
    Sample x1 = Eigen::Map<const Sample>(at), x2 = x1, y1 = x1, y2 = x1;
    for (Eigen::Index n = 0; n < count; ++n, at += step) {
      const Sample x = Eigen::Map<const Sample>(at);
      const Sample y = f.b0 * x + f.b1 * x1 + f.b2 * x2 - f.a1 * y1 - f.a2 * y2;
      Eigen::Map<Sample> out(at);
      out = y;
      x2 = x1;
      x1 = x;
      y2 = y1;
      y1 = y;
    }
  };
  pass(samples, kNumSignals);
  pass(samples + (count - 1) * kNumSignals, -kNumSignals);
}

/** Samples until the slower pole has decayed to 1e-6. */
Eigen::Index CalcSettlingLength(const Biquad& pass) {
  const double radius = std::sqrt(std::max(pass.a2, 1e-12));  // complex pole pair
  return static_cast<Eigen::Index>(std::ceil(std::log(1e-6) / std::log(radius)));
}

}  // namespace

Biquad MakeLowPass(double cutoff, double rate) {
  const double pass_correction = std::pow(std::sqrt(2.0) - 1.0, 0.25);
  if (!(cutoff > 0.0 && cutoff < 0.8 * rate / 2.0)) {
    throw Error(
        ErrorKind::kRange,
        fmt::format("the cut-off is {:.6g} Hz; expected more than 0 and less than {:.6g} Hz, "
                    "80 % of half the sampling rate of {:.6g} Hz",
                    cutoff, 0.4 * rate, rate));
  }
  const double w = std::tan(kPi * cutoff / rate) / pass_correction;
  const double scale = 1.0 + std::sqrt(2.0) * w + w * w;
  Biquad pass;
  pass.b0 = w * w / scale;
  pass.b1 = 2.0 * pass.b0;
  pass.b2 = pass.b0;
  pass.a1 = 2.0 * (w * w - 1.0) / scale;
  pass.a2 = (1.0 - std::sqrt(2.0) * w + w * w) / scale;
  return pass;
}

namespace {

/** As FilterZeroPhase of each row; kNumSignals: as many rows or more. */
template <int kNumSignals, class Signals>
Signals FilterRows(const Biquad& pass, const Signals& signals) {
  const Eigen::Index count = signals.cols(), num_signals = signals.rows();
  if (count < 2) return signals;
  const Eigen::Index pad = std::min(CalcSettlingLength(pass), count - 1);
  Eigen::Matrix<double, kNumSignals, Eigen::Dynamic, kNumSignals == 1 ? Eigen::RowMajor : 0> padded(
      kNumSignals, count + 2 * pad);
  padded.bottomRows(kNumSignals - num_signals).setZero();
  for (Eigen::Index i = 0; i < pad; ++i) {
    padded.col(i).head(num_signals) = 2.0 * signals.col(0) - signals.col(pad - i);
    padded.col(pad + count + i).head(num_signals) =
        2.0 * signals.col(count - 1) - signals.col(count - 2 - i);
  }
  padded.block(0, pad, num_signals, count) = signals;
  FilterBothWays<kNumSignals>(pass, padded.data(), padded.cols());
  return padded.block(0, pad, num_signals, count);
}

}  // namespace

Eigen::VectorXd FilterZeroPhase(const Biquad& pass, const Eigen::VectorXd& signal) {
  return FilterRows<1, Eigen::RowVectorXd>(pass, signal.transpose()).transpose();
}

Eigen::Matrix3Xd FilterZeroPhase(const Biquad& pass, const Eigen::Matrix3Xd& signals) {
  return FilterRows<4>(pass, signals);
}

void FilterLowPass(Trajectory& trajectory, double cutoff) {
  if (trajectory.size() < 2) return;
  const SamplingReport sampling = FindSampling(trajectory.times);
  if (!sampling.is_even) {
    throw Error(ErrorKind::kRange,
                "the samples are not evenly spaced; resample the trajectory before filtering it");
  }
  const double rate = static_cast<double>(trajectory.size() - 1) /
                      (trajectory.times.back() - trajectory.times.front());
  const Biquad pass = MakeLowPass(cutoff, rate);
  for (const SampleRun& run : FindValidRuns(trajectory)) {
    auto part = trajectory.p.middleCols(static_cast<Eigen::Index>(run.first),
                                        static_cast<Eigen::Index>(run.size()));
    part = FilterZeroPhase(pass, Eigen::Matrix3Xd(part));
  }
}

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

namespace {

using Column = Eigen::Index;

constexpr double kStretch = 0.5;        // [s]
constexpr double kLeastRms = 2e-6;      // of a stretch that tells something [m]
constexpr double kQuietShare = 0.34;    // of the stretches, the least moved ones
constexpr size_t kEnoughStretches = 4;  // quiet ones
constexpr double kFiltered = 20.0;      // ratio of the two bands' power
constexpr double kLeakage =
    1e-6;  // of the strongest harmonic's power, what the window lets through
constexpr size_t kMostTracks = 6;

struct Stretch {
  Eigen::Matrix3Xd values;  // straight line and ends taken out
  double rms = 0.0;         // [m]
};

/** Half a second without a missing sample, less a straight line, behind a Hann window. */
void AddStretches(const Trajectory& track, size_t length, std::vector<Stretch>& stretches) {
  for (size_t first = 0; first + length <= track.size(); first += length) {
    bool is_measured = true;
    for (size_t i = first; i < first + length; ++i) {
      is_measured &= track.states[i] == SampleState::kMeasured;
    }
    if (!is_measured) continue;
    const auto n = static_cast<Column>(length);
    Stretch stretch{track.p.middleCols(static_cast<Column>(first), n), 0.0};
    Eigen::MatrixXd line(n, 2);
    line.col(0).setOnes();
    line.col(1).setLinSpaced(-1.0, 1.0);
    const Eigen::MatrixXd on_line = stretch.values * line;
    const Eigen::Vector2d squares = line.colwise().squaredNorm();
    stretch.values -= on_line * squares.cwiseInverse().asDiagonal() * line.transpose();
    stretch.rms = std::sqrt(stretch.values.squaredNorm() / (3.0 * static_cast<double>(n)));
    for (Column i = 0; i < n; ++i) {
      stretch.values.col(i) *=
          0.5 - 0.5 * std::cos(2.0 * kPi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
    }
    stretches.push_back(std::move(stretch));
  }
}

/** Of the k-th harmonic of the stretch, over the axes. */
double CalcPower(const Stretch& stretch, int k) {
  const Column n = stretch.values.cols();
  const double step = 2.0 * kPi * k / static_cast<double>(n);
  Eigen::Vector3d real = Eigen::Vector3d::Zero(), imaginary = Eigen::Vector3d::Zero();
  // Goertzel's recurrence needs one cosine.
  const double twice = 2.0 * std::cos(step);
  for (Column i = 0; i < n; ++i) {
    const Eigen::Vector3d next = stretch.values.col(i) + twice * real - imaginary;
    imaginary = real;
    real = next;
  }
  return (real.cwiseAbs2() + imaginary.cwiseAbs2() - twice * real.cwiseProduct(imaginary)).sum();
}

double CalcBandPower(const Stretch& stretch, double rate, double low, double high) {
  const double spacing = rate / static_cast<double>(stretch.values.cols());
  double sum = 0.0, count = 0.0;
  for (int k = static_cast<int>(std::ceil(low / spacing)); k * spacing <= high; ++k) {
    sum += CalcPower(stretch, k);
    count += 1.0;
  }
  return sum / count;
}

/** Misfit of the logarithm of power to that of white noise behind a Butterworth filter of second
order that is passed once or twice. */
double CalcMisfit(const std::vector<double>& frequencies, const std::vector<double>& log_power,
                  double rate, double cutoff, int num_passes) {
  std::vector<double> rest;
  for (size_t i = 0; i < frequencies.size(); ++i) {
    const double ratio = std::tan(kPi * frequencies[i] / rate) / std::tan(kPi * cutoff / rate);
    rest.push_back(log_power[i] + num_passes * std::log1p(std::pow(ratio, 4.0)));
  }
  return CalcMoments(rest).sum_of_squares;
}

double FitCutoff(const std::vector<Stretch>& quiet, double rate) {
  constexpr double kSlowest = 3.0;  // below people sway [Hz]
  const double spacing = rate / static_cast<double>(quiet.front().values.cols());
  double strongest = 0.0;
  std::vector<double> frequencies, log_power;
  for (int k = static_cast<int>(std::ceil(kSlowest / spacing)); k * spacing < 0.4 * rate; ++k) {
    std::vector<double> powers;
    for (const Stretch& stretch : quiet) powers.push_back(CalcPower(stretch, k));
    const double power = CalcMedian(std::move(powers));
    strongest = std::max(strongest, power);
    if (power < kLeakage * strongest) break;
    frequencies.push_back(k * spacing);
    log_power.push_back(std::log(power));
  }
  double best = std::nan(""), least = INFINITY;
  for (const int num_passes : {1, 2}) {
    for (double cutoff = 2.0; cutoff < 0.2 * rate; cutoff *= 1.05) {
      const double misfit = CalcMisfit(frequencies, log_power, rate, cutoff, num_passes);
      if (misfit >= least) continue;
      least = misfit;
      // Two passes halve the power where one takes away 29 % of it.
      best = num_passes == 1 ? cutoff : cutoff * std::pow(std::sqrt(2.0) - 1.0, 0.25);
    }
  }
  return best;
}

}  // namespace

double FindLowPassTrace(const std::vector<const Trajectory*>& tracks) {
  if (tracks.empty() || tracks.front()->size() < 2) return std::nan("");
  const std::vector<double>& times = tracks.front()->times;
  const double rate = static_cast<double>(times.size() - 1) / (times.back() - times.front());
  const auto length = static_cast<size_t>(std::lround(kStretch * rate));
  // A tremor of up to 12 Hz does not reach through the window to 14 Hz.
  const double low = rate < 100.0 ? 14.0 : 15.0, high = rate < 100.0 ? 0.275 * rate : 25.0;
  if (!(high > low + 1.0)) return std::nan("");  // too slow to have both bands
  std::vector<Stretch> stretches;
  const size_t step = (tracks.size() + kMostTracks - 1) / kMostTracks;
  for (size_t i = 0; i < tracks.size(); i += step) AddStretches(*tracks[i], length, stretches);
  std::sort(stretches.begin(), stretches.end(),
            [](const Stretch& a, const Stretch& b) { return a.rms < b.rms; });
  const auto num_quiet =
      static_cast<size_t>(std::ceil(kQuietShare * static_cast<double>(stretches.size())));
  stretches.erase(stretches.begin() + static_cast<std::ptrdiff_t>(num_quiet), stretches.end());
  stretches.erase(std::remove_if(stretches.begin(), stretches.end(),
                                 [](const Stretch& stretch) { return !(stretch.rms > kLeastRms); }),
                  stretches.end());
  if (stretches.size() < kEnoughStretches) return std::nan("");
  std::vector<double> ratios;
  for (const Stretch& stretch : stretches) {
    const double fast = CalcBandPower(stretch, rate, 0.3 * rate, 0.45 * rate);
    if (fast > 0.0) ratios.push_back(CalcBandPower(stretch, rate, low, high) / fast);
  }
  if (ratios.empty() || !(CalcMedian(std::move(ratios)) > kFiltered)) return std::nan("");
  return FitCutoff(stretches, rate);
}

}  // namespace graspbench
