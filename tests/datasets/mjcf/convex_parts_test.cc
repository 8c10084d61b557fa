#include "datasets/mjcf/convex_parts.h"

#include <gtest/gtest.h>

#include <random>

#include "core/base/units.h"
#include "core/shape/mass_properties.h"
#include "core/shape/primitives.h"

namespace graspbench {

namespace {

using Eigen::Vector3d;

/** A ring like a roll of tape, its axis along z. */
TriMesh MakeTapeRing(double outer, double inner, double height) {
  std::vector<Ring> rings;
  constexpr int kSegments = 96;
  for (int i = 0; i < kSegments; ++i) {
    const double angle = -2.0 * kPi * i / kSegments;
    const Vector3d out(std::cos(angle), std::sin(angle), 0.0);
    const Vector3d up = 0.5 * height * Vector3d::UnitZ();
    rings.push_back({inner * out - up, inner * out + up, outer * out + up, outer * out - up});
  }
  TriMesh mesh = MakeLoft(rings, LoftEnds::kJoined);
  if (CalcVolume(mesh) < 0.0) {
    for (Eigen::Vector3i& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

bool IsProvenOutside(const Vector3d& p, const ConvexPart& part, std::mt19937& random) {
  std::normal_distribution<double> normal;
  for (int k = 0; k < 300; ++k) {
    const Vector3d d = Vector3d(normal(random), normal(random), normal(random)).normalized();
    double most = -1.0;
    for (const Vector3d& v : part.vertices) most = std::max(most, d.dot(v));
    if (d.dot(p) > most) return true;
  }
  return false;
}

TEST(ConvexParts, ABoxIsOnePartWithItsEightCorners) {
  const TriMesh box = MakeRoundedBox({0.06, 0.04, 0.02}, 0.0);
  const SignedDistanceField field = SignedDistanceField::Build(box);
  const std::vector<ConvexPart> parts = CutIntoConvexParts(box, field);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].vertices.size(), 8u);
  EXPECT_LT(parts[0].excess, 0.6 * field.cell());  // the field is that wrong beside an edge
}

TEST(ConvexParts, ARingKeepsItsHoleWithinTheTolerance) {
  const double outer = 0.03, inner = 0.02, height = 0.025;
  const TriMesh ring = MakeTapeRing(outer, inner, height);
  ASSERT_NEAR(CalcVolume(ring), kPi * (outer * outer - inner * inner) * height, 1e-7);
  const SignedDistanceField field = SignedDistanceField::Build(ring);
  for (const double tolerance : {0.002, 0.001, 0.0005}) {
    const std::vector<ConvexPart> parts = CutIntoConvexParts(ring, field, {tolerance, 200});
    EXPECT_GE(parts.size(), 6u);
    std::mt19937 random(1);
    std::exponential_distribution<double> weight;
    double reach = inner;  // how near to the axis a part comes
    for (const ConvexPart& part : parts) {
      EXPECT_LE(part.excess, tolerance);
      for (int k = 0; k < 2000; ++k) {
        Vector3d p = Vector3d::Zero();
        double sum = 0.0;
        for (int i = 0; i < 4; ++i) {
          const double w = weight(random);
          p += w * part.vertices[random() % part.vertices.size()];
          sum += w;
        }
        p /= sum;
        reach = std::min(reach, p.head<2>().norm());
        EXPECT_LE(p.head<2>().norm(), outer + 1e-9);
      }
    }
    EXPECT_GT(reach, inner - 1.3 * tolerance);
    EXPECT_LT(reach, inner);  // chords do cut into the hole: the bound is put to the test
  }
}

TEST(ConvexParts, ThePartsFillTheSolid) {
  const double outer = 0.03, inner = 0.02, height = 0.025;
  const TriMesh ring = MakeTapeRing(outer, inner, height);
  const SignedDistanceField field = SignedDistanceField::Build(ring);
  const std::vector<ConvexPart> parts = CutIntoConvexParts(ring, field);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int k = 0; k < 2000;) {
    const Vector3d p(outer * uniform(random), outer * uniform(random),
                     0.49 * height * uniform(random));
    if (p.head<2>().norm() < inner + 2e-4 || p.head<2>().norm() > outer - 2e-4) continue;
    ++k;
    bool is_covered = false;
    for (const ConvexPart& part : parts) {
      is_covered = is_covered || !IsProvenOutside(p, part, random);
    }
    EXPECT_TRUE(is_covered) << p.transpose();
  }
}

TEST(ConvexParts, WhatIsLeftUncutSaysSo) {
  const TriMesh ring = MakeTapeRing(0.03, 0.02, 0.025);
  const std::vector<ConvexPart> parts =
      CutIntoConvexParts(ring, SignedDistanceField::Build(ring), {0.0005, 1});
  ASSERT_EQ(parts.size(), 1u);
  // The middle of the hole's end faces is farthest from the ring.
  EXPECT_NEAR(parts[0].excess, 0.02, 0.002);
}

/** A palm and two digits of one link each, whose capsules lie along x at a height of their own. */
Hand MakeHand(double height_a, double height_b) {
  Hand hand;
  hand.links.resize(3);
  hand.digits.resize(2);
  const double heights[] = {0.0, height_a, height_b};
  for (int link = 0; link < 3; ++link) {
    if (link > 0) {
      hand.links[static_cast<size_t>(link)].parent = 0;
      hand.digits[static_cast<size_t>(link) - 1].links = {link};
    }
    LinkCapsule& capsule = hand.capsules.emplace_back();
    capsule.link = link;
    capsule.p_LA = {-0.05, 0.0, heights[link]};
    capsule.p_LB = {0.05, 0.0, heights[link]};
    capsule.radius = 0.01;
  }
  return hand;
}

TEST(TouchingLinks, AreThoseWhoseCapsulesMeetAtZero) {
  using Pairs = std::set<std::pair<int, int>>;
  EXPECT_EQ(FindLinksTouchingAtRest(MakeHand(0.0199, -0.0201)), (Pairs{{0, 1}}));
  EXPECT_EQ(FindLinksTouchingAtRest(MakeHand(0.0301, 0.0499)), (Pairs{{1, 2}}));
  EXPECT_EQ(FindLinksTouchingAtRest(MakeHand(0.03, -0.03)), Pairs{});
}

TEST(TouchingLinks, CrossedCapsulesMeetBetweenTheirEnds) {
  Hand hand = MakeHand(0.1, 0.119);
  hand.capsules[2].p_LA = {0.017, -0.05, 0.119};
  hand.capsules[2].p_LB = {0.017, 0.05, 0.119};
  EXPECT_EQ(FindLinksTouchingAtRest(hand).count({1, 2}), 1u);
}

TEST(TouchingLinks, ALinkOfTheSameDigitIsNone) {
  Hand hand = MakeHand(0.1, 0.11);
  hand.digits[0].links = {1, 2};
  hand.digits.resize(1);
  EXPECT_TRUE(FindLinksTouchingAtRest(hand).empty());
}

}  // namespace

}  // namespace graspbench
