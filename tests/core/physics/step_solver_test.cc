#include "core/physics/step_solver.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

const auto kKeepBias = [](const Eigen::VectorXd&) { return false; };

StepProblem MakePointMass(double h, double mass, const Eigen::Vector3d& u) {
  StepProblem problem;
  problem.h = h;
  problem.M = mass * Eigen::Matrix3d::Identity();
  problem.u = u;
  problem.bias = Eigen::Vector3d(0.0, 0.0, mass * 10.0);
  return problem;
}

void AddPlane(double depth, double mu_s, double mu_d, ContactMemory& memory, StepProblem& problem,
              const Eigen::Vector3d& normal = Eigen::Vector3d::UnitZ(), double h = 0.002,
              int step = 0) {
  ContactPoint contact;
  contact.nhat_BA_W = normal;
  contact.material = {1e4, 1e4, mu_s, mu_d, 0.0};
  contact.depth = depth;
  contact.memory = &memory;
  PrepareContact(h, step, contact);
  contact.num_dofs = 3;
  const Eigen::Vector3d rows[3] = {contact.nhat_BA_W, contact.tangent1_W, contact.tangent2_W};
  for (int i = 0; i < 3; ++i) {
    contact.dofs[i] = i;
    for (int row = 0; row < 3; ++row) contact.jacobian[row][i] = rows[row][i];
  }
  problem.contacts.push_back(contact);
}

TEST(StepSolver, FreeFallGainsGravityTimesStep) {
  StepProblem problem = MakePointMass(0.002, 0.5, {1.0, 2.0, 3.0});
  Eigen::VectorXd v = problem.u;
  StepSolver solver;
  ASSERT_TRUE(solver.Solve(problem, v, kKeepBias));
  EXPECT_LT((v - Eigen::Vector3d(1.0, 2.0, 3.0 - 10.0 * 0.002)).norm(), 1e-9);
}

// A mass on an implicit spring: m (v - u) = h (k (x0 - (h + tau) v) - m g), solved by hand.
TEST(StepSolver, NormalForceIsTakenAtTheEndOfTheStep) {
  const double h = 0.002, m = 0.5, k = 1e4, x0 = 1e-3;
  StepProblem problem = MakePointMass(h, m, {0.0, 0.0, 0.0});
  ContactMemory memory;
  AddPlane(x0, 0.0, 0.0, memory, problem);
  Eigen::VectorXd v = problem.u;
  StepSolver solver;
  ASSERT_TRUE(solver.Solve(problem, v, kKeepBias));
  EXPECT_NEAR(v[2], h * (k * x0 - m * 10.0) / (m + h * (h + kContactRelaxationTime) * k), 1e-9);
}

// A clamped motor cannot give more than its limit: v = h tau_max / m.
TEST(StepSolver, DrivesAreClamped) {
  StepProblem problem = MakePointMass(0.01, 2.0, {0.0, 0.0, 0.0});
  problem.bias.setZero();
  problem.scalars.push_back({0, 1000.0, 50.0, -3.0, 3.0});
  Eigen::VectorXd v = problem.u;
  StepSolver solver;
  ASSERT_TRUE(solver.Solve(problem, v, kKeepBias));
  EXPECT_NEAR(v[0], 0.01 * 3.0 / 2.0, 1e-9);
}

// Coulomb: a fast point pressed by fn loses mu_d fn h / m of speed, against its motion.
TEST(StepSolver, SlidingFrictionOpposesMotionWithTheDynamicCoefficient) {
  const double h = 0.001, m = 0.5, fn = m * 10.0;
  StepProblem problem = MakePointMass(h, m, {0.3, 0.4, 0.0});
  ContactMemory memory;
  memory.last_step = -1;
  memory.normal_force = fn;
  AddPlane(fn / 1e4, 0.6, 0.5, memory, problem);
  Eigen::VectorXd v = problem.u;
  StepSolver solver;
  ASSERT_TRUE(solver.Solve(problem, v, kKeepBias));
  const double loss = 0.5 * fn * h / m;
  EXPECT_NEAR(v.head<2>().norm(), 0.5 - loss, 1e-6);
  EXPECT_NEAR(v[0] / v[1], 0.75, 1e-9);
}

// Static friction is back 20 ms after the last slide, whatever the step and also when the contact
// was lost in between.
TEST(ContactMemory, StaticFrictionReturnsWithRest) {
  for (const double h : {0.0005, 0.001, 0.004}) {
    for (const bool is_lost : {false, true}) {
      ContactMemory memory;
      StepProblem problem;
      double rest = 0.0;
      for (int step = 0; step < 100; ++step) {
        problem.contacts.clear();
        AddPlane(1e-4, 0.6, 0.5, memory, problem, Eigen::Vector3d::UnitZ(), h, step);
        const ContactPoint& contact = problem.contacts[0];
        if (step > 0 && contact.mu() == 0.6) break;
        EXPECT_EQ(contact.mu(), step == 0 ? 0.6 : 0.5);
        rest = h * step;
        ContactForces forces;
        forces.force[kNormalRow] = is_lost && step == 2 ? 0.0 : 1.0;
        forces.is_at_limit = step == 0;
        FinishContact(contact, ContactRates{}, forces, h, step);
      }
      EXPECT_NEAR(rest + h, 0.02, 1.01 * h) << "step " << h << (is_lost ? ", lost" : "");
    }
  }
}

// A point slides down into a groove whose sides stand at an angle a to the vertical. By symmetry
// both press with N, and along z
//     m (v - u) = h (2 N (sin a + mu cos a) - m g),   N = k (x0 - (h + tau) v sin a).
// Each side's friction unloads the other: taking the limits from the last normal forces alone
// multiplies their error by about -mu / tan a, here beyond -1, and never settles.
TEST(StepSolver, LimitsOfWedgedContactsSettle) {
  const double h = 0.002, m = 0.001, u = -0.5, k = 1e4, x0 = 1e-6, mu = 0.6;
  const double a = 0.4, sin_a = std::sin(a), cos_a = std::cos(a);
  StepProblem problem = MakePointMass(h, m, {0.0, 0.0, u});
  ContactMemory left, right;
  for (ContactMemory* memory : {&left, &right}) {
    memory->last_step = -1;
    memory->normal_force = 1.0;
  }
  AddPlane(x0, mu, mu, left, problem, {cos_a, 0.0, sin_a});
  AddPlane(x0, mu, mu, right, problem, {-cos_a, 0.0, sin_a});
  // Soft bristles would carry it before they slide.
  for (ContactPoint& contact : problem.contacts) contact.material.tangential_stiffness = 1e6;
  Eigen::VectorXd v = problem.u;
  StepSolver solver;
  ASSERT_TRUE(solver.Solve(problem, v, kKeepBias));
  const double lift = 2.0 * h * (sin_a + mu * cos_a) * k;
  const double expected =
      (m * (u - 10.0 * h) + lift * x0) / (m + lift * (h + kContactRelaxationTime) * sin_a);
  EXPECT_NEAR(v[2], expected, 1e-4 * std::abs(expected));
  for (int side = 0; side < 2; ++side) {
    EXPECT_NEAR(problem.contacts[side].friction_limit,
                mu * k * (x0 - (h + kContactRelaxationTime) * expected * sin_a), 1e-3);
  }
}

}  // namespace
}  // namespace graspbench
