#include "core/shape/mass_properties.h"

#include <Eigen/Geometry>
#include <cstdint>

#include "core/shape/line_crossings.h"

namespace graspbench {
namespace {

constexpr int64_t kNumLines = 317811, kStride = 196418;  // neighbours in the Fibonacci sequence

}  // namespace

Overlap CalcOverlap(const TriMesh& mesh) {
  Overlap overlap;
  if (mesh.triangles.empty()) return overlap;
  const Eigen::Vector3d p_MR = mesh.vertices[mesh.triangles.front()[0]];
  const LineCrossings lines(mesh, 2);
  const Eigen::AlignedBox3d box = CalcBounds(mesh);
  const Eigen::Vector3d sizes = box.sizes();
  const double area = sizes.x() * sizes.y() / kNumLines;  // box area per line
  std::vector<LineCrossings::Crossing> crossings;
  for (int64_t i = 0; i < kNumLines; ++i) {
    const double x = box.min().x() + (i + 0.5) / kNumLines * sizes.x();
    const double y = box.min().y() + (i * kStride % kNumLines + 0.5) / kNumLines * sizes.y();
    lines.Find(x, y, crossings);
    int winding = 0;
    for (size_t k = 0; k + 1 < crossings.size(); ++k) {
      winding += crossings[k].winding;
      const int excess = winding - (winding >= 1 ? 1 : 0);
      if (excess == 0) continue;
      const double a = crossings[k].at - p_MR.z(), b = crossings[k + 1].at - p_MR.z();
      const double size = excess * area;
      const double length = b - a, z = (b * b - a * a) / 2.0, zz = (b * b * b - a * a * a) / 3.0;
      const double px = x - p_MR.x(), py = y - p_MR.y();
      overlap.volume += size * length;
      overlap.absolute_volume += std::abs(size) * length;
      if (winding < 0) overlap.inverted_volume += area * length;
      overlap.first += size * Eigen::Vector3d(px * length, py * length, z);
      Eigen::Matrix3d second;
      second << px * px * length, px * py * length, px * z,  //
          px * py * length, py * py * length, py * z,        //
          px * z, py * z, zz;
      overlap.second += size * second;
    }
  }
  return overlap;
}

double CalcArea(const TriMesh& mesh, const Eigen::Vector3i& triangle) {
  const Eigen::Vector3d& a = mesh.vertices[triangle[0]];
  return 0.5 * (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a).norm();
}

double CalcVolume(const TriMesh& mesh) {
  double six_volumes = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    six_volumes += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  }
  return six_volumes / 6.0;
}

MassProperties CalcSolidMassProperties(const TriMesh& mesh, double mass, const Overlap& overlap) {
  if (mesh.triangles.empty()) return {};
  // Tetrahedra to a vertex of the mesh rather than to the origin: no digits are lost when the mesh
  // is far from the origin.
  const Eigen::Vector3d p_MR = mesh.vertices[mesh.triangles.front()[0]];
  double six_volumes = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   // 24 times the integral of p
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // 120 times the integral of p p^T
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - p_MR;
    const Eigen::Vector3d b = mesh.vertices[t[1]] - p_MR;
    const Eigen::Vector3d c = mesh.vertices[t[2]] - p_MR;
    const double determinant = a.dot(b.cross(c));
    const Eigen::Vector3d sum = a + b + c;
    six_volumes += determinant;
    first += determinant * sum;
    second += determinant *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  const double volume = six_volumes / 6.0 - overlap.volume;
  const Eigen::Vector3d p_RCm = (first / 24.0 - overlap.first) / volume;
  const Eigen::Matrix3d covariance =
      (second / 120.0 - overlap.second) / volume - p_RCm * p_RCm.transpose();

  MassProperties properties;
  properties.mass = mass;
  properties.p_OOcm = p_MR + p_RCm;
  properties.I_OOcm = mass * (covariance.trace() * Eigen::Matrix3d::Identity() - covariance);
  return properties;
}

}  // namespace graspbench
