#pragma once
/** @file
A number over time with the state of every sample (speed, distance, hand opening), and the few
questions that rules ask of one. */

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/statistics/distributions.h"
#include "human_study/recording/cleaning/trajectory.h"

namespace graspbench {

/** An instant found in recorded data, with what it rests on.

The uncertainty is a standard uncertainty (one standard deviation) [s], the root of the sum of
squares of

    sampling   T / sqrt(12): the frame of length T in which it lies
    noise      s / |slope|: noise of the signal over its slope where it decides
    rule       spread of the instants for half and one and a half times the threshold, / sqrt(12)
    gap        length of the gap it falls into, / sqrt(12)

as far as they apply. "Rule" covers the smoothing, too: a filter that smears a step moves those
instants apart. What is not covered: an error common to all trials, such as a wrong shape. */
struct EventTime {
  double time = std::numeric_limits<double>::quiet_NaN();  ///< on the trial's clock [s]; NaN: none
  double uncertainty = std::numeric_limits<double>::quiet_NaN();  ///< standard [s]
  bool is_filled = false;  ///< a filled sample lies where the event was decided
  bool is_in_gap = false;  ///< fell into a gap (`time` is its middle); a maximum: beside one
  std::string missing;     ///< why there is none; empty when there is one

  bool IsFound() const { return missing.empty() && time == time; }
  double CalcHalfWidth() const { return kNormal95 * uncertainty; }  ///< of the 95 % interval [s]
};

/** An event that was not found, and why. */
inline EventTime MissingEvent(std::string why) {
  EventTime event;
  event.missing = std::move(why);
  return event;
}

/** Median length of a normal vector over the SD of one of its three coordinates, in any frame: the
root of the median of chi-squared with 3 degrees of freedom, 2.3660. */
inline constexpr double kMedianPerSd = 1.5382;

struct ScalarCurve {
  std::vector<double> times;  ///< [s], even
  Eigen::VectorXd values;     ///< NaN where invalid
  std::vector<SampleState> states;
  double noise = 0.0;       ///< SD of the values, as far as the cameras' noise makes it
  double rate_noise = 0.0;  ///< the same of their derivative [1/s]
  double reach = 0.0;       ///< [s] a value is made of samples as far away as this

  size_t size() const { return times.size(); }
  double At(size_t i) const { return values[static_cast<Eigen::Index>(i)]; }
  double& At(size_t i) { return values[static_cast<Eigen::Index>(i)]; }
  bool IsValid(size_t i) const { return states[i] != SampleState::kInvalid; }
  double Interval() const { return times[1] - times[0]; }  ///< [s] @pre size() >= 2
};

/** Worse of two: a value computed from both is filled when one is, invalid when one is. */
SampleState CombineStates(SampleState a, SampleState b);

/** A path behind a zero-phase low-pass, and the noise before and after it. */
struct SmoothPath {
  Trajectory path;
  double noise = 0.0;         ///< SD of one coordinate before the filter [m]
  double smooth_noise = 0.0;  ///< after it [m]
  double speed_noise = 0.0;   ///< of one coordinate's derivative after it [m/s]
  double reach = 0.0;         ///< half the rise time, 0.18 / cut-off [s]
};
/** The noise is what the filter takes away (median absolute, so that corners of the path do not
count), taken to be white: the filter's impulse response then says how much of it was taken, is left
and is in the derivative.
@throws Error(kRange) when the cut-off does not fit the rate. */
SmoothPath Smooth(const Trajectory& trajectory, double cutoff);

/** A number of every valid place of the path, with the path's noise and reach. */
template <class Measure>
ScalarCurve CalcCurve(const SmoothPath& smooth, const Measure& measure) {
  ScalarCurve curve;
  curve.times = smooth.path.times;
  curve.states = smooth.path.states;
  curve.values.resize(smooth.path.p.cols());
  for (Eigen::Index i = 0; i < smooth.path.p.cols(); ++i) {
    curve.values[i] =
        smooth.path.IsValid(static_cast<size_t>(i)) ? measure(smooth.path.p.col(i)) : std::nan("");
  }
  curve.noise = smooth.smooth_noise;
  curve.rate_noise = smooth.speed_noise;
  curve.reach = smooth.reach;
  return curve;
}

/** Speed by central differences [m/s]. Beside a gap the filter has samples on one side only and
leans on the noise of the last of them, so values within its reach of a gap are invalid. */
ScalarCurve CalcSpeed(const SmoothPath& smooth);

/** The same curve run backwards in time: t -> -t. */
ScalarCurve Reverse(const ScalarCurve& curve);

/** Samples with begin <= time <= end. */
SampleRun FindSamples(const std::vector<double>& times, double begin, double end);
ScalarCurve Cut(const ScalarCurve& curve, const SampleRun& samples);
/** Every n-th sample, so that at least `num_samples` are left and fewer than twice as many. */
ScalarCurve Thin(const ScalarCurve& curve, size_t num_samples);

/** Value at the sample nearest to an instant; NaN outside the curve. */
double ValueNear(const ScalarCurve& curve, double time);

/** Largest of the valid samples; -1 when there is none. */
int FindPeak(const ScalarCurve& curve, const SampleRun& samples);

/** A filled sample lies within the curve's reach of that instant. */
bool HasFilledNear(const ScalarCurve& curve, double time);

/** The event of a rule that multiplies criteria: the maximum of their product, refined by a
parabola. Its uncertainty is that of a uniform distribution over where the product is within 5 % of
the maximum. Missing when the product is zero everywhere. */
EventTime FindProductPeak(const ScalarCurve& product);

enum class Side { kAbove, kBelow };

/** Goes back from sample `from`, where the curve is on that side of the threshold, and gives the
latest instant at which it was not: linear between two samples, or the middle of a gap. Missing when
`from` is not on that side or no earlier sample, down to `first`, is on the other.
@param min_duration  crossings to the other side that last less are noise [s]. */
EventTime TraceBack(const ScalarCurve& curve, size_t from, size_t first, double threshold,
                    Side side, double min_duration = 0.0);

/** First sample above the threshold; -1 when there is none. */
int FindFirstAbove(const ScalarCurve& curve, double threshold);

}  // namespace graspbench
