#include "human_study/recording/cleaning/lost_frames.h"

#include <algorithm>
#include <cmath>

#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;
constexpr Column kSide = 4;           // frames that tell a marker's own motion, before and after
constexpr size_t kEnough = 3;         // markers
constexpr double kFewest = 0.7;       // of a frame
constexpr double kCertain = 7.0;      // standard errors
constexpr double kLeftOver = 0.5;     // of a loss's own length, that markers may differ from it by
constexpr double kLeastNoise = 5e-5;  // [m]

/** One marker from frame to frame. */
struct Motion {
  Eigen::Matrix3Xd own, excess;  ///< v and d - v; NaN where a frame around was not measured
  double noise = kLeastNoise;    ///< of a component of the excess [m]
};

Motion CalcMotion(const Trajectory& track) {
  constexpr double kMedianOfChi3 = 1.538;
  const auto num_frames = static_cast<Column>(track.size());
  Motion motion;
  motion.own = motion.excess = Eigen::Matrix3Xd::Constant(3, num_frames, std::nan(""));
  std::vector<double> sizes;
  for (Column i = kSide; i + kSide <= num_frames; ++i) {
    const auto first = track.states.begin() + (i - kSide);
    if (std::count(first, first + 2 * kSide, SampleState::kMeasured) < 2 * kSide) continue;
    const auto& p = track.p;
    // The median of the steps around, axis by axis: other losses among them do not count.
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> steps;
      for (Column k = i - kSide + 1; k < i + kSide; ++k) {
        if (k != i) steps.push_back(p(axis, k) - p(axis, k - 1));
      }
      motion.own(axis, i) = CalcMedian(std::move(steps));
    }
    motion.excess.col(i) = p.col(i) - p.col(i - 1) - motion.own.col(i);
    sizes.push_back(motion.excess.col(i).norm());
  }
  if (!sizes.empty()) {
    motion.noise = std::max(kLeastNoise, CalcMedian(std::move(sizes)) / kMedianOfChi3);
  }
  return motion;
}

/** The loss before sample i; 0: none. */
double FindLoss(const std::vector<Motion>& motions, Column i) {
  double along = 0.0, squares = 0.0, largest = 0.0;
  size_t num_seen = 0;
  for (const Motion& motion : motions) {
    if (std::isnan(motion.excess(0, i))) continue;
    const double weight = 1.0 / (motion.noise * motion.noise);
    const double square = weight * motion.own.col(i).squaredNorm();
    along += weight * motion.own.col(i).dot(motion.excess.col(i));
    squares += square;
    largest = std::max(largest, square);
    ++num_seen;
  }
  // One marker alone proves nothing.
  if (num_seen < kEnough || !(squares - largest > 0.2 * squares)) return 0.0;
  const double count = along / squares;
  if (!(count >= kFewest) || count * std::sqrt(squares) < kCertain) return 0.0;
  for (const Motion& motion : motions) {
    if (std::isnan(motion.excess(0, i))) continue;
    const Eigen::Vector3d skipped = count * motion.own.col(i);
    if ((motion.excess.col(i) - skipped).norm() > 5.0 * motion.noise + kLeftOver * skipped.norm()) {
      return 0.0;
    }
  }
  return count;
}

}  // namespace

std::vector<FrameLoss> FindFrameLosses(const std::vector<const Trajectory*>& tracks) {
  if (tracks.size() < kEnough) return {};
  std::vector<Motion> motions;
  for (const Trajectory* track : tracks) motions.push_back(CalcMotion(*track));
  std::vector<FrameLoss> losses;
  for (Column i = kSide; i + kSide <= motions[0].own.cols(); ++i) {
    const double count = FindLoss(motions, i);
    if (count > 0.0) losses.push_back({static_cast<size_t>(i), count});
  }
  return losses;
}

}  // namespace graspbench
