#include "human_study/recording/cleaning/spikes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;

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
    const auto place = [&](size_t i) { return trajectory.p.col(static_cast<Column>(valid[i])); };
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
    trajectory.p.col(static_cast<Column>(i)).setConstant(std::numeric_limits<double>::quiet_NaN());
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
