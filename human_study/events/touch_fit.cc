#include "human_study/events/touch_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.h"

namespace graspbench {
namespace {

// Unknowns: rest r [m], drift c [m/s], speed v [m/s], and the next four derivatives of the approach.
constexpr int kRest = 0, kSpeed = 1, kDrift = 6, kNumUnknowns = 7, kNumBefore = 6;
using Vector = Eigen::Matrix<double, kNumUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kNumUnknowns, kNumUnknowns>;

// Of reaches along minimum-jerk paths that close by 20 to 40 mm in 0.25 to 0.45 s.
const Vector kPriorMean = (Vector() << 0.0, 0.05, 0.8, 10.0, -400.0, 3000.0, 0.0).finished();
const Vector kPriorSd = (Vector() << 2e-3, 0.15, 1.2, 30.0, 600.0, 4000.0, 2e-3).finished();
// What the model leaves out grows with the distance from the bracket.
constexpr double kBeforeGrowth = 3.0;     // [m/s^3]
constexpr double kAfterGrowth = 0.1;      // [m/s^2]: a phalanx that turns on its pad
constexpr double kTremorRate = 60.0;      // of 9.5 Hz [rad/s]
constexpr double kHeldTremor = 0.6;       // share of a tremor that a digit keeps as it settles
constexpr double kPadTolerance = 0.5e-3;  // of a given pad offset [m]
constexpr double kModel = 0.5e-3;         // SD of what no model says [s]
constexpr double kLearnedShare = 1.5;     // of the time by which learned depths move a touch ..
constexpr double kMostLearned = 0.02;     // .. and no more, as deep settling is seen as such [s]
constexpr double kToe = 0.55e-3, kToeSd = 0.28e-3;  // skin that gives way unseen [m]
constexpr double kLongestToe = 0.3;                 // [s]
/** A stop that is slow, and long after the digit came within reach, is not always the touch. */
constexpr double kSlowShare = 0.7, kSlowSpeed = 0.04, kFreeSpeed = 0.06;         // [m/s]
constexpr double kSoon = 0.06, kLate = 0.14, kQuickRest = 0.4, kSlowRest = 0.6;  // [s]
/** Of noise beyond what cameras have, by which slow touches seem to come early. */
constexpr double kNoisyShare = 0.75, kPlainNoise = 0.6e-3;  // [m]
constexpr double kMinStep = 0.5e-3;                         // between the touches tried [s]
constexpr double kMaxStep = 4e-3;
constexpr size_t kCoarseDepths = 3;  // every third depth tells where to look closer
constexpr double kVolume = 0.6;
constexpr double kUsualSpeed = 0.08;
constexpr double kMinSpeed = 5e-3;  // slower is no approach [m/s]
constexpr size_t kMinSamples = 6;

double Square(double x) { return x * x; }

using BeforeMatrix = Eigen::Matrix<double, kNumBefore, kNumBefore>;
using BeforeVector = Eigen::Matrix<double, kNumBefore, 1>;

/** Sums of weighted products of 1, s, s^2/2, .., s^5/120 over the samples before a touch. */
struct BeforeSums {
  BeforeMatrix products = BeforeMatrix::Zero();
  BeforeVector with_place = BeforeVector::Zero();
  double places = 0.0;
};

/** How far the object has gone by itself, and how fast it goes, at an instant. */
struct ObjectMotion {
  double way = 0.0;   ///< [m]
  double rate = 0.0;  ///< [m/s]
};

double InterpolateMotion(const TouchSamples& samples, double time) {
  const std::vector<double>& times = samples.times;
  const auto last = static_cast<size_t>(
      std::clamp<std::ptrdiff_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin(),
                                 1, static_cast<std::ptrdiff_t>(times.size()) - 1));
  const double share =
      std::clamp((time - times[last - 1]) / (times[last] - times[last - 1]), 0.0, 1.0);
  return (1.0 - share) * samples.object_motion[last - 1] + share * samples.object_motion[last];
}

/** The rate is that over two samples about the instant: one interval's would jump at each sample,
and so would what the touch is believed to be. */
ObjectMotion FindObjectMotion(const TouchSamples& samples, double tc) {
  if (samples.object_motion.empty()) return {};
  const double step = (samples.times.back() - samples.times.front()) /
                      static_cast<double>(samples.times.size() - 1);
  const double rate =
      (InterpolateMotion(samples, tc + step) - InterpolateMotion(samples, tc - step)) /
      (2.0 * step);
  return {InterpolateMotion(samples, tc), rate};
}

/** Inverse variances. They do not depend on the touch that is tried, so that it is not preferred
for making the samples uncertain. */
std::vector<double> CalcWeights(const TouchSamples& samples) {
  std::vector<double> weights;
  for (const double time : samples.times) {
    const double before = std::max(0.0, samples.first - time);
    const double after = std::max(0.0, time - samples.last);
    const double model = kBeforeGrowth * before * before * before + kAfterGrowth * after * after;
    weights.push_back(
        1.0 / (Square(samples.noise) + Square(kHeldTremor * samples.tremor) + Square(model)));
  }
  return weights;
}

/** A tremor adds to each derivative of the approach what it itself has of it. */
Vector CalcPriorSd(const TouchSamples& samples) {
  Vector prior_sd = kPriorSd;
  double derivative = samples.tremor;
  for (int k = kSpeed; k < kNumBefore; ++k) {
    derivative *= kTremorRate;
    prior_sd[k] = std::hypot(prior_sd[k], derivative);
  }
  prior_sd[kRest] = std::hypot(prior_sd[kRest], samples.tremor);
  return prior_sd;
}

BeforeSums SumBefore(const TouchSamples& samples, const std::vector<double>& weights, size_t count,
                     double tc, double object_way) {
  BeforeSums sums;
  for (size_t i = 0; i < count; ++i) {
    const double s = tc - samples.times[i];
    const double moved = samples.object_motion.empty() ? 0.0 : samples.object_motion[i];
    const double y = samples.places[i] + moved - object_way;
    const double weight = weights[i];
    BeforeVector basis;
    basis[0] = 1.0;
    for (int k = 1; k < kNumBefore; ++k) basis[k] = basis[k - 1] * s / k;
    sums.products.noalias() += weight * basis * basis.transpose();
    sums.with_place += weight * y * basis;
    sums.places += weight * y * y;
  }
  return sums;
}

/** The normal equations of the unknowns, priors included. */
struct Equations {
  explicit Equations(const Vector& prior_sd)
      : A(prior_sd.cwiseInverse().cwiseAbs2().asDiagonal()),
        b(kPriorMean.cwiseQuotient(prior_sd.cwiseAbs2())),
        squares(kPriorMean.cwiseQuotient(prior_sd).squaredNorm()) {}
  Matrix A;
  Vector b;
  double squares;

  /** @param known  tau w: the depth by which the object's own motion drives the digit in. */
  void AddBefore(BeforeSums sums, double tau, double known) {
    sums.places += known * (known * sums.products(kRest, kRest) - 2.0 * sums.with_place[kRest]);
    sums.with_place -= known * sums.products.col(kRest);
    // The column of v is s + tau.
    BeforeMatrix products = sums.products;
    products.row(kSpeed) += tau * products.row(kRest);
    products.col(kSpeed) += tau * products.col(kRest);
    A.topLeftCorner<kNumBefore, kNumBefore>() += products;
    b.head<kNumBefore>() += sums.with_place;
    b[kSpeed] += tau * sums.with_place[kRest];
    squares += sums.places;
  }

  void AddAfter(const TouchSamples& samples, const std::vector<double>& weights, size_t first,
                double tc, double tau, double known) {
    double decay = 0.0, step = -1.0, factor = 0.0;
    for (size_t i = first; i < samples.times.size(); ++i) {
      const double since = samples.times[i] - tc;
      if (tau > 0.0) {
        const double interval = i == first ? since : samples.times[i] - samples.times[i - 1];
        if (std::abs(interval - step) > 1e-9) factor = std::exp(-(step = interval) / tau);
        decay = i == first ? factor : decay * factor;
      }
      const double weight = weights[i];
      const double sunk = tau * decay;
      const double y = samples.places[i] - known * decay;
      A(kRest, kRest) += weight;
      A(kRest, kSpeed) += weight * sunk;
      A(kRest, kDrift) += weight * since;
      A(kSpeed, kSpeed) += weight * sunk * sunk;
      A(kSpeed, kDrift) += weight * sunk * since;
      A(kDrift, kDrift) += weight * since * since;
      b[kRest] += weight * y;
      b[kSpeed] += weight * y * sunk;
      b[kDrift] += weight * y * since;
      squares += weight * y * y;
    }
  }

  /** The clearance at the touch is known. */
  void AddTouchPlace(double given, double tau, double known) {
    const double place = given - known;
    const double weight = 1.0 / Square(kPadTolerance);
    A(kRest, kRest) += weight;
    A(kRest, kSpeed) += weight * tau;
    A(kSpeed, kSpeed) += weight * tau * tau;
    b[kRest] += weight * place;
    b[kSpeed] += weight * place * tau;
    squares += weight * place * place;
  }

  struct Solution {
    Vector unknowns;
    double misfit;  ///< weighted squares that are left
    double log_evidence;
  };
  Solution Solve() const {
    const Eigen::LLT<Matrix> llt(A.transpose());  // of the lower triangle
    Solution solution;
    solution.unknowns = llt.solve(b);
    solution.misfit = squares - b.dot(solution.unknowns);
    const double log_root = llt.matrixLLT().diagonal().array().log().sum();
    solution.log_evidence = -0.5 * solution.misfit - kVolume * log_root;
    return solution;
  }
};

/** One touch that was tried: its speed without sinking, and how likely it is for each depth. */
struct Trial {
  double time = 0.0;
  std::array<double, kSettlingDepths.size()> log_evidence{};
  std::array<double, kSettlingDepths.size()> speed{};  ///< against the object [m/s]
};

class Fitter {
 public:
  explicit Fitter(const TouchSamples& samples)
      : samples_(samples), weights_(CalcWeights(samples)), prior_sd_(CalcPriorSd(samples)) {}

  Trial Try(double tc, size_t depth_step) {
    Trial trial;
    trial.time = tc;
    trial.log_evidence.fill(-INFINITY);
    constexpr double kFitTick = 1e-9;  // [s] rounding of the clock decides nothing
    const size_t num_before = static_cast<size_t>(
        std::lower_bound(samples_.times.begin(), samples_.times.end(), tc - kFitTick) -
        samples_.times.begin());
    const ObjectMotion object = FindObjectMotion(samples_, tc);
    const BeforeSums before = SumBefore(samples_, weights_, num_before, tc, object.way);
    double speed = 0.0;  // against the object
    for (size_t k = 0; k < kSettlingDepths.size(); k += depth_step) {
      const double tau = k == 0 ? 0.0 : kSettlingDepths[k] / std::max(kMinSpeed, speed);
      const double known = tau * object.rate;
      Equations equations(prior_sd_);
      equations.AddBefore(before, tau, known);
      equations.AddAfter(samples_, weights_, num_before, tc, tau, known);
      if (!std::isnan(samples_.touch_place)) {
        equations.AddTouchPlace(samples_.touch_place - kToe, tau, known);
      }
      const Equations::Solution solution = equations.Solve();
      speed = solution.unknowns[kSpeed] + object.rate;
      trial.log_evidence[k] = speed < kMinSpeed ? -INFINITY : solution.log_evidence;
      least_misfit_ = std::min(least_misfit_, solution.misfit);
      trial.speed[k] = speed;
    }
    return trial;
  }

  /** Touches from `first` to `last`. */
  std::vector<Trial> TryAll(double first, double last, double step, size_t depth_step = 1) {
    std::vector<Trial> trials;
    const int num_steps = std::max(1, static_cast<int>(std::ceil((last - first) / step - 1e-6)));
    for (int i = 0; i <= num_steps; ++i) {
      trials.push_back(Try(first + (last - first) * i / num_steps, depth_step));
    }
    return trials;
  }

  double least_misfit() const { return least_misfit_; }

 private:
  const TouchSamples& samples_;
  std::vector<double> weights_;
  Vector prior_sd_;
  double least_misfit_ = INFINITY;
};

double FindBest(const std::vector<Trial>& trials) {
  double best = -INFINITY;
  for (const Trial& trial : trials) {
    for (const double value : trial.log_evidence) best = std::max(best, value);
  }
  return best;
}

/** The stretch outside of which nothing is likely. */
std::pair<double, double> FindLikely(const std::vector<Trial>& trials) {
  constexpr double kUnlikely = 14.0;  // e^-14
  const double best = FindBest(trials);
  size_t first = trials.size(), last = 0;
  for (size_t i = 0; i < trials.size(); ++i) {
    const auto& evidence = trials[i].log_evidence;
    if (*std::max_element(evidence.begin(), evidence.end()) < best - kUnlikely) continue;
    first = std::min(first, i);
    last = i;
  }
  return {trials[first == 0 ? 0 : first - 1].time,
          trials[std::min(last + 1, trials.size() - 1)].time};
}

/** Of the touch over all depths; weight 0: none explains the path. */
struct TouchMoments {
  double weight = 0.0, time = 0.0, variance = 0.0;
};

TouchMoments CalcTouchMoments(const TouchFit& fit, const DepthWeights& weights) {
  const double best = *std::max_element(fit.log_evidence.begin(), fit.log_evidence.end());
  const double origin = fit.time[0];
  double sum = 0.0, moment = 0.0, squares = 0.0;
  for (size_t k = 0; k < weights.size(); ++k) {
    const double weight = weights[k] * std::exp(fit.log_evidence[k] - best);
    const double time = fit.time[k] - origin;
    sum += weight;
    moment += weight * time;
    squares += weight * (time * time + fit.variance[k]);
  }
  if (!(sum > 0.0)) return {};
  return {sum, origin + moment / sum, std::max(0.0, squares / sum - Square(moment / sum))};
}

/** What a slow touch, which is anywhere within reach in its share, adds to a time [s]. */
struct SlowTouch {
  double later = 0.0, sd = 0.0;
};

SlowTouch CalcSlowTouch(const TouchFit& fit, double touch) {
  const auto rise = [](double x, double from, double to) {
    return std::clamp((x - from) / (to - from), 0.0, 1.0);
  };
  const double since = touch - fit.earliest;
  const double slow_rest = rise(fit.latest - fit.earliest, kQuickRest, kSlowRest);
  const double share = kSlowShare * rise(-fit.speed, -kFreeSpeed, -kSlowSpeed) *
                       std::max(rise(since, kSoon, kLate), slow_rest);
  const double within = since + slow_rest * (fit.latest - touch);
  const double apart = within / 2.0 - since;
  return {share * apart,
          std::sqrt(share * Square(within) / 12.0 + share * (1.0 - share) * Square(apart))};
}

}  // namespace

const DepthWeights kUsualDepths = {30.0, 12.0, 0.8, 0.15, 0.06, 0.04, 0.03, 0.02};

TouchFit FitTouch(const TouchSamples& samples) {
  GRASPBENCH_DEMAND(samples.times.size() == samples.places.size() && samples.first < samples.last,
                    std::to_string(samples.times.size()));
  TouchFit fit;
  if (samples.times.size() < kMinSamples || samples.times.front() > samples.first ||
      samples.times.back() < samples.last) {
    fit.missing = "too few measured samples before or after the contact";
    return fit;
  }
  Fitter fitter(samples);
  const std::vector<Trial> coarse =
      fitter.TryAll(samples.first, samples.last, kMaxStep, kCoarseDepths);
  if (!std::isfinite(FindBest(coarse))) {
    fit.missing = "it does not come nearer where it should touch";
    return fit;
  }
  const auto [first, last] = FindLikely(coarse);
  const double step = std::clamp(0.8 * samples.noise / kUsualSpeed, kMinStep, kMaxStep);
  const std::vector<Trial> trials = fitter.TryAll(first, last, step);
  const double best = FindBest(trials);
  double all = 0.0, speeds = 0.0;
  for (size_t k = 0; k < kSettlingDepths.size(); ++k) {
    double sum = 0.0, moment = 0.0, squares = 0.0;
    for (const Trial& trial : trials) {
      const double weight = std::exp(trial.log_evidence[k] - best);
      const double time = trial.time - first;
      sum += weight;
      moment += weight * time;
      squares += weight * time * time;
      speeds += weight * trial.speed[k];
    }
    all += sum;
    // Of a bracket with one depth only, others say nothing.
    fit.log_evidence[k] = sum > 0.0 ? std::log(sum) : -INFINITY;
    fit.time[k] = sum > 0.0 ? first + moment / sum : samples.first;
    fit.variance[k] = sum > 0.0 ? std::max(0.0, squares / sum - Square(moment / sum)) : 0.0;
  }
  const double speed = speeds / all;
  fit.toe = std::min(kToe / speed, kLongestToe);
  fit.toe_unsure = std::min(kToeSd / speed, kLongestToe);
  fit.noisy = kNoisyShare * std::max(0.0, samples.noise - kPlainNoise) / speed;
  fit.earliest = *std::upper_bound(samples.times.begin(), samples.times.end(), samples.first);
  fit.latest = samples.last;
  fit.speed = speed;
  const double degrees = static_cast<double>(samples.times.size());
  fit.noise_ratio = std::sqrt(fitter.least_misfit() / degrees);
  return fit;
}

TouchFit MixFits(const TouchFit& a, const TouchFit& b, double share) {
  const auto best = [](const TouchFit& fit) {
    return *std::max_element(fit.log_evidence.begin(), fit.log_evidence.end());
  };
  const double best_a = best(a), best_b = best(b);
  TouchFit mix = a;
  for (size_t k = 0; k < kSettlingDepths.size(); ++k) {
    const double weight_a = (1.0 - share) * std::exp(a.log_evidence[k] - best_a);
    const double weight_b = share * std::exp(b.log_evidence[k] - best_b);
    const double sum = weight_a + weight_b;
    if (!(sum > 0.0)) continue;
    const double share_b = weight_b / sum, apart = b.time[k] - a.time[k];
    mix.log_evidence[k] = std::log(sum);
    mix.time[k] = a.time[k] + share_b * apart;
    mix.variance[k] = (1.0 - share_b) * a.variance[k] + share_b * b.variance[k] +
                      (1.0 - share_b) * share_b * apart * apart;
  }
  const TouchFit& likelier = share < 0.5 ? a : b;
  mix.toe = likelier.toe;
  mix.toe_unsure = likelier.toe_unsure;
  mix.noisy = likelier.noisy;
  mix.earliest = likelier.earliest;
  mix.latest = std::max(a.latest, b.latest);
  mix.speed = likelier.speed;
  mix.noise_ratio = std::max(a.noise_ratio, b.noise_ratio);
  return mix;
}

EventTime CalcTouchTime(const TouchFit& fit, const DepthWeights& weights) {
  if (!fit.missing.empty()) return MissingEvent(fit.missing);
  const TouchMoments touch = CalcTouchMoments(fit, weights);
  if (touch.weight == 0.0) return MissingEvent("no depth of settling explains the path");
  const SlowTouch slow = CalcSlowTouch(fit, touch.time - fit.toe);
  EventTime event;
  event.time = touch.time - fit.toe + slow.later;
  // Soft arrivals look like settling: what was learned of it is as uncertain as it moves the touch.
  // Half a standard deviation of that is in the touch's own variance already.
  const double moved = touch.time - CalcTouchMoments(fit, kUsualDepths).time;
  const double excess = std::sqrt(std::max(0.0, moved * moved - 0.25 * touch.variance));
  const double learned = std::min(kLearnedShare * excess, kMostLearned);
  const double unseen = std::hypot(fit.toe_unsure, fit.noisy);
  // Where the best fit leaves more than the noise, the model is wrong by as much.
  const double own = std::max(1.0, fit.noise_ratio) * std::sqrt(touch.variance);
  event.uncertainty = std::hypot(std::hypot(kModel, learned), std::hypot(unseen, own), slow.sd);
  return event;
}

double CalcStopTime(const TouchFit& fit) { return CalcTouchMoments(fit, kUsualDepths).time; }

double CalcOwnUncertainty(const TouchFit& fit, const DepthWeights& weights) {
  if (!fit.missing.empty()) return std::nan("");
  const double best = *std::max_element(fit.log_evidence.begin(), fit.log_evidence.end());
  double sum = 0.0, variance = 0.0;
  for (size_t k = 0; k < weights.size(); ++k) {
    const double weight = weights[k] * std::exp(fit.log_evidence[k] - best);
    sum += weight;
    variance += weight * fit.variance[k];
  }
  const double stop = std::max(1.0, fit.noise_ratio) * std::sqrt(variance / sum);
  return std::hypot(kModel, stop, CalcSlowTouch(fit, CalcStopTime(fit) - fit.toe).sd);
}

DepthWeights LearnDepths(const std::vector<TouchFit>& fits) {
  constexpr double kContactsBefore = 3.0;
  constexpr int kNumRounds = 100;
  const double usual = std::accumulate(kUsualDepths.begin(), kUsualDepths.end(), 0.0);
  DepthWeights weights = kUsualDepths;
  for (int round = 0; round < kNumRounds; ++round) {
    DepthWeights next;
    for (size_t k = 0; k < next.size(); ++k) next[k] = kContactsBefore * kUsualDepths[k] / usual;
    for (const TouchFit& fit : fits) {
      if (!fit.missing.empty()) continue;
      const double best = *std::max_element(fit.log_evidence.begin(), fit.log_evidence.end());
      DepthWeights share;
      double sum = 0.0;
      for (size_t k = 0; k < share.size(); ++k) {
        sum += share[k] = weights[k] * std::exp(fit.log_evidence[k] - best);
      }
      for (size_t k = 0; k < share.size(); ++k) next[k] += share[k] / sum;
    }
    weights = next;
  }
  return weights;
}

double CalcMeanDepth(const DepthWeights& weights) {
  double sum = 0.0, depth = 0.0;
  for (size_t k = 0; k < weights.size(); ++k) {
    sum += weights[k];
    depth += weights[k] * kSettlingDepths[k];
  }
  return depth / sum;
}

}  // namespace graspbench
