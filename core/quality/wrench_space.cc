#include "core/quality/wrench_space.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

constexpr double kUnitTolerance = 1e-6;

using Wrench = Eigen::Matrix<double, 6, 1>;

Wrench MakeWrench(const GraspContact& contact, const WrenchSpace& space,
                  const Eigen::Vector3d& force, double moment_about_normal) {
  Wrench wrench;
  wrench.head<3>() = force;
  wrench.tail<3>() =
      ((contact.p_OC - space.p_OR).cross(force) + moment_about_normal * contact.nhat_O) /
      space.torque_scale;
  return wrench;
}

Eigen::Vector3d CalcFirstTangent(const GraspContact& contact) {
  Eigen::Vector3d direction;
  if (contact.first_edge_O) {
    direction = contact.first_edge_O->normalized();
  } else {
    Eigen::Index axis = 0;
    contact.nhat_O.cwiseAbs().minCoeff(&axis);
    direction = Eigen::Vector3d::Unit(axis);
  }
  return (direction - direction.dot(contact.nhat_O) * contact.nhat_O).normalized();
}

}  // namespace

ConeWrenches CalcConeWrenches(const std::vector<GraspContact>& contacts, const WrenchSpace& space) {
  GRASPBENCH_DEMAND(space.num_edges >= 3, "edges: " + std::to_string(space.num_edges));
  GRASPBENCH_DEMAND(space.torque_scale > 0.0, fmt::format("scale: {:.9g}", space.torque_scale));
  ConeWrenches cones;
  cones.wrenches.resize(6, contacts.size() * (space.num_edges + 2));
  const auto add = [&](int contact_index, const Wrench& wrench) {
    cones.wrenches.col(cones.contact_indices.size()) = wrench;
    cones.contact_indices.push_back(contact_index);
  };
  for (size_t i = 0; i < contacts.size(); ++i) {
    const GraspContact& contact = contacts[i];
    const Eigen::Vector3d& n = contact.nhat_O;
    const Eigen::Vector3d t1 = CalcFirstTangent(contact), t2 = n.cross(t1);
    const double length =
        space.unit_force == UnitForce::kTotal ? std::sqrt(1.0 + contact.mu * contact.mu) : 1.0;
    const int num_edges = contact.mu > 0.0 ? space.num_edges : 1;
    for (int j = 0; j < num_edges; ++j) {
      const double angle = 2.0 * kPi * j / num_edges;
      const Eigen::Vector3d tangent = std::cos(angle) * t1 + std::sin(angle) * t2;
      add(i, MakeWrench(contact, space, (n + contact.mu * tangent) / length, 0.0));
    }
    if (contact.torsion > 0.0) {
      for (const double sign : {1.0, -1.0}) {
        add(i, MakeWrench(contact, space, n, sign * contact.torsion));
      }
    }
  }
  cones.wrenches.conservativeResize(6, cones.contact_indices.size());
  return cones;
}

WrenchMatrix CalcGraspMatrix(const std::vector<GraspContact>& contacts, const WrenchSpace& space) {
  WrenchMatrix matrix(6, 4 * contacts.size());
  int num_columns = 0;
  for (const GraspContact& contact : contacts) {
    const Eigen::Vector3d& n = contact.nhat_O;
    const Eigen::Vector3d t1 = CalcFirstTangent(contact);
    matrix.col(num_columns++) = MakeWrench(contact, space, n, 0.0);
    if (contact.mu > 0.0) {
      matrix.col(num_columns++) = MakeWrench(contact, space, t1, 0.0);
      matrix.col(num_columns++) = MakeWrench(contact, space, n.cross(t1), 0.0);
    }
    if (contact.torsion > 0.0) {
      matrix.col(num_columns++) = MakeWrench(contact, space, Eigen::Vector3d::Zero(), 1.0);
    }
  }
  matrix.conservativeResize(6, num_columns);
  return matrix;
}

std::vector<int> FindAffineBasis(const Eigen::Ref<const Eigen::MatrixXd>& points) {
  if (points.cols() == 0) return {};
  Eigen::Index index = 0;
  const double scale = std::sqrt(points.colwise().squaredNorm().maxCoeff(&index));
  std::vector<int> basis{static_cast<int>(index)};
  Eigen::MatrixXd rest = points.colwise() - points.col(index);
  while (static_cast<Eigen::Index>(basis.size()) <= points.rows()) {
    const double distance = std::sqrt(rest.colwise().squaredNorm().maxCoeff(&index));
    if (!(distance > kNegligibleShare * scale)) break;
    basis.push_back(static_cast<int>(index));
    const Eigen::VectorXd direction = rest.col(index) / distance;
    rest -= direction * (direction.transpose() * rest).eval();
  }
  return basis;
}

bool IsPosition(const Eigen::Vector3d& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= 100.0;
}

std::string FindProblem(const GraspContact& contact) {
  if (!IsPosition(contact.p_OC)) {
    return fmt::format(
        "the position is ({:.9g}, {:.9g}, {:.9g}); expected three numbers within 100 m",
        contact.p_OC.x(), contact.p_OC.y(), contact.p_OC.z());
  }
  const double length = contact.nhat_O.norm();
  // This and the following are written so that NaN fails them.
  if (!(std::abs(length - 1.0) <= kUnitTolerance)) {
    return fmt::format(
        "the normal's length is {:.9g}; expected 1 within 1e-6 (a unit vector into the object)",
        length);
  }
  if (!(contact.mu >= 0.0 && contact.mu <= 100.0)) {
    return fmt::format("the friction coefficient is {:.9g}; expected 0 to 100", contact.mu);
  }
  if (!(contact.torsion >= 0.0 && contact.torsion <= 100.0)) {
    return fmt::format("the torsion is {:.9g} m; expected 0 to 100 m", contact.torsion);
  }
  if (contact.first_edge_O &&
      !(contact.first_edge_O->normalized().cross(contact.nhat_O).norm() > kUnitTolerance)) {
    return "the direction of the first cone edge is zero or along the normal; expected a tangent";
  }
  return "";
}

}  // namespace graspbench
