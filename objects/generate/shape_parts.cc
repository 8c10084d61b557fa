#include "objects/generate/shape_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/shape/repair/mesh_topology.h"

namespace graspbench {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// In [0, 2 pi), snapped so that equal corners of different outlines give equal angles.
double FindAngle(const Eigen::Vector2d& p) {
  const double angle = std::atan2(p.y(), p.x());
  const double positive = angle < -1e-9 ? angle + 2.0 * kPi : std::max(angle, 0.0);
  return std::round(positive * 1e9) / 1e9;
}

// Angles at which two outlines cross.
void AppendCrossings(const Outline& a, const Outline& b, std::vector<double>& angles) {
  for (size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector2d p = a[i], u = a[(i + 1) % a.size()] - p;
    for (size_t j = 0; j < b.size(); ++j) {
      const Eigen::Vector2d q = b[j], v = b[(j + 1) % b.size()] - q;
      const double denominator = Cross(u, v);
      if (std::abs(denominator) < 1e-9) continue;  // parallel: their corners suffice
      const double s = Cross(q - p, v) / denominator;
      const double t = Cross(q - p, u) / denominator;
      if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) angles.push_back(FindAngle(p + s * u));
    }
  }
}

}  // namespace

Outline MakeEllipse(double size_x, double size_y, int num_points) {
  Outline outline;
  // Corners of the circumscribed polygon: the flat sides have the wanted distance.
  const double stretch = num_points % 4 == 0 ? 1.0 / std::cos(kPi / num_points) : 1.0;
  for (int i = 0; i < num_points; ++i) {
    const double angle = 2.0 * kPi * (i + (num_points % 4 == 0 ? 0.5 : 0.0)) / num_points;
    outline.emplace_back(0.5 * size_x * stretch * std::cos(angle),
                         0.5 * size_y * stretch * std::sin(angle));
  }
  return outline;
}

Outline MakeRoundedRectangle(double size_x, double size_y, double radius, int num_arc) {
  Outline outline;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double sx = quarter == 0 || quarter == 3 ? 1.0 : -1.0;
    const double sy = quarter < 2 ? 1.0 : -1.0;
    for (int i = 0; i <= num_arc; ++i) {
      const double angle = 0.5 * kPi * (quarter + static_cast<double>(i) / num_arc);
      outline.emplace_back(sx * (0.5 * size_x - radius) + radius * std::cos(angle),
                           sy * (0.5 * size_y - radius) + radius * std::sin(angle));
    }
  }
  return outline;
}

double CalcRadius(const Outline& outline, double angle) {
  const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
  double radius = 0.0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d p = outline[i], u = outline[(i + 1) % outline.size()] - p;
    const double denominator = Cross(ray, u);
    if (std::abs(denominator) < 1e-12) continue;
    const double along_edge = Cross(p, ray) / denominator;
    const double along_ray = Cross(p, u) / denominator;
    if (along_edge >= -1e-7 && along_edge <= 1.0 + 1e-7) radius = std::max(radius, along_ray);
  }
  return radius;
}

Outline MakeTurned(const Outline& outline, double angle) {
  Outline turned;
  for (const Eigen::Vector2d& p : outline) turned.push_back(Eigen::Rotation2Dd(angle) * p);
  return turned;
}

Ring MakeRing(const Outline& outline, double z) {
  Ring ring;
  for (const Eigen::Vector2d& p : outline) ring.emplace_back(p.x(), p.y(), z);
  return ring;
}

TriMesh MakeStack(const std::vector<Layer>& layers) {
  std::vector<double> angles;
  for (size_t i = 0; i < layers.size(); ++i) {
    for (const Eigen::Vector2d& p : layers[i].outline) angles.push_back(FindAngle(p));
    if (i > 0) AppendCrossings(layers[i - 1].outline, layers[i].outline, angles);
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(
      std::unique(angles.begin(), angles.end(), [](double a, double b) { return b - a < 1e-7; }),
      angles.end());
  // The ends are fans about the origin, from where every corner is seen.
  const auto make_point = [&](double z) { return Ring(angles.size(), Eigen::Vector3d(0, 0, z)); };
  std::vector<Ring> rings = {make_point(layers.front().z)};
  for (const Layer& layer : layers) {
    Ring ring;
    for (const double angle : angles) {
      const double radius = CalcRadius(layer.outline, angle);
      ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle), layer.z);
    }
    rings.push_back(ring);
  }
  rings.push_back(make_point(layers.back().z));
  // Looser than the loft's own welding: crossings found from two outlines differ in the last bits.
  return WeldVertices(MakeLoft(rings), 1e-5);
}

TriMesh MakeLying(TriMesh mesh) {
  for (Eigen::Vector3d& p : mesh.vertices) p = Eigen::Vector3d(p.z(), p.x(), p.y());
  return mesh;
}

TriMesh MakeGeodesicSphere(double radius, int frequency) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Eigen::Vector3d> corners;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      corners.emplace_back(0.0, a, b);
      corners.emplace_back(a, b, 0.0);
      corners.emplace_back(b, 0.0, a);
    }
  }
  TriMesh mesh;
  for (size_t i = 0; i < corners.size(); ++i) {
    for (size_t j = i + 1; j < corners.size(); ++j) {
      for (size_t k = j + 1; k < corners.size(); ++k) {
        const Eigen::Vector3d a = corners[i];
        Eigen::Vector3d b = corners[j], c = corners[k];
        const auto is_edge = [](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
          return std::abs((p - q).norm() - 2.0) < 1e-9;
        };
        if (!is_edge(a, b) || !is_edge(b, c) || !is_edge(c, a)) continue;
        if (a.dot(b.cross(c)) < 0.0) std::swap(b, c);
        const int first = mesh.num_vertices();
        const auto index = [&](int row, int column) {
          return first + row * (row + 1) / 2 + column;
        };
        for (int row = 0; row <= frequency; ++row) {
          for (int column = 0; column <= row; ++column) {
            const Eigen::Vector3d p =
                a + (b - a) * (row - column) / frequency + (c - a) * column / frequency;
            mesh.vertices.push_back(radius * p.normalized());
            if (row == frequency) continue;
            mesh.triangles.emplace_back(index(row, column), index(row + 1, column),
                                        index(row + 1, column + 1));
            if (column == row) continue;
            mesh.triangles.emplace_back(index(row, column), index(row + 1, column + 1),
                                        index(row, column + 1));
          }
        }
      }
    }
  }
  return WeldVertices(mesh, 1e-6 * radius);
}

void FlattenBottom(TriMesh& mesh, double depth) {
  double lowest = mesh.vertices.front().z();
  for (const Eigen::Vector3d& p : mesh.vertices) lowest = std::min(lowest, p.z());
  for (Eigen::Vector3d& p : mesh.vertices) p.z() = std::max(p.z(), lowest + depth);
}

void FitTo(const Eigen::Vector3d& size, TriMesh& mesh) {
  const Eigen::AlignedBox3d box = CalcBounds(mesh);
  GRASPBENCH_DEMAND((box.sizes().array() > 0.0).all(), "a flat shape");
  for (Eigen::Vector3d& p : mesh.vertices) {
    p = (p - box.center()).cwiseQuotient(box.sizes()).cwiseProduct(size);
  }
}

}  // namespace graspbench
