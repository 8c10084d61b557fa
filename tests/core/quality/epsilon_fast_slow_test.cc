#include <gtest/gtest.h>

#include <iostream>

#include "core/quality/epsilon_fast.h"
#include "core/quality/wrench_hull.h"
#include "tests/core/quality/grasp_samples.h"

namespace graspbench {
namespace {

TEST(EpsilonFastSlow, AgreesWithTheHullOnAThousandGrasps) {
  RandomStream stream("epsilon fast", "thousand");
  int num_closed = 0;
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::MatrixXd wrenches =
        CalcConeWrenches(MakeRandomGrasp(stream, 2 + stream.NextIndex(11)), {}).wrenches;
    const double epsilon = CalcEpsilon(CalcWrenchHull(wrenches));
    const EpsilonBounds bounds = CalcEpsilonBounds(wrenches);
    ASSERT_NEAR(bounds.lower, epsilon, 1e-9) << "grasp " << i;
    ASSERT_NEAR(bounds.upper, epsilon, 1e-9) << "grasp " << i;
    num_closed += epsilon > 0.0;
    worst = std::max(worst, std::abs(bounds.upper - epsilon));
  }
  std::cout << num_closed << " of 1000 grasps closed; largest difference " << worst << "\n";
  EXPECT_GT(num_closed, 500);
}

}  // namespace
}  // namespace graspbench
