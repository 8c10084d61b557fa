// Things turned on a lathe, and balls. Millimetres.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/shape/repair/mesh_topology.h"
#include "objects/generate/object_shapes.h"
#include "objects/generate/shape_parts.h"

namespace graspbench {
namespace {

using Profile = std::vector<Eigen::Vector2d>;  // (radius, z), bottom centre -> outside -> top

// Appends a circular arc about (r, z), angles from the outward horizontal.
void AppendArc(double r, double z, double radius, double from_deg, double to_deg, int num_steps,
               Profile& profile) {
  for (int i = 0; i <= num_steps; ++i) {
    const double angle = RadFromDeg(from_deg + (to_deg - from_deg) * i / num_steps);
    const double cosine = std::cos(angle);
    profile.emplace_back(r + radius * (std::abs(cosine) < 1e-12 ? 0.0 : cosine),
                         z + radius * std::sin(angle));
  }
}

// A turned thing that lies on its side, a flat strip down.
TriMesh MakeLyingRevolution(const Profile& profile, int num_segments) {
  std::vector<Ring> rings;
  for (const Eigen::Vector2d& p : profile) {
    rings.push_back(MakeRing(MakeEllipse(2.0 * p.x(), 2.0 * p.x(), num_segments), p.y()));
  }
  return MakeLying(MakeLoft(rings));
}

}  // namespace

// A roll seen from above: cardboard core, and the tape wound on it a little narrower than the core.
TriMesh DrawAdhesiveTape() {
  // Cross-section of the ring as (distance inwards from the rim, z).
  const Profile section = {{0.0, -12.0}, {0.0, 12.0},  {0.6, 12.4},  {5.0, 12.4},
                           {5.2, 13.0},  {6.8, 13.0},  {7.0, 12.8},  {7.0, -12.8},
                           {6.8, -13.0}, {5.2, -13.0}, {5.0, -12.4}, {0.6, -12.4}};
  std::vector<Ring> rings;
  for (int i = 0; i < 96; ++i) {
    const double angle = 2.0 * kPi * i / 96;
    Ring ring;
    for (const Eigen::Vector2d& p : section) {
      ring.emplace_back((30.85 - p.x()) * std::cos(angle), (26.7 - p.x()) * std::sin(angle), p.y());
    }
    std::reverse(ring.begin(), ring.end());
    rings.push_back(ring);
  }
  return MakeLoft(rings, LoftEnds::kJoined);
}

// A drinks can: domed base with a foot, shoulder, neck, rolled rim, sunk lid.
TriMesh DrawCan() {
  Profile profile = {{0.0, 7.0}, {10.0, 6.4}, {18.0, 4.2}, {22.5, 0.8}};
  AppendArc(24.0, 1.0, 1.0, 250.0, 330.0, 3, profile);
  profile.insert(profile.end(), {{28.5, 5.0},
                                 {31.6, 9.0},
                                 {32.9, 13.0},
                                 {32.9, 98.0},
                                 {32.2, 101.5},
                                 {30.4, 105.5},
                                 {27.4, 110.0},
                                 {26.6, 112.0}});
  AppendArc(26.6, 113.8, 1.8, -60.0, 180.0, 8, profile);
  profile.insert(profile.end(), {{24.6, 110.0}, {23.6, 109.4}, {22.6, 110.2}, {0.0, 110.2}});
  return MakeRevolution(profile, 64);
}

// A tennis ball with its one endless seam.
TriMesh DrawTennisBall() {
  TriMesh ball = MakeGeodesicSphere(33.0, 18);
  // Of the curves a cos t + b cos 3t, a sin t - b sin 3t, 2 sqrt(ab) sin 2t, which lie on the
  // sphere of radius a + b, this one looks like the seam.
  std::vector<Eigen::Vector3d> seam;
  for (int i = 0; i < 400; ++i) {
    const double t = 2.0 * kPi * i / 400;
    seam.emplace_back(0.75 * std::cos(t) + 0.25 * std::cos(3.0 * t),
                      0.75 * std::sin(t) - 0.25 * std::sin(3.0 * t),
                      2.0 * std::sqrt(0.75 * 0.25) * std::sin(2.0 * t));
  }
  // Tilted, so that neither the rest nor the sides lie in the groove.
  const Eigen::Matrix3d tilt = (Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()))
                                   .toRotationMatrix();
  for (Eigen::Vector3d& p : ball.vertices) {
    double nearest = 4.0;
    for (const Eigen::Vector3d& s : seam) nearest = std::min(nearest, (p / 33.0 - tilt * s).norm());
    const double across = 33.0 * nearest / 2.6;
    if (across < 1.0) p *= 1.0 - 1.0 / 33.0 * (0.5 + 0.5 * std::cos(kPi * across));
  }
  FlattenBottom(ball, 0.1);
  return ball;
}

// A crumpled sheet: flat facets between random creases.
TriMesh DrawPaperBall() {
  TriMesh ball = MakeGeodesicSphere(1.0, 8);
  RandomStream random("paper_ball", "creases");
  std::vector<std::pair<Eigen::Vector3d, double>> facets;
  for (int i = 0; i < 90; ++i) {
    const Eigen::Vector3d normal =
        Eigen::Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal()).normalized();
    facets.emplace_back(normal, random.NextUniform(0.86, 1.0));
  }
  for (Eigen::Vector3d& p : ball.vertices) {
    double radius = 1.05;
    for (const auto& [normal, distance] : facets) {
      if (normal.dot(p) > 0.5) radius = std::min(radius, distance / normal.dot(p));
    }
    p *= radius * random.NextUniform(0.96, 1.0);
    p = p.cwiseProduct(Eigen::Vector3d(36.0, 34.0, 31.0));
  }
  FlattenBottom(ball, 1.5);
  return ball;
}

// A barrel sharpener: ribbed lid with the hole for the pencil over a smooth container.
TriMesh DrawSharpener() {
  const Outline round = MakeEllipse(1.0, 1.0, 96);
  const auto scaled = [](Outline outline, double factor) {
    for (Eigen::Vector2d& p : outline) p *= factor;
    return outline;
  };
  Outline ribbed = round;
  for (size_t i = 0; i < ribbed.size(); ++i) {
    if (i % 4 < 2) ribbed[i] *= 0.965;
  }
  std::vector<Ring> rings;
  const auto add = [&](const Outline& outline, double diameter, double z) {
    rings.push_back(MakeRing(scaled(outline, diameter), z));
  };
  add(round, 34.6, 0.0);
  add(round, 36.0, 0.8);
  add(round, 36.6, 36.0);
  add(round, 35.2, 36.6);
  add(round, 35.2, 37.8);
  add(ribbed, 36.6, 38.4);
  add(ribbed, 36.2, 52.0);
  add(round, 33.0, 55.0);
  add(round, 29.0, 57.0);
  add(round, 9.4, 57.0);
  add(round, 8.6, 56.0);
  add(round, 8.0, 42.0);
  return MakeLoft(rings);
}

namespace {

// The cup's wall has two holes of equal shape, which its handle, a tube, joins.
constexpr int kCupSegments = 64;
constexpr int kHoleHalfWidth = 2;  // in segments
constexpr int kHoleRows = 4;
constexpr double kHoleRow = 2.5;     // height of a row
constexpr double kUpperHole = 44.0;  // its lower edge
constexpr double kLowerHole = 11.0;  // its lower edge
constexpr double kCupRadius = 42.5;

// Corner of a hole's grid: column counts segments from the side of -x, row counts upwards.
Eigen::Vector3d FindHoleCorner(double bottom, int column, int row) {
  const double angle = 2.0 * kPi * (kCupSegments / 2 + column) / kCupSegments;
  return {kCupRadius * std::cos(angle), kCupRadius * std::sin(angle), bottom + row * kHoleRow};
}

bool IsInHole(const Eigen::Vector3d& p) {
  const double half_angle = 2.0 * kPi * kHoleHalfWidth / kCupSegments;
  const double low = p.z() > kUpperHole ? kUpperHole : kLowerHole;
  return p.head<2>().norm() > kCupRadius - 1.0 && p.z() > low &&
         p.z() < low + kHoleRows * kHoleRow && std::abs(std::atan2(p.y(), -p.x())) < half_angle;
}

TriMesh DrawCupWall() {
  Profile profile = {{0.0, 1.5}, {25.0, 1.5}, {26.0, 0.0}, {29.0, 0.0}, {36.0, 3.0}, {40.5, 6.5}};
  profile.emplace_back(kCupRadius, kLowerHole);
  for (const double bottom : {kLowerHole, kUpperHole}) {
    if (bottom == kUpperHole) profile.emplace_back(kCupRadius, kUpperHole);
    for (int row = 1; row <= kHoleRows; ++row) {
      profile.emplace_back(kCupRadius, bottom + row * kHoleRow);
    }
  }
  AppendArc(kCupRadius - 2.0, 63.0, 2.0, 0.0, 180.0, 6, profile);
  profile.insert(profile.end(), {{38.4, 12.0}, {36.5, 8.5}, {32.0, 6.0}, {24.0, 5.0}, {0.0, 5.0}});
  TriMesh wall = MakeRevolution(profile, kCupSegments);
  const auto is_in_hole = [&](const Eigen::Vector3i& t) {
    return IsInHole((wall.vertices[t[0]] + wall.vertices[t[1]] + wall.vertices[t[2]]) / 3.0);
  };
  wall.triangles.erase(std::remove_if(wall.triangles.begin(), wall.triangles.end(), is_in_hole),
                       wall.triangles.end());
  return wall;
}

// The handle's axis leaves the upper hole outwards, bends down and comes back to the lower one,
// upside down.
std::vector<Ring> MakeHandleRings() {
  std::vector<std::pair<int, int>> rim;  // (column, row) once around a hole
  for (int c = -kHoleHalfWidth; c < kHoleHalfWidth; ++c) rim.emplace_back(c, 0);
  for (int r = 0; r < kHoleRows; ++r) rim.emplace_back(kHoleHalfWidth, r);
  for (int c = kHoleHalfWidth; c > -kHoleHalfWidth; --c) rim.emplace_back(c, kHoleRows);
  for (int r = kHoleRows; r > 0; --r) rim.emplace_back(-kHoleHalfWidth, r);

  std::vector<Ring> rings(1);
  for (const auto& [column, row] : rim) {
    rings[0].push_back(FindHoleCorner(kUpperHole, column, row));
  }
  const double middle = 0.5 * (kUpperHole + kLowerHole + kHoleRows * kHoleRow);
  const double reach = 0.5 * (kUpperHole - kLowerHole);
  constexpr int kBends = 20;
  for (int i = 0; i <= kBends; ++i) {
    const double turn = kPi * i / kBends;
    const Eigen::Vector3d up(-std::sin(turn), 0.0, std::cos(turn));
    const Eigen::Vector3d centre(-46.0 - 14.0 * std::sin(turn), 0.0,
                                 middle + reach * std::cos(turn));
    Ring ring;
    for (const auto& [column, row] : rim) {
      const double angle = std::atan2(row - 0.5 * kHoleRows, static_cast<double>(column));
      ring.push_back(centre - 5.5 * std::cos(angle) * Eigen::Vector3d::UnitY() +
                     4.0 * std::sin(angle) * up);
    }
    rings.push_back(ring);
  }
  rings.emplace_back();
  for (const auto& [column, row] : rim) {
    rings.back().push_back(FindHoleCorner(kLowerHole, column, kHoleRows - row));
  }
  return rings;
}

}  // namespace

// A cup with a handle.
TriMesh DrawCup() {
  TriMesh cup = DrawCupWall();
  const std::vector<Ring> rings = MakeHandleRings();
  const int num_points = static_cast<int>(rings[0].size());
  for (size_t i = 0; i < rings.size(); ++i) {
    const int low = cup.num_vertices(), high = low + num_points;
    cup.vertices.insert(cup.vertices.end(), rings[i].begin(), rings[i].end());
    if (i + 1 == rings.size()) break;
    for (int k = 0; k < num_points; ++k) {
      const int next = (k + 1) % num_points;
      cup.triangles.emplace_back(low + k, low + next, high + next);
      cup.triangles.emplace_back(low + k, high + next, high + k);
    }
  }
  return WeldVertices(cup, 1e-6);
}

// Barrel, and the narrower cap with its clip-free grip rings, at -x.
TriMesh DrawBoardMarker() {
  Profile profile = {{0.0, 0.0}, {4.5, 0.0}, {5.6, 1.0}, {6.0, 6.0}, {7.9, 8.0}, {8.1, 20.0}};
  for (const double z : {22.0, 26.0, 30.0, 34.0}) {
    profile.insert(profile.end(), {{8.2, z}, {7.7, z + 0.6}, {7.7, z + 1.8}, {8.2, z + 2.4}});
  }
  profile.insert(profile.end(), {{8.3, 43.0},
                                 {7.9, 43.4},
                                 {7.9, 44.4},
                                 {8.9, 44.8},
                                 {8.9, 131.0},
                                 {8.4, 132.0},
                                 {7.2, 132.4},
                                 {7.2, 139.2},
                                 {6.6, 140.0},
                                 {0, 140}});
  return MakeLyingRevolution(profile, 32);
}

// Aluminium cup, wax a little below its edge, wick.
TriMesh DrawTeaLight() {
  return MakeRevolution({{0.0, 0.6},
                         {15.5, 0.6},
                         {16.0, 0.0},
                         {18.2, 0.0},
                         {18.6, 0.5},
                         {18.4, 13.2},
                         {19.0, 13.6},
                         {19.0, 14.2},
                         {18.2, 14.4},
                         {17.8, 14.0},
                         {17.6, 12.2},
                         {16.5, 11.8},
                         {3.0, 11.5},
                         {1.2, 11.8},
                         {0.8, 12.2},
                         {0.7, 16.2},
                         {0.4, 16.5},
                         {0.0, 16.5}},
                        48);
}

// 162 dimples on the vertices of a coarser geodesic ball.
TriMesh DrawGolfBall() {
  constexpr double kRadius = 21.35;
  TriMesh ball = MakeGeodesicSphere(kRadius, 16);
  const TriMesh dimples = MakeGeodesicSphere(kRadius, 4);
  for (Eigen::Vector3d& p : ball.vertices) {
    double nearest = kRadius;
    for (const Eigen::Vector3d& d : dimples.vertices) nearest = std::min(nearest, (p - d).norm());
    const double across = nearest / 2.7;
    if (across < 1.0) p *= 1.0 - 0.45 / kRadius * (1.0 - across * across);
  }
  FlattenBottom(ball, 0.05);
  return ball;
}

// The screw base is at -x. The bulb's widest part is a short cylinder, so that the lamp lies still
// with its axis level, as the table's height says.
TriMesh DrawLightBulb() {
  Profile profile = {{0.0, 0.0}, {4.2, 0.0}, {4.8, 0.8}, {5.0, 2.0}, {9.5, 4.2}, {11.8, 5.4}};
  for (int turn = 0; turn < 5; ++turn) {
    const double z = 6.4 + 3.4 * turn;
    profile.insert(profile.end(), {{12.3, z}, {13.1, z + 0.9}, {13.1, z + 1.6}, {12.3, z + 2.5}});
  }
  profile.insert(profile.end(), {{13.2, 24.0}, {13.4, 28.0}, {14.2, 29.0}});
  // A smooth flare from the collar to the globe.
  constexpr int kFlare = 10;
  for (int i = 1; i < kFlare; ++i) {
    const double s = static_cast<double>(i) / kFlare;
    profile.emplace_back(14.2 + 16.0 * s * s * (3.0 - 2.0 * s), 29.0 + 29.0 * s);
  }
  profile.emplace_back(30.2, 58.0);
  AppendArc(0.0, 73.3, 30.2, 0.0, 90.0, 12, profile);
  return MakeLyingRevolution(profile, 48);
}

}  // namespace graspbench
