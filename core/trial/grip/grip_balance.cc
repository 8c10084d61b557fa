#include "core/trial/grip/grip_balance.h"

#include <algorithm>

namespace graspbench {

using Eigen::Vector3d;

std::vector<PartLoad> CalcPartLoads(const std::vector<HandContact>& contacts,
                                    const std::vector<int>& parts, int num_parts,
                                    const HandDynamics& dynamics, const Vector3d& gravity_W) {
  const Vector3d down_W = gravity_W.normalized();
  std::vector<PartLoad> loads(static_cast<size_t>(num_parts));
  for (PartLoad& load : loads) load.torque = Eigen::VectorXd::Zero(dynamics.num_dofs());
  for (const HandContact& contact : contacts) {
    PartLoad& load = loads[static_cast<size_t>(parts[static_cast<size_t>(contact.link)])];
    load.force += contact.normal_force;
    const Vector3d f_W = contact.normal_force * contact.nhat_W + contact.friction_W;
    load.push_W += f_W - f_W.dot(down_W) * down_W;
    for (const int joint : dynamics.chain(contact.link)) {
      const SpatialVector& S = dynamics.motion(joint);
      const Vector3d v_W = S.tail<3>() + S.head<3>().cross(contact.p_WC);
      const double way = contact.nhat_W.dot(v_W);
      dynamics.ForEachSpeed(joint, [&](int dof, double rate) {
        load.torque[dof] += contact.normal_force * rate * way;
      });
    }
  }
  for (PartLoad& load : loads) {
    if (load.force <= 0.0) continue;
    load.push_W /= load.force;
    load.torque /= load.force;
  }
  return loads;
}

void BalanceForces(const std::vector<PartLoad>& loads, const std::vector<int>& free,
                   std::vector<double>& forces) {
  for (const int part : free) forces[static_cast<size_t>(part)] = 0.0;
  Vector3d rest_W = Vector3d::Zero();
  for (size_t i = 0; i < loads.size(); ++i) rest_W -= forces[i] * loads[i].push_W;
  const auto push = [&](int part) { return loads[static_cast<size_t>(part)].push_W; };
  if (free.size() == 2) {
    const Vector3d a = push(free[0]), b = push(free[1]);
    const double determinant = a.dot(a) * b.dot(b) - a.dot(b) * a.dot(b);
    if (determinant > 1e-6) {
      const double x = (b.dot(b) * a.dot(rest_W) - a.dot(b) * b.dot(rest_W)) / determinant;
      const double y = (a.dot(a) * b.dot(rest_W) - a.dot(b) * a.dot(rest_W)) / determinant;
      if (x >= 0.0 && y >= 0.0) {
        forces[static_cast<size_t>(free[0])] = x;
        forces[static_cast<size_t>(free[1])] = y;
        return;
      }
    }
  }
  // One of them alone, that which leaves least.
  int best = -1;
  double best_force = 0.0, least = rest_W.squaredNorm();
  for (const int part : free) {
    const Vector3d n = push(part);
    if (n.squaredNorm() == 0.0) continue;
    const double force = std::max(0.0, n.dot(rest_W) / n.squaredNorm());
    if (const double left = (rest_W - force * n).squaredNorm(); left < least) {
      best = part;
      best_force = force;
      least = left;
    }
  }
  if (best >= 0) forces[static_cast<size_t>(best)] = best_force;
}

double CalcClosingStiffness(const Hand& hand, const HandDynamics& dynamics, const PartLoad& load,
                            const Eigen::VectorXd& way) {
  double gain = 0.0, compliance = 0.0;
  for (int dof = 0; dof < dynamics.num_dofs(); ++dof) {
    const int joint = dynamics.joint_of_dof(dof);
    const double arm = load.torque[dof];
    if (dynamics.is_deviation(dof)) {
      compliance += arm * arm * hand.joints[static_cast<size_t>(joint)].coupling_compliance;
      continue;
    }
    gain += arm * way[joint];
    compliance += arm * arm / hand.joints[static_cast<size_t>(joint)].drive.stiffness;
  }
  if (!(compliance > 0.0)) return kLeastStiffness;
  return std::max(kLeastStiffness, gain / compliance);
}

}  // namespace graspbench
