#include "human_study/recording/cleaning/butterworth.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "human_study/recording/cleaning/resample.h"

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

}  // namespace graspbench
