#include "human_study/events/lift_off_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace graspbench {
namespace {

// Unknowns: rest r [m], drift c [m/s], then v, a, j, q, p of the lift.
constexpr int kNumLiftUnknowns = 7, kFirstOfLift = 2;
using LiftVector = Eigen::Matrix<double, kNumLiftUnknowns, 1>;
using LiftMatrix = Eigen::Matrix<double, kNumLiftUnknowns, kNumLiftUnknowns>;

constexpr int kNumStarts = 4;  // with a speed, an acceleration, a jerk, a snap
// Of lifts by 30 to 150 mm in 0.4 to 2 s, of load forces of 5 to 40 N/s on 0.1 to 1 kg.
const LiftVector kLiftSd = (LiftVector() << 5e-3, 3e-3, 0.05, 1.5, 40.0, 600.0, 6000.0).finished();
constexpr std::array<double, kNumStarts> kStartMean = {0.05, 1.5, 40.0, 600.0};

// How likely each start is, up to a factor.
const std::array<double, kNumStarts> kLogPrior = {std::log(0.25), std::log(0.25), std::log(0.35),
                                                  std::log(0.05)};
constexpr double kSearchBefore = 0.3, kSearchAfter = 0.12;  // of the other rule's instant [s]
constexpr double kRestBefore = 0.15;                        // seen before the search [s]
constexpr double kFullHeight = 0.007;  // the polynomial holds this far above the rest [m]
constexpr double kMostRise = 0.3;      // .. or this long after the other rule's instant [s]
constexpr double kOfHeight = 0.02;     // what the polynomial leaves out, share of the height
constexpr double kRocking = 0.05e-3;   // of a thing that is gripped before it leaves (RMS) [m] ..
constexpr double kRockingTime = 0.02;  // .. and for how long it is the same [s]
constexpr double kCoarseStep = 8e-3, kFineStep = 1e-3;  // between the instants tried [s]
constexpr double kLiftModel = 2.5e-3;                   // SD of what no model says [s]
constexpr size_t kFewestBefore = 3, kFewestAfter = 3;

struct LiftSamples {
  std::vector<double> times, heights, weights;
  double first = 0.0, last = 0.0;  // of the search [s]
};

LiftSamples TakeLift(const ScalarCurve& height, double near) {
  LiftSamples samples;
  // As if each sample had its own, of which as many as last that long have the same mean.
  const double rocking = kRocking * kRocking * std::max(1.0, kRockingTime / height.Interval());
  double rest = 0.0, num_rest = 0.0;
  const double begin = near - kSearchBefore - kRestBefore;
  const SampleRun run = FindSamples(height.times, begin, near + kMostRise);
  for (size_t i = run.first; i < run.last; ++i) {
    if (height.states[i] != SampleState::kMeasured) continue;
    if (height.times[i] > near - kSearchBefore) break;
    rest += height.At(i);
    num_rest += 1.0;
  }
  if (num_rest > 0.0) rest /= num_rest;
  for (size_t i = run.first; i < run.last; ++i) {
    if (height.states[i] != SampleState::kMeasured) continue;
    const double risen = std::max(0.0, height.At(i) - rest);
    if (height.times[i] > near && risen > kFullHeight && samples.times.size() >= kFewestBefore &&
        samples.times[samples.times.size() - kFewestAfter] > near) {
      break;
    }
    samples.times.push_back(height.times[i]);
    samples.heights.push_back(height.At(i));
    const double model = kOfHeight * risen;
    samples.weights.push_back(1.0 / (height.noise * height.noise + rocking + model * model));
  }
  if (samples.times.size() < kFewestBefore + kFewestAfter) return samples;
  samples.first = std::max(near - kSearchBefore, samples.times[kFewestBefore - 1]);
  samples.last = std::min(near + kSearchAfter, samples.times[samples.times.size() - kFewestAfter]);
  return samples;
}

/** One lift-off that was tried: how likely it is for each start. */
struct TriedLift {
  double time = 0.0;
  std::array<double, kNumStarts> log_evidence{};
};

class LiftFitter {
 public:
  explicit LiftFitter(const LiftSamples& samples) : samples_(samples) {}

  TriedLift Try(double t0) {
    LiftMatrix products = LiftMatrix::Zero();
    LiftVector with_height = LiftVector::Zero();
    double squares = 0.0;
    for (size_t i = 0; i < samples_.times.size(); ++i) {
      const double s = samples_.times[i] - t0, weight = samples_.weights[i];
      LiftVector basis = LiftVector::Zero();
      basis[0] = 1.0;
      basis[1] = s;
      if (s > 0.0) {
        basis[kFirstOfLift] = s;
        for (int k = kFirstOfLift + 1; k < kNumLiftUnknowns; ++k) {
          basis[k] = basis[k - 1] * s / (k - kFirstOfLift + 1);
        }
      }
      products.noalias() += weight * basis * basis.transpose();
      with_height += weight * samples_.heights[i] * basis;
      squares += weight * samples_.heights[i] * samples_.heights[i];
    }
    TriedLift tried;
    tried.time = t0;
    for (int start = 0; start < kNumStarts; ++start) {
      tried.log_evidence[static_cast<size_t>(start)] =
          CalcLogEvidence(products, with_height, squares, start);
    }
    return tried;
  }

  double least_misfit() const { return least_misfit_; }

 private:
  double CalcLogEvidence(const LiftMatrix& products, const LiftVector& with_height, double squares,
                         int start) {
    LiftVector sd = kLiftSd, mean = LiftVector::Zero();
    for (int k = 0; k < start; ++k) sd[kFirstOfLift + k] = 1e-6 * kLiftSd[kFirstOfLift + k];
    const int own = kFirstOfLift + start;
    mean[own] = kStartMean[static_cast<size_t>(start)];
    const LiftMatrix A = products + LiftMatrix(sd.cwiseInverse().cwiseAbs2().asDiagonal());
    const LiftVector b = with_height + mean.cwiseQuotient(sd.cwiseAbs2());
    const Eigen::LLT<LiftMatrix> llt(A);
    const LiftVector unknowns = llt.solve(b);
    if (unknowns[own] < 0.0) return -INFINITY;  // it does not rise
    const double misfit = squares + mean.cwiseQuotient(sd).squaredNorm() - b.dot(unknowns);
    least_misfit_ = std::min(least_misfit_, misfit);
    return kLogPrior[static_cast<size_t>(start)] - 0.5 * misfit -
           llt.matrixLLT().diagonal().array().log().sum() - sd.array().log().sum();
  }

  const LiftSamples& samples_;
  double least_misfit_ = INFINITY;
};

std::vector<TriedLift> TryLifts(LiftFitter& fitter, double first, double last, double step) {
  std::vector<TriedLift> tried;
  const int num_steps = std::max(1, static_cast<int>(std::ceil((last - first) / step)));
  for (int i = 0; i <= num_steps; ++i) {
    tried.push_back(fitter.Try(first + (last - first) * i / num_steps));
  }
  return tried;
}

double FindBestLift(const std::vector<TriedLift>& tried) {
  double best = -INFINITY;
  for (const TriedLift& lift : tried) {
    best = std::max(best, *std::max_element(lift.log_evidence.begin(), lift.log_evidence.end()));
  }
  return best;
}

}  // namespace

EventTime FitLiftOff(const ScalarCurve& height, double near) {
  constexpr double kUnlikelyLift = 14.0;  // e^-14
  const LiftSamples samples = TakeLift(height, near);
  if (!(samples.first < samples.last)) {
    return MissingEvent("too few measured samples before or after the lift-off");
  }
  LiftFitter fitter(samples);
  const std::vector<TriedLift> coarse = TryLifts(fitter, samples.first, samples.last, kCoarseStep);
  double best = FindBestLift(coarse);
  if (!std::isfinite(best)) return MissingEvent("the object does not rise where it should");
  double first = samples.last, last = samples.first;
  for (const TriedLift& lift : coarse) {
    const auto& evidence = lift.log_evidence;
    if (*std::max_element(evidence.begin(), evidence.end()) < best - kUnlikelyLift) continue;
    first = std::min(first, lift.time - kCoarseStep);
    last = std::max(last, lift.time + kCoarseStep);
  }
  const std::vector<TriedLift> tried =
      TryLifts(fitter, std::max(first, samples.first), std::min(last, samples.last), kFineStep);
  best = FindBestLift(tried);
  double sum = 0.0, moment = 0.0, squares = 0.0;
  for (const TriedLift& lift : tried) {
    for (const double evidence : lift.log_evidence) {
      const double weight = std::exp(evidence - best), time = lift.time - near;
      sum += weight;
      moment += weight * time;
      squares += weight * time * time;
    }
  }
  EventTime event;
  event.time = near + moment / sum;
  const double variance = std::max(0.0, squares / sum - moment / sum * moment / sum);
  const double ratio = std::sqrt(fitter.least_misfit() / static_cast<double>(samples.times.size()));
  event.uncertainty = std::hypot(kLiftModel, std::max(1.0, ratio) * std::sqrt(variance));
  const auto after = std::lower_bound(samples.times.begin(), samples.times.end(), event.time);
  if (after != samples.times.begin() && after != samples.times.end()) {
    event.is_in_gap = *after - *(after - 1) > 1.5 * height.Interval();
  }
  event.is_filled = HasFilledNear(height, event.time);
  return event;
}

}  // namespace graspbench
