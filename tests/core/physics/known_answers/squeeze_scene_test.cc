#include "core/physics/known_answers/squeeze_scene.h"

#include <gtest/gtest.h>

#include "core/shape/primitives.h"

namespace graspbench {
namespace {

TEST(SqueezeScene, AThresholdIsFoundWhicheverSideHolds) {
  EXPECT_NEAR(FindThreshold(0.0, 1.0, [](double x) { return x > 0.3; }), 0.3, 0.002);
  EXPECT_NEAR(FindThreshold(0.0, 1.0, [](double x) { return x < 0.3; }), 0.3, 0.002);
  EXPECT_TRUE(std::isnan(FindThreshold(0.0, 1.0, [](double) { return true; })));
}

// Two fingers of force F and friction mu bear 2 mu F.
TEST(SqueezeScene, WhatIsHeavierThanFrictionBearsFalls) {
  const auto calc_fall = [](double mass) {
    Squeeze squeeze;
    squeeze.force = 5.0;
    squeeze.mu = 0.5;
    squeeze.mass = mass;
    SqueezeScene scene(
        squeeze, MakeSolid(MakeRoundedBox(Eigen::Vector3d(0.02, 0.02, 0.2), 0.0), 0.1, 0.5, 0.5),
        0.01);
    scene.world().Run(0.3);
    return scene.CalcFall();
  };
  EXPECT_LT(calc_fall(0.9 * 5.0 / 9.80665), 1e-3);
  EXPECT_GT(calc_fall(1.1 * 5.0 / 9.80665), 5e-3);
}

}  // namespace
}  // namespace graspbench
