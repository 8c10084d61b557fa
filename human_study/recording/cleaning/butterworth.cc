#include "human_study/recording/cleaning/butterworth.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "human_study/recording/cleaning/resample.h"

namespace graspbench {
namespace {

Eigen::VectorXd FilterForwards(const Biquad& f, const Eigen::VectorXd& x) {
  Eigen::VectorXd y(x.size());
  // At rest on the first value: past inputs and outputs equal it, as the gain at 0 Hz is one.
  double x1 = x[0], x2 = x[0], y1 = x[0], y2 = x[0];
  for (Eigen::Index n = 0; n < x.size(); ++n) {
    y[n] = f.b0 * x[n] + f.b1 * x1 + f.b2 * x2 - f.a1 * y1 - f.a2 * y2;
    x2 = x1;
    x1 = x[n];
    y2 = y1;
    y1 = y[n];
  }
  return y;
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

Eigen::VectorXd FilterZeroPhase(const Biquad& pass, const Eigen::VectorXd& signal) {
  const Eigen::Index count = signal.size();
  if (count < 2) return signal;
  const Eigen::Index pad = std::min(CalcSettlingLength(pass), count - 1);
  Eigen::VectorXd padded(count + 2 * pad);
  for (Eigen::Index i = 0; i < pad; ++i) {
    padded[i] = 2.0 * signal[0] - signal[pad - i];
    padded[pad + count + i] = 2.0 * signal[count - 1] - signal[count - 2 - i];
  }
  padded.segment(pad, count) = signal;
  const Eigen::VectorXd forwards = FilterForwards(pass, padded);
  const Eigen::VectorXd backwards = FilterForwards(pass, forwards.reverse());
  return backwards.reverse().segment(pad, count);
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
    for (int axis = 0; axis < 3; ++axis) {
      auto segment = trajectory.p.row(axis).segment(static_cast<Eigen::Index>(run.first),
                                                    static_cast<Eigen::Index>(run.size()));
      segment = FilterZeroPhase(pass, segment.transpose()).transpose();
    }
  }
}

}  // namespace graspbench
