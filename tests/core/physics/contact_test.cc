#include "core/physics/contact.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

constexpr double kStep = 0.002;

ContactPoint MakeContact(double depth, double torsion_radius, ContactMemory& memory) {
  ContactPoint contact;
  contact.material = {5e4, 3e4, 0.6, 0.5, torsion_radius};
  contact.depth = depth;
  contact.memory = &memory;
  return contact;
}

/** Gains against central differences of the forces, whose rows and columns are the contact's. The
gains the header promises are the whole of -df/dv: what it leaves out must be zero. */
void ExpectGainsAreDerivatives(const ContactPoint& contact, const ContactRates& rates) {
  const ContactForces at = CalcContactForces(contact, rates, kStep);
  const ContactGains gains = CalcContactGains(contact, rates, at, kStep);
  const std::array<double, 6>& g = gains.friction;
  Eigen::Matrix4d expected;
  expected << gains.normal, 0.0, 0.0, 0.0, 0.0, g[0], g[1], g[3], 0.0, g[1], g[2], g[4], 0.0, g[3],
      g[4], g[5];
  for (int column = 0; column < contact.num_rows(); ++column) {
    const double step = column == kSpinRow ? 1e-5 : 1e-7;
    ContactRates more = rates, less = rates;
    more[column] += step;
    less[column] -= step;
    const ContactForces up = CalcContactForces(contact, more, kStep);
    const ContactForces down = CalcContactForces(contact, less, kStep);
    for (int row = 0; row < contact.num_rows(); ++row) {
      const double obtained = -(up.force[row] - down.force[row]) / (2.0 * step);
      EXPECT_NEAR(obtained, expected(row, column),
                  1e-6 * std::max(1.0, std::abs(expected(row, column))))
          << "row " << row << ", column " << column << ", rates " << rates[0] << ' ' << rates[1]
          << ' ' << rates[2] << ' ' << rates[3];
    }
  }
}

// k (x - (h + tau) v), in which tau is the pair's.
TEST(CalcContactForces, DampsByThePairsRelaxationTime) {
  ContactMemory memory;
  for (const double tau : {kContactRelaxationTime, 0.024}) {
    ContactPoint contact = MakeContact(2e-4, 0.0, memory);
    contact.material.relaxation_time = tau;
    contact.friction_limit = 2.0;
    for (const double speed : {-0.02, 0.0, 0.004}) {
      const ContactRates rates = {speed, 0.0, 0.0, 0.0};
      EXPECT_NEAR(CalcContactForces(contact, rates, kStep).force[kNormalRow],
                  5e4 * (2e-4 - (kStep + tau) * speed), 1e-9);
      ExpectGainsAreDerivatives(contact, rates);
    }
  }
}

TEST(CalcContactForces, GainsAreTheDerivativesOfTheForces) {
  ContactMemory memory;
  int num_sticking = 0, num_sliding = 0;
  for (const double torsion_radius : {0.0, 0.004}) {
    for (const double depth : {-3e-4, 1e-5, 2e-4}) {
      ContactPoint contact = MakeContact(depth, torsion_radius, memory);
      contact.friction_limit = 2.0;
      contact.stretch = {1e-5, -2e-5};
      contact.twist = 2e-3;
      for (const double normal : {-0.31, -0.013, 0.0072, 0.043, 0.3}) {
        for (const double tangent1 : {-0.2, -0.003, 0.004, 0.11}) {
          for (const double tangent2 : {-0.07, 0.002, 0.3}) {
            for (const double spin : {-7.0, -0.9, 0.3, 11.0}) {
              const ContactRates rates = {normal, tangent1, tangent2, spin};
              ExpectGainsAreDerivatives(contact, rates);
              const bool is_sliding = CalcContactForces(contact, rates, kStep).is_at_limit;
              ++(is_sliding ? num_sliding : num_sticking);
            }
          }
        }
      }
    }
  }
  EXPECT_GT(num_sticking, 100);  // the grid has both
  EXPECT_GT(num_sliding, 100);
}

TEST(CalcContactForces, GainsOfAPadAreTheDerivativesOfItsForces) {
  ContactMemory memory;
  for (const double depth : {-3e-4, 1e-5, 8e-4, 4e-3}) {
    ContactPoint contact = MakeContact(depth, 1.0, memory);
    contact.material.pad = {1.5e6, 0.003, 1.0};
    SetRadius(0.007, contact);
    PrepareContact(kStep, 0, contact);
    contact.friction_limit = 2.0;
    contact.stretch = {1e-5, -2e-5};
    for (const double normal : {-0.31, -0.013, 0.0072, 0.3}) {
      for (const double tangent : {-0.2, 0.004}) {
        ExpectGainsAreDerivatives(contact, {normal, tangent, 0.003, 0.9});
      }
    }
  }
}

// With its limit fixed a contact's force is minus the gradient of a convex function of the rates:
// along any line it falls monotonically.
TEST(CalcContactForces, IsMonotone) {
  ContactMemory memory;
  ContactPoint contact = MakeContact(1e-4, 0.004, memory);
  contact.friction_limit = 1.5;
  for (int i = 0; i < 500; ++i) {
    const auto wave = [&](double k) { return std::sin(k * i + 0.3 * k); };
    const ContactRates a = {0.2 * wave(1.1), 0.2 * wave(1.7), 0.2 * wave(2.3), 9.0 * wave(2.9)};
    const ContactRates b = {0.2 * wave(3.1), 0.2 * wave(3.7), 0.2 * wave(4.3), 9.0 * wave(4.9)};
    const ContactForces fa = CalcContactForces(contact, a, kStep);
    const ContactForces fb = CalcContactForces(contact, b, kStep);
    double product = 0.0;
    for (int row = 0; row < kNumContactRows; ++row) {
      product += (fa.force[row] - fb.force[row]) * (a[row] - b[row]);
    }
    EXPECT_LE(product, 1e-12);
  }
}

// Howe and Cutkosky's ellipsoid: at a tangential share s of its limit a turning pad gives
// sqrt(1 - s^2) of its largest moment.
TEST(CalcContactForces, TorsionAndTangentialForceShareOneLimit) {
  constexpr double kRadius = 0.004, kLimit = 2.0;
  ContactMemory memory;
  ContactPoint contact = MakeContact(1e-4, kRadius, memory);
  contact.friction_limit = kLimit;
  for (const auto& [share, torsion] :
       {std::pair{0.0, 1.0}, {0.5, 0.8660}, {0.8, 0.6}, {0.98, 0.1990}, {1.0, 0.0}}) {
    const ContactForces forces =
        CalcContactForces(contact, {0.0, share, 0.0, torsion / kRadius}, kStep);
    EXPECT_TRUE(forces.is_at_limit);
    EXPECT_NEAR(forces.force[kTangentRow1], -share * kLimit, 1e-4);
    EXPECT_NEAR(forces.force[kSpinRow], -torsion * kLimit * kRadius, 1e-6);
  }
}

TEST(CalcContactForces, NothingPullsAcrossAGap) {
  ContactMemory memory;
  const ContactPoint contact = MakeContact(-1e-3, 0.004, memory);
  EXPECT_EQ(CalcContactForces(contact, {0.1, 0.0, 0.0, 0.0}, kStep).force[kNormalRow], 0.0);
  EXPECT_EQ(CalcContactForces(contact, {-0.4, 0.0, 0.0, 0.0}, kStep).force[kNormalRow], 0.0);
  EXPECT_GT(CalcContactForces(contact, {-0.6, 0.0, 0.0, 0.0}, kStep).force[kNormalRow], 0.0);
}

// The bristle keeps its length and stays in the plane when the plane turns.
TEST(PrepareContact, TurnsTheBristleWithTheTangentPlane) {
  ContactMemory memory;
  memory.last_step = 6;
  memory.normal_force = 3.0;
  memory.stretch = Eigen::Vector3d(2e-5, 0.0, 0.0);
  ContactPoint contact = MakeContact(1e-4, 0.0, memory);
  contact.nhat_BA_W = Eigen::Vector3d(0.1, 0.2, 1.0).normalized();
  PrepareContact(kStep, 7, contact);
  EXPECT_NEAR(std::hypot(contact.stretch[0], contact.stretch[1]), 2e-5, 1e-18);
  EXPECT_NEAR(contact.tangent1_W.dot(contact.nhat_BA_W), 0.0, 1e-15);
  EXPECT_NEAR(contact.tangent2_W.dot(contact.nhat_BA_W), 0.0, 1e-15);
  EXPECT_NEAR(contact.tangent1_W.cross(contact.tangent2_W).dot(contact.nhat_BA_W), 1.0, 1e-15);
  EXPECT_EQ(contact.friction_limit, 0.6 * 3.0);
  // A contact that was not there in the last step has forgotten.
  PrepareContact(kStep, 9, contact);
  EXPECT_EQ(contact.stretch[0], 0.0);
  EXPECT_EQ(contact.friction_limit, 0.0);
}

constexpr double kModulus = 1.5e6;
constexpr double kRadius = 0.007;

ContactPoint MakePad(double depth, ContactMemory& memory) {
  ContactPoint contact;
  contact.material = {1e5, 1e5, 0.6, 0.5, 1.0, {kModulus, 0.003, 1.0}};
  contact.depth = depth;
  contact.memory = &memory;
  SetRadius(kRadius, contact);
  return contact;
}

// Pad and spring bear the same force, and their compressions add up to the depth.
TEST(CalcPadCompression, PadAndSpringShareTheDepth) {
  for (const double stiffness : {2e3, 1e5, 1e7}) {
    const double hertz = CalcHertzFactor(kModulus, kRadius);
    for (double x = 1e-9; x < 0.01; x *= 1.7) {
      const PadCompression state = CalcPadCompression(hertz, stiffness, 1.0, x);
      EXPECT_NEAR(state.compression + state.force / stiffness, x, 1e-12 * x);
      EXPECT_NEAR(state.force, hertz * std::pow(state.compression, 1.5), 1e-9 * state.force);
      const double more = CalcPadCompression(hertz, stiffness, 1.0, x * (1.0 + 1e-6)).force;
      EXPECT_NEAR(state.slope, (more - state.force) / (1e-6 * x), 1e-5 * state.slope);
    }
  }
}

TEST(CalcPadCompression, CompressedByAllOfItsDepthItIsBare) {
  const double hertz = CalcHertzFactor(kModulus, kRadius), k = 1e5, pad_depth = 0.003;
  for (const double x : {0.0, -0.001, std::nan("")}) {
    EXPECT_EQ(CalcPadCompression(hertz, k, pad_depth, x).force, 0.0) << "it does not touch";
  }
  const double full = pad_depth + hertz * std::pow(pad_depth, 1.5) / k;
  const PadCompression below = CalcPadCompression(hertz, k, pad_depth, full - 1e-9);
  const PadCompression beyond = CalcPadCompression(hertz, k, pad_depth, full + 1e-4);
  EXPECT_NEAR(below.compression, pad_depth, 1e-8);
  EXPECT_EQ(beyond.compression, pad_depth);
  EXPECT_NEAR(beyond.force - below.force, k * 1e-4, 1e-3);
  EXPECT_EQ(beyond.slope, k);
}

TEST(PrepareContact, GivesAPadThePatchOfItsDepth) {
  ContactMemory memory;
  ContactPoint contact = MakePad(5e-4, memory);
  PrepareContact(kStep, 0, contact);
  const PadCompression state = CalcPadCompression(contact.hertz, 1e5, 0.003, 5e-4);
  const double a = std::sqrt(kRadius * state.compression);
  EXPECT_NEAR(contact.material.torsion_radius, kHertzTorsionShare * a, 1e-9);
  EXPECT_NEAR(1.0 / contact.material.tangential_stiffness, 1.0 / (4.0 / 3.0 * kModulus * a) + 1e-5,
              1e-9);
  EXPECT_NEAR(CalcPatchRadius(kModulus, kRadius, state.force), a, 1e-9);
  ContactPoint limited = MakePad(5e-4, memory);
  limited.material.torsion_radius = 1e-4;  // the other side's
  PrepareContact(kStep, 0, limited);
  EXPECT_EQ(limited.material.torsion_radius, 1e-4);
}

double CalcBristleEnergy(const ContactPoint& contact) {
  const double kt = contact.material.tangential_stiffness, r = contact.material.torsion_radius;
  return 0.5 * kt *
         (contact.stretch[0] * contact.stretch[0] + contact.stretch[1] * contact.stretch[1] +
          r * r * contact.twist * contact.twist);
}

// Pressed and released with a stretched bristle, a pad gives back no more than was put in.
TEST(PrepareContact, AChangingPatchKeepsTheBristlesEnergy) {
  ContactMemory memory;
  ContactPoint contact = MakePad(2e-4, memory);
  PrepareContact(kStep, 0, contact);
  contact.friction_limit = 100.0;
  const ContactRates rates = {0.0, 0.02, -0.01, 3.0};
  FinishContact(contact, rates, CalcContactForces(contact, rates, kStep), kStep, 0);
  ContactPoint before = MakePad(2e-4, memory);
  PrepareContact(kStep, 1, before);
  const double energy = CalcBristleEnergy(before);
  EXPECT_GT(energy, 1e-9);
  for (const double depth : {1e-6, 5e-5, 4e-4, 2e-3}) {
    ContactPoint changed = MakePad(depth, memory);
    PrepareContact(kStep, 1, changed);
    EXPECT_NEAR(CalcBristleEnergy(changed), energy, 1e-9 * energy) << depth;
  }
}

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
  for (const ContactMaterial& pair :
       {CombineSurfaces({}, rubber, SimConfig()), CombineSurfaces(rubber, {}, SimConfig())}) {
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

}  // namespace
}  // namespace graspbench
