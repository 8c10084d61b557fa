#include "core/physics/world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

// What World does to bodies and hands is on the sheet of known answers; here is what is left.

// A load of known size moves a free body as Newton says, and its work is accounted for.
TEST(World, AnExternalLoadDoesItsWork) {
  SimConfig config;
  config.step = 0.002;
  SmallWorld body(MakeBlock(0.5), config);
  body.start().gravity_W.setZero();
  body.start().p_WOcm = Vector3d(0.0, 0.0, 1.0);
  body.Reset();
  const double I_xx = MakeBlock(0.5).mass_properties.I_OOcm(0, 0), t = 0.5;
  body.world().SetExternalLoad(Vector3d(0.0, 2.0, 0.0), Vector3d(1e-4, 0.0, 0.0));
  body.Run(t);
  EXPECT_NEAR(body.state().p_WOcm.y(), 0.5 * (2.0 / 0.5) * t * t, 1e-9);
  EXPECT_NEAR(body.state().w_WO.x(), 1e-4 / I_xx * t, 1e-6);
  const double work = 2.0 * 0.5 + 0.5 * 1e-4 * 1e-4 / I_xx * t * t;
  EXPECT_NEAR(body.world().energy().external, work, 1e-6);
  EXPECT_LT(std::abs(body.world().CalcEnergyResidual()), 1e-9);
  body.Reset();
  body.Step();
  EXPECT_EQ(body.state().v_WOcm.norm(), 0.0);
}

}  // namespace
}  // namespace graspbench
