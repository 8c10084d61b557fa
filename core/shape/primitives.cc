#include "core/shape/primitives.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/shape/repair/mesh_topology.h"

namespace graspbench {
namespace {

constexpr double kWeldTolerance = 1e-9;  // [m]

// Circle about `centre` in the plane of the unit vectors x and y.
Ring MakeCircle(const Eigen::Vector3d& centre, double radius, const Eigen::Vector3d& x,
                const Eigen::Vector3d& y, int num_segments) {
  Ring ring;
  for (int i = 0; i < num_segments; ++i) {
    const double angle = 2.0 * kPi * i / num_segments;
    ring.push_back(centre + radius * (std::cos(angle) * x + std::sin(angle) * y));
  }
  return ring;
}

// Exactly 0 at the poles, so that the ring there is one point.
double CosLatitude(double latitude) {
  return std::abs(latitude) >= kPi / 2.0 ? 0.0 : std::cos(latitude);
}

// Appends rings of the ball about `centre` from one latitude to another, about the axis z = x cross
// y.
void AppendBallRings(const Eigen::Vector3d& centre, double radius, const Eigen::Vector3d& x,
                     const Eigen::Vector3d& y, double from, double to, int num_segments,
                     std::vector<Ring>& rings) {
  const int num_steps =
      std::max(1, static_cast<int>(std::ceil((to - from) / (2.0 * kPi) * num_segments - 1e-9)));
  for (int i = 0; i <= num_steps; ++i) {
    const double latitude = i == num_steps ? to : from + (to - from) * i / num_steps;
    rings.push_back(MakeCircle(centre + radius * std::sin(latitude) * x.cross(y),
                               radius * CosLatitude(latitude), x, y, num_segments));
  }
}

}  // namespace

TriMesh MakeLoft(const std::vector<Ring>& rings, LoftEnds ends) {
  GRASPBENCH_DEMAND(rings.size() >= 2, "rings: " + std::to_string(rings.size()));
  const int num_points = static_cast<int>(rings.front().size());
  const int num_rings = static_cast<int>(rings.size());
  TriMesh mesh;
  for (const Ring& ring : rings) {
    GRASPBENCH_DEMAND(
        static_cast<int>(ring.size()) == num_points,
        std::to_string(ring.size()) + " points, first ring has " + std::to_string(num_points));
    mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  }
  const int num_bands = ends == LoftEnds::kJoined ? num_rings : num_rings - 1;
  for (int band = 0; band < num_bands; ++band) {
    const int low = band * num_points;
    const int high = (band + 1) % num_rings * num_points;
    for (int i = 0; i < num_points; ++i) {
      const int next = (i + 1) % num_points;
      mesh.triangles.emplace_back(low + i, low + next, high + next);
      mesh.triangles.emplace_back(low + i, high + next, high + i);
    }
  }
  if (ends == LoftEnds::kCapped) {
    const auto cap = [&](int first, bool is_top) {
      Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      for (int i = 0; i < num_points; ++i) centre += mesh.vertices[first + i] / num_points;
      const int hub = mesh.num_vertices();
      mesh.vertices.push_back(centre);
      for (int i = 0; i < num_points; ++i) {
        const int a = first + i;
        const int b = first + (i + 1) % num_points;
        mesh.triangles.emplace_back(hub, is_top ? a : b, is_top ? b : a);
      }
    };
    cap(0, false);
    cap((num_rings - 1) * num_points, true);
  }
  return WeldVertices(mesh, kWeldTolerance);
}

TriMesh MakeSphere(double radius, int num_segments) {
  std::vector<Ring> rings;
  AppendBallRings(Eigen::Vector3d::Zero(), radius, Eigen::Vector3d::UnitX(),
                  Eigen::Vector3d::UnitY(), -kPi / 2.0, kPi / 2.0, num_segments, rings);
  return MakeLoft(rings);
}

TriMesh MakeTaperedCapsule(const Eigen::Vector3d& p_MA, double radius_A,
                           const Eigen::Vector3d& p_MB, double radius_B, int num_segments) {
  const Eigen::Vector3d p_AB = p_MB - p_MA;
  const double length = p_AB.norm();
  std::vector<Ring> rings;
  if (length <= std::abs(radius_A - radius_B) + kWeldTolerance) {
    const Eigen::Vector3d& centre = radius_A >= radius_B ? p_MA : p_MB;
    AppendBallRings(centre, std::max(radius_A, radius_B), Eigen::Vector3d::UnitX(),
                    Eigen::Vector3d::UnitY(), -kPi / 2.0, kPi / 2.0, num_segments, rings);
    return MakeLoft(rings);
  }
  const Eigen::Vector3d axis = p_AB / length;
  // The axis of the coordinate that deviates most, for a well-conditioned frame.
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Eigen::Vector3d x = axis.cross(Eigen::Vector3d::Unit(least)).normalized();
  const Eigen::Vector3d y = axis.cross(x);
  // The cone touches both balls at this latitude.
  const double tangent = std::asin((radius_A - radius_B) / length);
  AppendBallRings(p_MA, radius_A, x, y, -kPi / 2.0, tangent, num_segments, rings);
  AppendBallRings(p_MB, radius_B, x, y, tangent, kPi / 2.0, num_segments, rings);
  return MakeLoft(rings);
}

TriMesh MakeRoundedBox(const Eigen::Vector3d& size, double edge_radius, int num_arc) {
  GRASPBENCH_DEMAND(2.0 * edge_radius <= size.minCoeff() + kWeldTolerance,
                    "edge radius " + std::to_string(edge_radius));
  const int num_steps = edge_radius > 0.0 ? num_arc : 0;
  const Eigen::Vector3d core = 0.5 * size - Eigen::Vector3d::Constant(edge_radius);
  const auto make_ring = [&](double radius, double z) {
    Ring ring;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double cx = quarter == 0 || quarter == 3 ? core.x() : -core.x();
      const double cy = quarter < 2 ? core.y() : -core.y();
      for (int i = 0; i <= num_steps; ++i) {
        // Quarter turns swap coordinates, so that opposite corners mirror each other exactly.
        const double step = num_steps > 0 ? kPi / 2.0 * i / num_steps : 0.0;
        const double c = i == num_steps && num_steps > 0 ? 0.0 : std::cos(step);
        const double s = i == 0 ? 0.0 : std::sin(step);
        const Eigen::Vector2d turned[] = {{c, s}, {-s, c}, {-c, -s}, {s, -c}};
        ring.emplace_back(cx + radius * turned[quarter].x(), cy + radius * turned[quarter].y(), z);
      }
    }
    return ring;
  };
  std::vector<Ring> rings;
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i <= num_steps; ++i) {
      const double step = num_steps > 0 ? kPi / 2.0 * i / num_steps : 0.0;
      const double latitude = side < 0.0 ? step - kPi / 2.0 : step;
      rings.push_back(make_ring(edge_radius * CosLatitude(latitude),
                                side * core.z() + edge_radius * std::sin(latitude)));
    }
  }
  return MakeLoft(rings);
}

TriMesh MakeRevolution(const std::vector<Eigen::Vector2d>& profile, int num_segments) {
  std::vector<Ring> rings;
  for (const Eigen::Vector2d& point : profile) {
    rings.push_back(MakeCircle({0.0, 0.0, point.y()}, point.x(), Eigen::Vector3d::UnitX(),
                               Eigen::Vector3d::UnitY(), num_segments));
  }
  return MakeLoft(rings);
}

}  // namespace graspbench
