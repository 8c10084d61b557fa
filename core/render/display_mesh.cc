#include "core/render/display_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/shape/repair/mesh_topology.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kSamePlace = 1e-7;  // [m]
constexpr double kFirstJoin = 0.5;   // of the edge that is wanted
constexpr double kSliver = 1e-6;  // of twice the area to the longest edge squared; no normal below

double CalcAngle(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

bool IsClosed(const TriMesh& mesh) {
  const std::vector<MeshEdge> edges = ListEdges(mesh);
  double volume = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    volume += mesh.vertices[t[0]].cross(mesh.vertices[t[1]]).dot(mesh.vertices[t[2]]);
  }
  return volume > 0.0 && std::all_of(edges.begin(), edges.end(), [](const MeshEdge& edge) {
           return edge.num_forward == edge.num_backward;
         });
}

struct Corner {
  int triangle = -1;
  double angle = 0.0;  // of the triangle at this corner [rad]
};

}  // namespace

DisplayMesh MakeDisplayMesh(const TriMesh& original, double crease_angle) {
  const TriMesh mesh = WeldVertices(original, kSamePlace);
  std::vector<Vector3d> face_normals(mesh.triangles.size(), Vector3d::Zero());
  std::vector<std::vector<Corner>> corners_at(mesh.vertices.size());
  for (int t = 0; t < mesh.num_triangles(); ++t) {
    const Eigen::Vector3i& triangle = mesh.triangles[t];
    std::array<Vector3d, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = mesh.vertices[triangle[i]];
    const Vector3d area = (p[1] - p[0]).cross(p[2] - p[0]);
    const double longest =
        std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
    if (area.norm() <= kSliver * longest * longest) continue;
    face_normals[t] = area.normalized();
    for (int i = 0; i < 3; ++i) {
      const double angle = CalcAngle(p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
      corners_at[triangle[i]].push_back({t, angle});
    }
  }

  DisplayMesh display;
  display.is_closed = IsClosed(mesh);
  display.indices.reserve(3 * mesh.triangles.size());
  std::vector<std::vector<uint32_t>> made_at(mesh.vertices.size());  // display vertices of each
  const double cos_crease = std::cos(crease_angle);
  for (int t = 0; t < mesh.num_triangles(); ++t) {
    if (face_normals[t].isZero(0.0)) continue;
    for (int i = 0; i < 3; ++i) {
      const int vertex = mesh.triangles[t][i];
      Vector3d sum = Vector3d::Zero();
      for (const Corner& corner : corners_at[vertex]) {
        const Vector3d& normal = face_normals[corner.triangle];
        if (normal.dot(face_normals[t]) >= cos_crease) sum += corner.angle * normal;
      }
      const Eigen::Vector3f normal = sum.normalized().cast<float>();
      std::vector<uint32_t>& made = made_at[vertex];
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

TriMesh MakeCoarseMesh(const TriMesh& mesh, int max_triangles) {
  if (mesh.num_triangles() <= max_triangles) return mesh;
  double area = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Vector3d& p = mesh.vertices[t[0]];
    area += 0.5 * (mesh.vertices[t[1]] - p).cross(mesh.vertices[t[2]] - p).norm();
  }
  // The edge of so many equal triangles of the same area; a few of them may be joined by less.
  const double edge = std::sqrt(4.0 / std::sqrt(3.0) * area / std::max(max_triangles, 1));
  TriMesh coarse = mesh;
  // Joined from what was joined before, so that all rounds together cost little more than the first.
  for (double distance = kFirstJoin * edge;
       coarse.num_triangles() > max_triangles && distance > 0.0; distance *= M_SQRT2) {
    coarse = WeldVertices(coarse, distance);
  }
  return coarse;
}

}  // namespace graspbench
