#include "human_study/recording/cleaning/low_pass_trace.h"

#include <algorithm>
#include <cmath>

#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;

constexpr double kPi = 3.14159265358979323846;
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
