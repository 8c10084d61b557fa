#include "core/render/display_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace graspbench {
namespace {

using Eigen::Vector3d;

// For each vertex the number of its place; vertices at the same place share it.
std::vector<int> NumberPlaces(const std::vector<Vector3d>& vertices, int* num_places) {
  std::vector<int> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto is_before = [&](int a, int b) {
    return std::lexicographical_compare(vertices[a].data(), vertices[a].data() + 3,
                                        vertices[b].data(), vertices[b].data() + 3);
  };
  std::sort(order.begin(), order.end(), is_before);
  std::vector<int> place(vertices.size(), 0);
  *num_places = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || vertices[order[i]] != vertices[order[i - 1]]) ++*num_places;
    place[order[i]] = *num_places - 1;
  }
  return place;
}

double CalcAngle(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

struct Corner {
  int triangle = -1;
  double angle = 0.0;  // of the triangle at this corner [rad]
};

}  // namespace

DisplayMesh MakeDisplayMesh(const TriMesh& mesh, double crease_angle) {
  int num_places = 0;
  const std::vector<int> place = NumberPlaces(mesh.vertices, &num_places);

  std::vector<Vector3d> face_normals(mesh.triangles.size(), Vector3d::Zero());
  std::vector<std::vector<Corner>> corners_at(num_places);
  for (int t = 0; t < mesh.num_triangles(); ++t) {
    const Eigen::Vector3i& triangle = mesh.triangles[t];
    std::array<Vector3d, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = mesh.vertices[triangle[i]];
    const Vector3d area = (p[1] - p[0]).cross(p[2] - p[0]);
    if (area.norm() <= 0.0) continue;
    face_normals[t] = area.normalized();
    for (int i = 0; i < 3; ++i) {
      const double angle = CalcAngle(p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
      corners_at[place[triangle[i]]].push_back({t, angle});
    }
  }

  DisplayMesh display;
  display.indices.reserve(3 * mesh.triangles.size());
  std::vector<std::vector<uint32_t>> made_at(num_places);  // display vertices at each place
  const double cos_crease = std::cos(crease_angle);
  for (int t = 0; t < mesh.num_triangles(); ++t) {
    if (face_normals[t].isZero(0.0)) continue;
    for (int i = 0; i < 3; ++i) {
      const int vertex = mesh.triangles[t][i];
      Vector3d sum = Vector3d::Zero();
      for (const Corner& corner : corners_at[place[vertex]]) {
        const Vector3d& normal = face_normals[corner.triangle];
        if (normal.dot(face_normals[t]) >= cos_crease) sum += corner.angle * normal;
      }
      const Eigen::Vector3f normal = sum.normalized().cast<float>();
      std::vector<uint32_t>& made = made_at[place[vertex]];
      const auto same = std::find_if(made.begin(), made.end(), [&](uint32_t index) {
        return display.vertices[index].normal.isApprox(normal, 1e-5f);
      });
      if (same != made.end()) {
        display.indices.push_back(*same);
        continue;
      }
      made.push_back(static_cast<uint32_t>(display.vertices.size()));
      display.indices.push_back(made.back());
      display.vertices.push_back({mesh.vertices[vertex].cast<float>(), normal});
    }
  }
  return display;
}

}  // namespace graspbench
