#include "core/hand/import/shapes/cover_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/hand/contact_shape.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kNoBulge = 0.0004;  // [m] of a ball beyond a surface: 3 % of its radius

/** As contact takes a box without a cover. */
std::vector<ContactSphere> MakeLayer(const Vector3d& size) {
  CollisionShape box;
  box.link = 0;
  box.kind = CollisionShape::Kind::kBox;
  box.size = size;
  Hand hand;
  AddContact(box, false, hand);
  return hand.contact_spheres;
}

double CalcGap(const std::vector<ContactSphere>& present, const SurfaceCover& cover,
               const Vector3d& p) {
  double least = 1.0;
  for (const ContactSphere& ball : present) {
    least = std::min(least, (p - ball.p_LS).norm() - ball.radius);
  }
  for (const SurfaceCover::Ball& ball : cover.balls) {
    least = std::min(least, (p - ball.centre).norm() - ball.radius);
  }
  return least;
}

/** Of a regular grid over the six faces; what 95 of 100 points are not farther outside than. */
double CalcUncovered(const Vector3d& size, const std::vector<ContactSphere>& present,
                     const SurfaceCover& cover) {
  constexpr double kGrid = 0.0005;
  std::vector<double> gaps;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (double x = -0.5 * size[u] + 0.5 * kGrid; x < 0.5 * size[u]; x += kGrid) {
      for (double y = -0.5 * size[v] + 0.5 * kGrid; y < 0.5 * size[v]; y += kGrid) {
        for (const double side : {-0.5, 0.5}) {
          Vector3d p;
          p[axis] = side * size[axis];
          p[u] = x;
          p[v] = y;
          gaps.push_back(CalcGap(present, cover, p));
        }
      }
    }
  }
  std::sort(gaps.begin(), gaps.end());
  return gaps[gaps.size() * 19 / 20];
}

// The layer's balls of 10 mm leave sqrt(2) 10 - 10 = 4.1 mm at every edge along it.
TEST(CoverSurfaceTest, ABoxIsCoveredToItsEdges) {
  const Vector3d size(0.02, 0.027, 0.054);
  const std::vector<ContactSphere> layer = MakeLayer(size);
  EXPECT_GT(CalcUncovered(size, layer, {}), 0.003);
  const SurfaceCover cover = CoverSurface({MakeRoundedBox(size, 0.0)}, layer);
  EXPECT_LE(cover.uncovered, kMostUncovered);
  EXPECT_LE(CalcUncovered(size, layer, cover), kMostUncovered);
  for (const SurfaceCover::Ball& ball : cover.balls) {
    const Vector3d room = 0.5 * size - ball.centre.cwiseAbs();
    EXPECT_GE(room.minCoeff(), ball.radius - kNoBulge);
  }
}

TEST(CoverSurfaceTest, ATriangleTurnedInwardsChangesNothingOfThat) {
  const Vector3d size(0.016, 0.02, 0.03);
  TriMesh inside_out = MakeRoundedBox(size, 0.0);
  for (Eigen::Vector3i& t : inside_out.triangles) std::swap(t[0], t[1]);
  const SurfaceCover cover = CoverSurface({inside_out}, {});
  EXPECT_LE(CalcUncovered(size, {}, cover), kMostUncovered);
  for (const SurfaceCover::Ball& ball : cover.balls) {
    EXPECT_GE((0.5 * size - ball.centre.cwiseAbs()).minCoeff(), ball.radius - kNoBulge);
  }
}

// Contact takes a cylinder for the capsule within it, which rounds its ends off.
TEST(CoverSurfaceTest, TheFlatEndOfACylinderIsCoveredToItsRim) {
  constexpr double r = 0.008, h = 0.015;
  std::vector<ContactSphere> capsule;
  for (double z = r - h; z <= h - r; z += 0.001) capsule.push_back({0, Vector3d(0, 0, z), r});
  const SurfaceCover cover =
      CoverSurface({MakeRevolution({{0.0, -h}, {r, -h}, {r, h}, {0.0, h}})}, capsule);
  std::vector<double> gaps;
  for (double x = -r; x <= r; x += 0.0004) {
    for (double y = -r; y <= r; y += 0.0004) {
      if (x * x + y * y < r * r) gaps.push_back(CalcGap(capsule, cover, {x, y, h}));
    }
  }
  std::sort(gaps.begin(), gaps.end());
  EXPECT_LE(gaps[gaps.size() * 17 / 20], kMostUncovered);  // the ends are 35 of 100 of the surface
  for (const SurfaceCover::Ball& ball : cover.balls) {
    EXPECT_LE(ball.centre.head<2>().norm() + ball.radius, r + kNoBulge);
    EXPECT_LE(std::abs(ball.centre.z()) + ball.radius, h + kNoBulge);
  }
}

TEST(CoverSurfaceTest, WhatIsCoveredGetsNothing) {
  const SurfaceCover cover = CoverSurface({MakeSphere(0.01, 64)}, {{0, Vector3d::Zero(), 0.01}});
  EXPECT_TRUE(cover.balls.empty());
  EXPECT_LT(cover.uncovered, 1e-4);
}

// A face of one box that lies in the other is no surface of the link.
TEST(CoverSurfaceTest, WhereSolidsOverlapNothingIsCovered) {
  TriMesh left = MakeRoundedBox({0.02, 0.02, 0.02}, 0.0), right = left;
  for (Vector3d& p : right.vertices) p.x() += 0.012;
  const SurfaceCover both = CoverSurface({left, right}, {});
  const SurfaceCover one = CoverSurface({MakeRoundedBox({0.032, 0.02, 0.02}, 0.0)}, {});
  EXPECT_LT(both.balls.size(), 1.4 * static_cast<double>(one.balls.size()));
  EXPECT_LE(both.uncovered, kMostUncovered);
}

// Half a ball without its flat side, and a single triangle.
TEST(CoverSurfaceTest, AnOpenSurfaceEndsToo) {
  TriMesh open = MakeSphere(0.01, 32);
  open.triangles.resize(open.triangles.size() / 2);
  EXPECT_LE(CoverSurface({open}, {}).balls.size(), 200u);
  TriMesh triangle;
  triangle.vertices = {{0, 0, 0}, {0.02, 0, 0}, {0, 0.02, 0}};
  triangle.triangles = {{0, 1, 2}};
  EXPECT_LE(CoverSurface({triangle}, {}).balls.size(), 200u);
  EXPECT_TRUE(CoverSurface({}, {}).balls.empty());
}

}  // namespace
}  // namespace graspbench
