#include "core/physics/step_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <string>

#include "core/base/random.h"

namespace graspbench {

namespace {

Eigen::VectorXd Solve(StepProblem& problem) {
  Eigen::VectorXd v = problem.u;
  EXPECT_TRUE(StepSolver().Solve(problem, v, [](const Eigen::VectorXd&) { return false; }));
  return v;
}

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
  const Eigen::VectorXd v = Solve(problem);
  EXPECT_LT((v - Eigen::Vector3d(1.0, 2.0, 3.0 - 10.0 * 0.002)).norm(), 1e-9);
}

// A mass on an implicit spring: m (v - u) = h (k (x0 - (h + tau) v) - m g), solved by hand.
TEST(StepSolver, NormalForceIsTakenAtTheEndOfTheStep) {
  const double h = 0.002, m = 0.5, k = 1e4, x0 = 1e-3;
  StepProblem problem = MakePointMass(h, m, {0.0, 0.0, 0.0});
  ContactMemory memory;
  AddPlane(x0, 0.0, 0.0, memory, problem);
  const Eigen::VectorXd v = Solve(problem);
  EXPECT_NEAR(v[2], h * (k * x0 - m * 10.0) / (m + h * (h + kContactRelaxationTime) * k), 1e-9);
}

// A clamped motor cannot give more than its limit: v = h tau_max / m.
TEST(StepSolver, DrivesAreClamped) {
  StepProblem problem = MakePointMass(0.01, 2.0, {0.0, 0.0, 0.0});
  problem.bias.setZero();
  problem.scalars.push_back({0, 1000.0, 50.0, -3.0, 3.0});
  const Eigen::VectorXd v = Solve(problem);
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
  const Eigen::VectorXd v = Solve(problem);
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
  const Eigen::VectorXd v = Solve(problem);
  const double lift = 2.0 * h * (sin_a + mu * cos_a) * k;
  const double expected =
      (m * (u - 10.0 * h) + lift * x0) / (m + lift * (h + kContactRelaxationTime) * sin_a);
  EXPECT_NEAR(v[2], expected, 1e-4 * std::abs(expected));
  for (int side = 0; side < 2; ++side) {
    EXPECT_NEAR(problem.contacts[side].friction_limit,
                mu * k * (x0 - (h + kContactRelaxationTime) * expected * sin_a), 1e-3);
  }
}

using Eigen::MatrixXd;

MatrixXd MakePositiveDefinite(int n) {
  RandomStream random("cholesky", std::to_string(n));
  MatrixXd A(n, n);
  for (int i = 0; i < A.size(); ++i) A.data()[i] = random.NextUniform(-1.0, 1.0);
  return A * A.transpose() + 0.1 * MatrixXd::Identity(n, n);
}

/** Fingers that meet in the palm only: blocks along the diagonal, and rows that are full below. */
MatrixXd MakeHandLike(int num_fingers, int num_joints, int num_others) {
  MatrixXd H = MakePositiveDefinite(num_fingers * num_joints + num_others);
  for (int a = 0; a < num_fingers * num_joints; ++a) {
    for (int b = 0; b < num_fingers * num_joints; ++b) {
      if (a / num_joints != b / num_joints) H(a, b) = 0.0;
    }
  }
  return H + 4.0 * static_cast<double>(H.rows()) * MatrixXd::Identity(H.rows(), H.rows());
}

void ExpectFactor(const MatrixXd& H, bool is_eigens) {
  MatrixXd factored = H;
  factored.triangularView<Eigen::StrictlyUpper>().setConstant(1e300);  // is not read
  ASSERT_TRUE(FactorCholesky(factored)) << H.rows();
  const MatrixXd L = factored.triangularView<Eigen::Lower>();
  EXPECT_LT((L * L.transpose() - H).cwiseAbs().maxCoeff(), 1e-13 * H.rows() * H.norm()) << H.rows();
  if (!is_eigens) return;
  const MatrixXd expected = H.llt().matrixL();
  EXPECT_EQ((L - expected).cwiseAbs().maxCoeff(), 0.0) << H.rows();
}

// Eigen's to the last bit where its sizes allow: 21 unknowns has the TUM Hand with an object, 32 the
// Shadow Hand. Zeros between fingers are skipped without a change of a bit.
TEST(FactorCholesky, GivesTheMatrixBackAtEverySize) {
  for (int n = 1; n <= 70; ++n) {
    ExpectFactor(MakePositiveDefinite(n), n == 9 || n == 21 || n == 31 || n == 32 || n == 40);
  }
  for (const auto& [fingers, joints, others] : {std::array{3, 3, 12}, {5, 4, 12}, {4, 7, 12}}) {
    ExpectFactor(MakeHandLike(fingers, joints, others), true);
  }
}

TEST(FactorCholesky, RefusesWhatIsNotPositiveDefinite) {
  for (const int n : {1, 7, 32, 40}) {
    MatrixXd H = MakePositiveDefinite(n);
    H(n - 1, n - 1) = -1.0;
    EXPECT_FALSE(FactorCholesky(H)) << n;
  }
}

}  // namespace

}  // namespace graspbench
