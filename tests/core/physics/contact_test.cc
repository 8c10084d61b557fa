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

// Friction never exceeds its limit, and a sliding contact has all of it, against the motion.
TEST(CalcContactForces, SlidingFrictionIsTheLimitAgainstTheMotion) {
  ContactMemory memory;
  ContactPoint contact = MakeContact(1e-4, 0.0, memory);
  contact.friction_limit = 2.5;
  const ContactForces forces = CalcContactForces(contact, {0.0, 0.3, -0.4, 0.0}, kStep);
  EXPECT_TRUE(forces.is_at_limit);
  EXPECT_NEAR(forces.force[kTangentRow1], -2.5 * 0.6, 1e-12);
  EXPECT_NEAR(forces.force[kTangentRow2], 2.5 * 0.8, 1e-12);
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

}  // namespace
}  // namespace graspbench
