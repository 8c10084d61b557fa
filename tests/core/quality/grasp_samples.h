#pragma once
/** @file
Grasps with known answers and random ones, for the tests of wrench space and quality. */

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/quality/wrench_space.h"

namespace graspbench {

/** Contacts at the six face centres of a cube of half-edge `a`; first cone edge along a cube axis.
 */
inline std::vector<GraspContact> MakeCubeGrasp(double a, double mu) {
  std::vector<GraspContact> contacts;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Eigen::Vector3d n = -sign * Eigen::Vector3d::Unit(axis);
      contacts.push_back({-a * n, n, mu, 0.0, Eigen::Vector3d::Unit((axis + 1) % 3)});
    }
  }
  return contacts;
}

/** Two opposite contacts on a sphere of radius r, along a skew axis. */
inline std::vector<GraspContact> MakePinch(double r, double mu, double torsion) {
  const Eigen::Vector3d n = Eigen::Vector3d(1.0, 2.0, -2.0) / 3.0;
  return {{-r * n, n, mu, torsion, std::nullopt}, {r * n, -n, mu, torsion, std::nullopt}};
}

/** Generators (fx, fy, moment / r) of contacts on the rim of a disc at the given angles, two edges
each: a planar grasp. */
inline Eigen::MatrixXd MakeDiscWrenches(const std::vector<double>& angles_deg, double mu) {
  Eigen::MatrixXd wrenches(3, 2 * angles_deg.size());
  for (size_t i = 0; i < angles_deg.size(); ++i) {
    const double angle = RadFromDeg(angles_deg[i]);
    const Eigen::Vector2d p(std::cos(angle), std::sin(angle)), t(-p.y(), p.x());
    for (int edge = 0; edge < 2; ++edge) {
      const Eigen::Vector2d f = -p + (edge == 0 ? mu : -mu) * t;
      wrenches.col(2 * i + edge) << f, p.x() * f.y() - p.y() * f.x();
    }
  }
  return wrenches;
}

inline Eigen::Vector3d MakeRandomDirection(RandomStream& stream) {
  const double x = stream.NextNormal(), y = stream.NextNormal(), z = stream.NextNormal();
  return Eigen::Vector3d(x, y, z).normalized();
}

/** A random grasp: contacts on a sphere (smooth) or on the faces of a box (many coplanar wrenches),
of one or of mixed friction, hard or soft; size 1. */
inline std::vector<GraspContact> MakeRandomGrasp(RandomStream& stream, int num_contacts) {
  const bool is_box = stream.NextIndex(2) == 1, is_soft = stream.NextIndex(2) == 1;
  const Eigen::Vector3d half(1.0, stream.NextUniform(0.4, 1.0), stream.NextUniform(0.2, 1.0));
  std::vector<GraspContact> contacts;
  for (int i = 0; i < num_contacts; ++i) {
    Eigen::Vector3d n = MakeRandomDirection(stream), p = -n;
    if (is_box) {
      const int axis = stream.NextIndex(3);
      n = (stream.NextIndex(2) == 0 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(axis);
      for (int k = 0; k < 3; ++k) p[k] = stream.NextUniform(-half[k], half[k]);
      p[axis] = -n[axis] * half[axis];
    }
    const double mu = stream.NextIndex(4) == 0 ? 0.4 : 0.7;
    contacts.push_back({p, n, mu, is_soft ? 0.1 * mu : 0.0, std::nullopt});
  }
  return contacts;
}

/** Turned about a random axis. */
inline Eigen::Matrix3d MakeRandomRotation(RandomStream& stream) {
  const double angle = stream.NextUniform(0.0, 6.0);
  return Eigen::AngleAxisd(angle, MakeRandomDirection(stream)).toRotationMatrix();
}

/** The contacts moved by a rotation and a translation, cone edges with them. */
inline std::vector<GraspContact> Move(std::vector<GraspContact> contacts, const Eigen::Matrix3d& R,
                                      const Eigen::Vector3d& p) {
  for (GraspContact& contact : contacts) {
    contact.p_OC = R * contact.p_OC + p;
    contact.nhat_O = R * contact.nhat_O;
    if (contact.first_edge_O) contact.first_edge_O = R * *contact.first_edge_O;
  }
  return contacts;
}

}  // namespace graspbench
