#include "human_study/events/contact_detector.h"

#include <gtest/gtest.h>

#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

/** Straight lines through corners of time [s] and departure [m], 200 Hz. */
ScalarCurve MakeDeparture(const std::vector<std::pair<double, double>>& corners) {
  return SampleCurve(MakeTimes(0.0, corners.back().first, 200.0), [&](double t) {
    size_t piece = 0;
    while (piece + 2 < corners.size() && t > corners[piece + 1].first) ++piece;
    const auto [t0, y0] = corners[piece];
    const auto [t1, y1] = corners[piece + 1];
    return y0 + (y1 - y0) * (t - t0) / (t1 - t0);
  });
}

TEST(FindRegrasp, NamesTouchReleaseAndWay) {
  // There at 0.5 s, leaves at 0.6 s, 9 mm away at 0.7 s, back at 0.8 s.
  const ScalarCurve departure =
      MakeDeparture({{0.0, 0.1}, {0.5, 0.0}, {0.6, 0.0}, {0.7, 9e-3}, {0.8, 0.0}, {1.2, 0.0}});
  const Regrasp regrasp = FindRegrasp(departure, 0.1, 0.8);
  ASSERT_TRUE(regrasp.IsFound());
  EXPECT_NEAR(regrasp.first_touch.time, 0.49, 0.005);  // 2 mm at 0.2 m/s before
  EXPECT_NEAR(regrasp.release.time, 0.6 + 0.1 * 2.0 / 9.0, 0.005);
  EXPECT_NEAR(regrasp.left_by, 9e-3, 0.3e-3);
}

TEST(FindRegrasp, OneTouchAndNoiseAreNone) {
  const ScalarCurve once = MakeDeparture({{0.0, 0.1}, {0.5, 0.0}, {1.2, 0.0}});
  EXPECT_FALSE(FindRegrasp(once, 0.1, 0.5).IsFound());
  ScalarCurve noisy =
      MakeDeparture({{0.0, 0.1}, {0.5, 0.0}, {0.6, 0.0}, {0.7, 5e-3}, {0.8, 0.0}, {1.2, 0.0}});
  EXPECT_TRUE(FindRegrasp(noisy, 0.1, 0.8).IsFound());
  noisy.noise = 1e-3;
  EXPECT_FALSE(FindRegrasp(noisy, 0.1, 0.8).IsFound());
}

}  // namespace
}  // namespace graspbench
