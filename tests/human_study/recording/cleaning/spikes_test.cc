#include "human_study/recording/cleaning/spikes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace graspbench {
namespace {

/** A reach of 0.4 m in 0.8 s at 100 Hz (minimum jerk) with noise of 0.3 mm. */
Trajectory MakeNoisyReach() {
  Trajectory path;
  RandomStream random("spikes", "noise");
  path.p.resize(3, 200);
  for (int i = 0; i < 200; ++i) {
    path.times.push_back(0.01 * i);
    path.states.push_back(SampleState::kMeasured);
    const double u = std::min(1.0, std::max(0.0, (0.01 * i - 0.5) / 0.8));
    const double way = 0.4 * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
    for (int axis = 0; axis < 3; ++axis) {
      path.p(axis, i) = (axis == 0 ? way : 0.0) + 0.3e-3 * random.NextNormal();
    }
  }
  return path;
}

TEST(InvalidateSpikes, TakesWhatWasPutInAndNothingElse) {
  Trajectory path = MakeNoisyReach();
  for (const int at : {30, 70, 71, 95, 150}) path.p(at % 3, at) += 0.03;  // two in a row, too
  EXPECT_EQ(InvalidateSpikes(path), 5u);
  for (size_t i = 0; i < path.size(); ++i) {
    const bool is_spike = i == 30 || i == 70 || i == 71 || i == 95 || i == 150;
    EXPECT_EQ(path.IsValid(i), !is_spike) << i;
    EXPECT_EQ(std::isnan(path.p(0, static_cast<Eigen::Index>(i))), is_spike) << i;
  }
}

TEST(InvalidateSpikes, LeavesReachesJumpsThatStayAndNoiseAlone) {
  Trajectory path = MakeNoisyReach();
  EXPECT_EQ(InvalidateSpikes(path), 0u);
  for (int i = 120; i < 200; ++i) path.p(1, i) += 0.05;  // labels exchanged
  EXPECT_EQ(InvalidateSpikes(path), 0u);
  RandomStream random("spikes", "coarse");
  for (int i = 0; i < 200; ++i) path.p(2, i) += 5e-3 * random.NextNormal();
  EXPECT_EQ(InvalidateSpikes(path), 0u);
}

}  // namespace
}  // namespace graspbench
