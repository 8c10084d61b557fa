#include "core/physics/combine_surfaces.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(CombineSurfaces, WhatNeitherSideGivesIsTheSessions) {
  const SimConfig config;
  const ContactMaterial pair = CombineSurfaces({}, {}, config);
  EXPECT_EQ(pair.stiffness, config.contact_stiffness);
  EXPECT_EQ(pair.tangential_stiffness, config.tangential_stiffness);
  EXPECT_EQ(pair.dissipation, config.contact_dissipation);
  EXPECT_EQ(pair.friction_static, 0.0);
  EXPECT_EQ(pair.torsion_radius, 0.0);
}

TEST(CombineSurfaces, WhatOneSideGivesHolds) {
  const SurfaceMaterial rubber{0.9, 0.8, 2e4, 30.0, 0.003};
  for (const bool swapped : {false, true}) {
    const ContactMaterial pair = swapped ? CombineSurfaces({}, rubber, SimConfig())
                                         : CombineSurfaces(rubber, {}, SimConfig());
    EXPECT_EQ(pair.stiffness, 2e4);
    EXPECT_EQ(pair.dissipation, 30.0);
    EXPECT_EQ(pair.friction_static, 0.9);
    EXPECT_EQ(pair.friction_dynamic, 0.8);
    EXPECT_EQ(pair.torsion_radius, 0.003);
    EXPECT_DOUBLE_EQ(pair.tangential_stiffness, 2e4);  // the session has kt = k
  }
}

// Two springs in series: the pair yields by f / k, of which each side takes f / kA and f / kB. The
// work dissipated at a given rate of the pair is that of both sides.
TEST(CombineSurfaces, TwoSidesAreSpringsInSeries) {
  const SurfaceMaterial a{0.8, 0.6, 2e4, 10.0, 0.004}, b{0.4, 0.3, 6e4, 30.0, 0.002};
  const ContactMaterial pair = CombineSurfaces(a, b, SimConfig());
  EXPECT_DOUBLE_EQ(1.0 / pair.stiffness, 1.0 / 2e4 + 1.0 / 6e4);
  // Side A takes 3/4 of the rate, side B 1/4: d = 3/4 * 10 + 1/4 * 30.
  EXPECT_DOUBLE_EQ(pair.dissipation, 15.0);
  EXPECT_DOUBLE_EQ(pair.friction_static, 2.0 * 0.8 * 0.4 / 1.2);
  EXPECT_DOUBLE_EQ(pair.friction_dynamic, 0.4);
  EXPECT_EQ(pair.torsion_radius, 0.002);
  const ContactMaterial mirrored = CombineSurfaces(b, a, SimConfig());
  EXPECT_DOUBLE_EQ(mirrored.dissipation, pair.dissipation);
  EXPECT_DOUBLE_EQ(mirrored.stiffness, pair.stiffness);
}

TEST(CombineSurfaces, TwoSlipperySidesHaveNoFriction) {
  const SurfaceMaterial ice{0.0, 0.0};
  EXPECT_EQ(CombineSurfaces(ice, ice, SimConfig()).friction_static, 0.0);
}

}  // namespace
}  // namespace graspbench
