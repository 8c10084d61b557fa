#include "core/physics/pad_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/physics/contact.h"

namespace graspbench {
namespace {

constexpr double kStep = 0.002;
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

TEST(CalcPadCompression, HasNoForceBeforeItTouches) {
  EXPECT_EQ(CalcPadCompression(1e5, 1e5, 0.003, 0.0).force, 0.0);
  EXPECT_EQ(CalcPadCompression(1e5, 1e5, 0.003, -0.001).force, 0.0);
  EXPECT_EQ(CalcPadCompression(1e5, 1e5, 0.003, std::nan("")).force, 0.0);
}

TEST(CalcPadCompression, CompressedByAllOfItsDepthItIsBare) {
  const double hertz = CalcHertzFactor(kModulus, kRadius), k = 1e5, pad_depth = 0.003;
  const double full = pad_depth + hertz * std::pow(pad_depth, 1.5) / k;
  const PadCompression below = CalcPadCompression(hertz, k, pad_depth, full - 1e-9);
  const PadCompression beyond = CalcPadCompression(hertz, k, pad_depth, full + 1e-4);
  EXPECT_NEAR(below.compression, pad_depth, 1e-8);
  EXPECT_EQ(beyond.compression, pad_depth);
  EXPECT_NEAR(beyond.force - below.force, k * 1e-4, 1e-3);
  EXPECT_EQ(beyond.slope, k);
}

TEST(CalcPadCompression, AStiffPadIsTheBareSpring) {
  const PadCompression state = CalcPadCompression(1e15, 1e5, 0.003, 2e-4);
  EXPECT_NEAR(state.force, 20.0, 1e-4);
}

// 3 N on a ball of 7 mm: a^3 = 3 F R / (4 E*).
TEST(CalcPatchRadius, IsHertzs) {
  EXPECT_NEAR(CalcPatchRadius(kModulus, kRadius, 3.0), std::cbrt(0.063 / 6e6), 1e-9);
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
}

TEST(PrepareContact, APadsPatchIsNoLargerThanTheOtherSideAllows) {
  ContactMemory memory;
  ContactPoint contact = MakePad(5e-4, memory);
  contact.material.torsion_radius = 1e-4;
  PrepareContact(kStep, 0, contact);
  EXPECT_EQ(contact.material.torsion_radius, 1e-4);
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

}  // namespace
}  // namespace graspbench
