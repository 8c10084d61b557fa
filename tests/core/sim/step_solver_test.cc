#include "core/sim/step_solver.h"

#include <gtest/gtest.h>

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

void AddPlane(double depth, double mu_s, double mu_d, ContactMemory& memory, StepProblem& problem) {
  ContactPoint contact;
  contact.material = {1e4, 0.0, 1e4, mu_s, mu_d, 0.0};
  contact.depth = depth;
  contact.memory = &memory;
  PrepareContact(0, contact);
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

// A mass on an implicit spring: m (v - u) = h (k (x0 - h v) - m g), solved by hand.
TEST(StepSolver, NormalForceIsTakenAtTheEndOfTheStep) {
  const double h = 0.002, m = 0.5, k = 1e4, x0 = 1e-3;
  StepProblem problem = MakePointMass(h, m, {0.0, 0.0, 0.0});
  ContactMemory memory;
  AddPlane(x0, 0.0, 0.0, memory, problem);
  Eigen::VectorXd v = problem.u;
  StepSolver solver;
  ASSERT_TRUE(solver.Solve(problem, v, kKeepBias));
  EXPECT_NEAR(v[2], h * (k * x0 - m * 10.0) / (m + h * h * k), 1e-9);
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

}  // namespace
}  // namespace graspbench
