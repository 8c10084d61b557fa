#include "human_study/recording/cleaning/gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/statistics/summary.h"

namespace graspbench {

namespace {

using Column = Eigen::Index;

/** Velocity at valid sample `at` from its valid neighbour at `at + step`; the gap's mean velocity
when there is none. */
Eigen::Vector3d CalcEdgeVelocity(const Trajectory& trajectory, size_t at, int step,
                                 const Eigen::Vector3d& mean_velocity) {
  const auto neighbour = static_cast<std::ptrdiff_t>(at) + step;
  if (neighbour < 0 || neighbour >= static_cast<std::ptrdiff_t>(trajectory.size()) ||
      !trajectory.IsValid(static_cast<size_t>(neighbour))) {
    return mean_velocity;
  }
  const auto n = static_cast<size_t>(neighbour);
  return (trajectory.At(n) - trajectory.At(at)) / (trajectory.times[n] - trajectory.times[at]);
}

/** Reads from `original` only, so that no edge velocity comes from a sample filled before. */
void FillGap(const Trajectory& original, const SampleRun& gap, GapFilling filling,
             Trajectory& trajectory) {
  const size_t before = gap.first - 1, after = gap.last;
  const double duration = original.times[after] - original.times[before];
  const Eigen::Vector3d p0 = original.At(before);
  const Eigen::Vector3d p1 = original.At(after);
  const Eigen::Vector3d mean_velocity = (p1 - p0) / duration;
  Eigen::Vector3d v0 = mean_velocity, v1 = mean_velocity;
  if (filling == GapFilling::kCubic) {
    v0 = CalcEdgeVelocity(original, before, -1, mean_velocity);
    v1 = CalcEdgeVelocity(original, after, 1, mean_velocity);
  }
  for (size_t i = gap.first; i < gap.last; ++i) {
    const double s = (original.times[i] - original.times[before]) / duration;
    const double r = 1.0 - s;
    // Cubic Hermite; with v0 = v1 = the mean velocity it is the straight line.
    trajectory.At(i) =
        r * r * (1 + 2 * s) * p0 + s * s * (3 - 2 * s) * p1 + s * r * duration * (r * v0 - s * v1);
    trajectory.states[i] = SampleState::kFilled;
  }
}

/** Whether a run of equal samples may be one at rest: where it was recorded finely, the next place
(at the end: the one before) is at most one step of its resolution away. */
bool IsStandstill(const Trajectory& trajectory, size_t first, size_t last, double resolution) {
  const bool is_end = last >= trajectory.size();
  if (is_end && first == 0) return false;  // never moves
  const size_t a = is_end ? first - 1 : last - 1, b = a + 1;
  if (!trajectory.IsValid(a) || !trajectory.IsValid(b)) return false;
  const auto step = (trajectory.At(b) - trajectory.At(a)).cwiseAbs().maxCoeff();
  return step <= 1.5 * resolution;
}

/** Smallest step of a coordinate between neighbours that is none; infinite without any. */
double FindResolution(const Trajectory& trajectory) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 1; i < trajectory.size(); ++i) {
    if (!trajectory.IsValid(i - 1) || !trajectory.IsValid(i)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double step = std::abs(trajectory.p(axis, static_cast<Column>(i)) -
                                   trajectory.p(axis, static_cast<Column>(i - 1)));
      if (step > 0.0) least = std::min(least, step);
    }
  }
  return least;
}

}  // namespace

GapReport FillGaps(Trajectory& trajectory, double max_duration, GapFilling filling) {
  GapReport report;
  const Trajectory original = trajectory;
  for (const SampleRun& gap : FindGaps(original)) {
    const bool has_both_ends = gap.first > 0 && gap.last < original.size();
    const double duration = original.times[std::min(gap.last, original.size() - 1)] -
                            original.times[gap.first > 0 ? gap.first - 1 : 0];
    // A limit of three frames must hold for three frames whatever the last bit of the time stamps.
    const double slack = 1e-9 * (1.0 + duration);
    if (!has_both_ends || duration > max_duration + slack) {
      ++report.num_open_gaps;
      report.longest_open = std::max(report.longest_open, duration);
      continue;
    }
    FillGap(original, gap, filling, trajectory);
    ++report.num_filled_gaps;
    report.num_filled_samples += gap.size();
    report.longest_filled = std::max(report.longest_filled, duration);
  }
  return report;
}

size_t FillGapsAlong(Trajectory& trajectory, const Trajectory& companion, double max_duration) {
  Trajectory difference = trajectory;
  difference.p -= companion.p;
  for (size_t i = 0; i < difference.size(); ++i) {
    if (!companion.IsValid(i)) difference.states[i] = SampleState::kInvalid;
  }
  FillGaps(difference, max_duration, GapFilling::kLinear);
  size_t count = 0;
  for (size_t i = 0; i < trajectory.size(); ++i) {
    if (trajectory.IsValid(i) || !companion.IsValid(i) || !difference.IsValid(i)) continue;
    const auto column = static_cast<Column>(i);
    trajectory.p.col(column) = companion.p.col(column) + difference.p.col(column);
    trajectory.states[i] = SampleState::kFilled;
    ++count;
  }
  return count;
}

size_t InvalidateFrozenSamples(Trajectory& trajectory, size_t min_repeats) {
  size_t count = 0;
  const double resolution = FindResolution(trajectory);
  for (size_t first = 0; first < trajectory.size();) {
    size_t last = first + 1;  // one past the run equal to `first`
    while (trajectory.IsValid(first) && last < trajectory.size() && trajectory.IsValid(last) &&
           trajectory.At(last) == trajectory.At(first)) {
      ++last;
    }
    if (last - first - 1 >= min_repeats && !IsStandstill(trajectory, first, last, resolution)) {
      for (size_t i = first + 1; i < last; ++i) {
        trajectory.states[i] = SampleState::kInvalid;
        trajectory.At(i).setConstant(std::numeric_limits<double>::quiet_NaN());
        ++count;
      }
    }
    first = last;
  }
  return count;
}

namespace {

constexpr double kLeastSpike = 5e-3;   // [m]
constexpr double kFastestTurn = 30.0;  // [m/s^2]
constexpr double kUsualSteps = 8.0;
constexpr int kMaxPasses = 3;

/** Of the samples before and after, two each; NaN without them. */
double CalcDistance(const Trajectory& trajectory, const std::vector<size_t>& valid, size_t at) {
  if (at < 2 || at + 2 >= valid.size()) return std::nan("");
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<double, 4> around;
    for (size_t k = 0; k < 4; ++k) {
      const size_t neighbour = valid[k < 2 ? at - 2 + k : at - 1 + k];
      around[k] = trajectory.p(axis, static_cast<Column>(neighbour));
    }
    // The two in the middle.
    const auto [least_a, most_a] = std::minmax(around[0], around[1]);
    const auto [least_b, most_b] = std::minmax(around[2], around[3]);
    const double median = 0.5 * (std::max(least_a, least_b) + std::min(most_a, most_b));
    square += std::pow(trajectory.p(axis, static_cast<Column>(valid[at])) - median, 2);
  }
  return std::sqrt(square);
}

size_t RunPass(Trajectory& trajectory) {
  std::vector<size_t> valid;
  for (size_t i = 0; i < trajectory.size(); ++i) {
    if (trajectory.IsValid(i)) valid.push_back(i);
  }
  if (valid.size() < 10) return 0;
  std::vector<double> distances, known;
  for (size_t at = 0; at < valid.size(); ++at) {
    distances.push_back(CalcDistance(trajectory, valid, at));
    if (!std::isnan(distances.back())) known.push_back(distances.back());
  }
  const double usual = CalcMedian(std::move(known));
  size_t count = 0;
  for (size_t at = 2; at + 2 < valid.size(); ++at) {
    const double span = 0.25 * (trajectory.times[valid[at + 2]] - trajectory.times[valid[at - 2]]);
    const double limit =
        std::max({kLeastSpike, kUsualSteps * usual, 2.0 * kFastestTurn * span * span});
    const bool is_peak = distances[at] > limit && !(distances[at] < distances[at - 1]) &&
                         !(distances[at] < distances[at + 1]);
    if (!is_peak) continue;
    // One that comes back: a sample before and one after are nearer to each other than to it.
    const auto place = [&](size_t i) { return trajectory.At(valid[i]); };
    double back = std::numeric_limits<double>::infinity();
    for (const size_t before : {at - 2, at - 1}) {
      for (const size_t after : {at + 1, at + 2}) {
        back = std::min(back, (place(after) - place(before)).norm());
      }
    }
    if (back > distances[at]) continue;
    trajectory.states[valid[at]] = SampleState::kInvalid;
    ++count;
  }
  for (size_t i = 0; i < trajectory.size(); ++i) {
    if (trajectory.IsValid(i)) continue;
    trajectory.At(i).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return count;
}

}  // namespace

size_t InvalidateSpikes(Trajectory& trajectory) {
  size_t total = 0;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    const size_t count = RunPass(trajectory);
    total += count;
    if (count == 0) break;
  }
  return total;
}

}  // namespace graspbench
