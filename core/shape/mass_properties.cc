#include "core/shape/mass_properties.h"

#include <Eigen/Geometry>

namespace graspbench {

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
  // Tetrahedra against a vertex of the mesh rather than the origin: no digits are lost when the
  // mesh lies far out.
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
