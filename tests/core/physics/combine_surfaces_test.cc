#include "core/physics/combine_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

TEST(CombineSurfaces, WhatNeitherSideGivesIsTheSessions) {
  const SimConfig config;
  const ContactMaterial pair = CombineSurfaces({}, {}, config);
  EXPECT_EQ(pair.stiffness, config.contact_stiffness);
  EXPECT_EQ(pair.tangential_stiffness, config.tangential_stiffness);
  EXPECT_EQ(pair.friction_static, 0.0);
  EXPECT_EQ(pair.torsion_radius, 0.0);
}

TEST(CombineSurfaces, WhatOneSideGivesHolds) {
  const SurfaceMaterial rubber{0.9, 0.8, 2e4, 0.003};
  for (const bool swapped : {false, true}) {
    const ContactMaterial pair = swapped ? CombineSurfaces({}, rubber, SimConfig())
                                         : CombineSurfaces(rubber, {}, SimConfig());
    EXPECT_EQ(pair.stiffness, 2e4);
    EXPECT_EQ(pair.friction_static, 0.9);
    EXPECT_EQ(pair.friction_dynamic, 0.8);
    EXPECT_EQ(pair.torsion_radius, 0.003);
    EXPECT_DOUBLE_EQ(pair.tangential_stiffness, 2e4);  // the session has kt = k
  }
}

// Two springs in series: the pair yields by f / k, of which each side takes f / kA and f / kB.
TEST(CombineSurfaces, TwoSidesAreSpringsInSeries) {
  const SurfaceMaterial a{0.8, 0.6, 2e4, 0.004}, b{0.4, 0.3, 6e4, 0.002};
  const ContactMaterial pair = CombineSurfaces(a, b, SimConfig());
  EXPECT_DOUBLE_EQ(1.0 / pair.stiffness, 1.0 / 2e4 + 1.0 / 6e4);
  EXPECT_DOUBLE_EQ(pair.friction_static, 2.0 * 0.8 * 0.4 / 1.2);
  EXPECT_DOUBLE_EQ(pair.friction_dynamic, 0.4);
  EXPECT_EQ(pair.torsion_radius, 0.002);
  const ContactMaterial mirrored = CombineSurfaces(b, a, SimConfig());
  EXPECT_DOUBLE_EQ(mirrored.stiffness, pair.stiffness);
}

TEST(CombineSurfaces, TheLongerRelaxationTimeHolds) {
  SurfaceMaterial slow, quick;
  slow.relaxation_time = 0.024;
  quick.relaxation_time = 0.005;
  const auto combine = [](const SurfaceMaterial& a, const SurfaceMaterial& b) {
    return CombineSurfaces(a, b, SimConfig()).relaxation_time;
  };
  EXPECT_EQ(combine({}, {}), kContactRelaxationTime);
  EXPECT_EQ(combine(quick, {}), 0.005);
  EXPECT_EQ(combine({}, slow), 0.024);
  EXPECT_EQ(combine(quick, slow), 0.024);
  EXPECT_EQ(combine(MakeSelfSurface(slow, SimConfig()), {}), 0.024);
}

TEST(CombineSurfaces, TheHandHasFrictionAgainstItself) {
  const SimConfig config;
  SurfaceMaterial rubber;
  rubber.friction_static = rubber.friction_dynamic = 1.0;
  const SurfaceMaterial plain = MakeSelfSurface({}, config);
  EXPECT_EQ(CombineSurfaces(plain, plain, config).friction_static, config.hand_friction_static);
  EXPECT_EQ(CombineSurfaces(plain, plain, config).torsion_radius, 0.0);
  EXPECT_DOUBLE_EQ(CombineSurfaces(MakeSelfSurface(rubber, config), plain, config).friction_static,
                   2.0 / 3.0);
}

TEST(CombineSurfaces, APadYieldsBesideTheSpringsAndTwistsByItsPatch) {
  SurfaceMaterial flesh;
  flesh.pad = {1.2e6, 0.003};
  const ContactMaterial pair = CombineSurfaces(flesh, {}, SimConfig());
  EXPECT_DOUBLE_EQ(pair.pad.modulus, 1.6e6);  // E / (1 - 1/4)
  EXPECT_EQ(pair.pad.depth, 0.003);
  EXPECT_EQ(pair.stiffness, SimConfig().contact_stiffness);
  EXPECT_TRUE(std::isinf(pair.torsion_radius));
  SurfaceMaterial limited;
  limited.torsion_radius = 0.002;
  EXPECT_EQ(CombineSurfaces(limited, flesh, SimConfig()).torsion_radius, 0.002);
  const ContactMaterial both = CombineSurfaces(flesh, flesh, SimConfig());
  EXPECT_DOUBLE_EQ(both.pad.modulus, 0.8e6);
  EXPECT_EQ(both.pad.depth, 0.006);
  EXPECT_FALSE(CombineSurfaces({}, limited, SimConfig()).pad.is_soft());
}

TEST(CombineSurfaces, TwoSlipperySidesHaveNoFriction) {
  const SurfaceMaterial ice{0.0, 0.0};
  EXPECT_EQ(CombineSurfaces(ice, ice, SimConfig()).friction_static, 0.0);
}

}  // namespace
}  // namespace graspbench
