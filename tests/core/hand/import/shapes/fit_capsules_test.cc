#include "core/hand/import/shapes/fit_capsules.h"

#include <gtest/gtest.h>

#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Of the union of the capsules, by brute force. */
double CalcDistance(const CapsuleFit& fit, const Vector3d& p) {
  double least = 1.0;
  for (const FittedCapsule& c : fit.capsules) {
    const Vector3d axis = c.p_B - c.p_A;
    double t = axis.squaredNorm() > 0.0 ? (p - c.p_A).dot(axis) / axis.squaredNorm() : 0.0;
    t = std::min(1.0, std::max(0.0, t));
    least = std::min(least, (p - c.p_A - t * axis).norm() - c.radius);
  }
  return least;
}

/** Root mean square over the corners and middles of the mesh's triangles. */
double CalcError(const CapsuleFit& fit, const TriMesh& mesh) {
  double squares = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Vector3d middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    squares += std::pow(CalcDistance(fit, middle), 2);
  }
  return std::sqrt(squares / mesh.num_triangles());
}

TEST(FitCapsulesTest, ABallIsABall) {
  TriMesh mesh = MakeSphere(0.012, 48);
  for (Vector3d& p : mesh.vertices) p += Vector3d(0.1, 0.02, -0.03);
  const CapsuleFit fit = FitCapsules(mesh, 0.0003, 16);
  ASSERT_EQ(fit.capsules.size(), 1u);
  EXPECT_NEAR(fit.capsules[0].radius, 0.012, 0.0001);
  EXPECT_LT((fit.capsules[0].p_A - Vector3d(0.1, 0.02, -0.03)).norm(), 0.0003);
  EXPECT_LT(fit.largest_error, 0.0003);
}

TEST(FitCapsulesTest, ACapsuleIsOneCapsule) {
  const Vector3d a(0.01, 0, 0), b(0.03, 0.03, 0.01);
  const CapsuleFit fit = FitCapsules(MakeTaperedCapsule(a, 0.008, b, 0.008, 48), 0.0003, 16);
  ASSERT_EQ(fit.capsules.size(), 1u);
  EXPECT_NEAR(fit.capsules[0].radius, 0.008, 0.0001);
  EXPECT_NEAR((fit.capsules[0].p_A - fit.capsules[0].p_B).norm(), (a - b).norm(), 0.0006);
}

TEST(FitCapsulesTest, TheErrorToldIsTheErrorThere) {
  const TriMesh mesh = MakeRoundedBox({0.02, 0.03, 0.06}, 0.004, 8);
  double error_before = 1.0;
  for (const int most : {1, 4, 16}) {
    const CapsuleFit fit = FitCapsules(mesh, 1e-5, most);
    EXPECT_EQ(static_cast<int>(fit.capsules.size()), most);
    EXPECT_LT(fit.rms_error, error_before);
    error_before = fit.rms_error;
    // Flat faces have no triangle middles but many points: an oracle of another sampling.
    EXPECT_LT(CalcError(fit, mesh), 3.0 * fit.rms_error + 1e-4);
  }
  EXPECT_LT(error_before, 0.0015);
}

TEST(FitCapsulesTest, AnOpenMeshAndOneTriangleHaveAFitToo) {
  TriMesh mesh = MakeSphere(0.02, 32);
  mesh.triangles.resize(mesh.triangles.size() / 2);
  EXPECT_FALSE(FitCapsules(mesh, 0.001, 8).capsules.empty());
  TriMesh triangle;
  triangle.vertices = {{0, 0, 0}, {0.02, 0, 0}, {0, 0.02, 0}};
  triangle.triangles = {{0, 1, 2}};
  const CapsuleFit fit = FitCapsules(triangle, 0.001, 8);
  for (const FittedCapsule& c : fit.capsules) {
    EXPECT_TRUE(c.p_A.allFinite() && c.p_B.allFinite() && c.radius > 0.0);
  }
}

TEST(FitCapsulesTest, ARingsCapsulesStayAtTheRing) {
  constexpr int kAround = 40, kAcross = 20;
  constexpr double kRadius = 0.034, kTube = 0.009;
  TriMesh torus;
  for (int i = 0; i < kAround; ++i) {
    for (int k = 0; k < kAcross; ++k) {
      const double u = 2.0 * M_PI * i / kAround, v = 2.0 * M_PI * k / kAcross;
      const double r = kRadius + kTube * std::cos(v);
      torus.vertices.emplace_back(r * std::cos(u), r * std::sin(u), kTube * std::sin(v));
      const auto at = [](int a, int b) { return a % kAround * kAcross + b % kAcross; };
      torus.triangles.emplace_back(at(i, k), at(i + 1, k), at(i + 1, k + 1));
      torus.triangles.emplace_back(at(i, k), at(i + 1, k + 1), at(i, k + 1));
    }
  }
  const double beside = 0.1 * std::hypot(2.0 * (kRadius + kTube) * std::sqrt(2.0), 2.0 * kTube);
  for (const FittedCapsule& c : FitCapsules(torus, 0.001, 16).capsules) {
    for (const Vector3d& end : {c.p_A, c.p_B}) {
      EXPECT_LE(end.head<2>().cwiseAbs().maxCoeff() + c.radius, kRadius + kTube + beside);
      EXPECT_LE(std::abs(end.z()) + c.radius, kTube + beside);
    }
  }
}

}  // namespace
}  // namespace graspbench
