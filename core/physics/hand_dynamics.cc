#include "core/physics/hand_dynamics.h"

namespace graspbench {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

HandDynamics::HandDynamics(const Hand& hand) : tree_(hand) {
  const size_t num_links = hand.links.size();
  chain_.resize(num_links);
  carried_moment_.resize(num_links);
  for (size_t i = 0; i < num_links; ++i) {
    const HandLink& link = hand.links[i];
    parent_.push_back(link.parent);
    joint_.push_back(link.joint);
    link_mass_.push_back(link.mass);
    p_LLcm_.push_back(link.p_LLcm);
    axis_.push_back(link.axis);
    if (link.parent >= 0) chain_[i] = chain_[link.parent];
    if (link.joint >= 0) chain_[i].push_back(link.joint);
  }
  dof_of_joint_.assign(hand.joints.size(), -1);
  deviation_dof_.assign(hand.joints.size(), -1);
  rate_.assign(hand.joints.size(), 1.0);
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    joint_link_.push_back(hand.joints[j].link);
    slides_.push_back(hand.joints[j].is_prismatic);
    const bool yields = hand.joints[j].coupling_compliance > 0.0;
    if (hand.joints[j].coupled_to >= 0 && !yields) continue;
    (hand.joints[j].coupled_to >= 0 ? deviation_dof_ : dof_of_joint_)[j] = num_dofs_++;
    joint_of_dof_.push_back(static_cast<int>(j));
    distal_of_dof_.push_back(-1);
  }
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    if (hand.joints[j].coupled_to < 0) continue;
    dof_of_joint_[j] = dof_of_joint_[hand.joints[j].coupled_to];
    if (hand.joints[j].is_mimic) {
      rate_[j] = hand.joints[j].mimic_ratio;
      continue;
    }
    distal_of_dof_[dof_of_joint_[j]] = static_cast<int>(j);
  }
  carried_mass_ = link_mass_;
  for (size_t i = num_links; i-- > 1;) carried_mass_[parent_[i]] += carried_mass_[i];
  X_WL_.assign(num_links, Pose::Identity());
  S_.assign(hand.joints.size(), SpatialVector::Zero());
}

void HandDynamics::UpdatePositions(const Pose& X_WH, const VectorXd& q) {
  p_WH_ = X_WH.translation();
  tree_.SetPositions(X_WH, q, X_WL_);
  for (size_t i = 0; i < joint_.size(); ++i) {
    const int joint = joint_[i];
    if (joint < 0) continue;
    const Vector3d a_W = X_WL_[i].linear() * axis_[i];  // the joint does not rotate it
    if (slides_[joint]) {
      S_[joint] << Vector3d::Zero(), a_W;
    } else {
      S_[joint] << a_W, Vector3d(X_WL_[i].translation()).cross(a_W);
    }
  }
  for (size_t i = 0; i < joint_.size(); ++i) {
    carried_moment_[i] = link_mass_[i] * (X_WL_[i] * p_LLcm_[i]);
  }
  for (size_t i = joint_.size(); i-- > 1;) carried_moment_[parent_[i]] += carried_moment_[i];
}

void HandDynamics::CalcMassMatrix(Eigen::Ref<Eigen::MatrixXd> M) {
  tree_.CalcCarriedMasses(carried_);
  M.setZero();
  for (size_t i = joint_.size(); i-- > 1;) {
    const int joint = joint_[i];
    if (joint < 0 || !Moves(joint)) continue;
    // Momentum of a unit rate, first about the link's origin, then about the world's.
    const CarriedMass& carried = carried_[i];
    const Vector3d turn = S_[joint].head<3>();
    const Vector3d slide = slides_[joint] ? Vector3d(S_[joint].tail<3>()) : Vector3d::Zero();
    const Vector3d linear = carried.mass * slide + turn.cross(carried.moment);
    SpatialVector F;
    F << carried.inertia * turn + carried.moment.cross(slide) +
             Vector3d(X_WL_[i].translation()).cross(linear),
        linear;
    for (const int ancestor : chain_[i]) {
      const double S_dot_F = S_[ancestor].dot(F);
      ForEachSpeed(joint, [&](int dof, double rate) {
        ForEachSpeed(ancestor, [&](int other, double other_rate) {
          const double value = rate * other_rate * S_dot_F;
          M(dof, other) += value;
          if (ancestor != joint) M(other, dof) += value;
        });
      });
    }
    F.head<3>() -= p_WH_.cross(linear);  // the base rotates about H's origin
    ForEachSpeed(joint,
                 [&](int dof, double rate) { M.col(dof).segment<6>(num_dofs_) += rate * F; });
  }
  M.topRightCorner(num_dofs_, 6) = M.bottomLeftCorner(6, num_dofs_).transpose();
  M.bottomRightCorner<6, 6>() = CalcBaseMass();
}

/** Mass matrix of the whole hand about H's origin. */
Eigen::Matrix<double, 6, 6> HandDynamics::CalcBaseMass() const {
  const CarriedMass& whole = carried_[0];
  const Vector3d r = X_WL_[0].translation() - p_WH_;  // root's origin relative to H's
  const Vector3d moment = whole.moment + whole.mass * r;
  const auto cross = [](const Vector3d& a) {
    return (Matrix3d() << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0).finished();
  };
  // Steiner's theorem for a first point that is not the centre of mass either.
  const Matrix3d inertia =
      whole.inertia - cross(r) * cross(whole.moment) - cross(moment) * cross(r);
  Eigen::Matrix<double, 6, 6> result;
  result << inertia, cross(moment), cross(moment).transpose(), whole.mass * Matrix3d::Identity();
  return result;
}

void HandDynamics::CalcBias(const VectorXd& u, const Vector3d& gravity_W,
                            Eigen::Ref<VectorXd> bias) {
  bias.setZero();
  for (size_t i = 1; i < joint_.size(); ++i) {
    if (joint_[i] < 0) continue;
    SpatialVector weight;
    weight << carried_moment_[i].cross(gravity_W), carried_mass_[i] * gravity_W;
    const double force = S_[joint_[i]].dot(weight);
    ForEachSpeed(joint_[i], [&](int dof, double rate) { bias[dof] -= rate * force; });
  }
  bias.segment<3>(num_dofs_) -= (carried_moment_[0] - carried_mass_[0] * p_WH_).cross(gravity_W);
  bias.segment<3>(num_dofs_ + 3) -= carried_mass_[0] * gravity_W;
  if (u.head(num_dofs_ + 3).cwiseAbs().maxCoeff() < kFastSpeed) return;
  VectorXd rates(num_joints() + 6);
  for (int joint = 0; joint < num_joints(); ++joint) rates[joint] = CalcJointSpeed(joint, u);
  rates.tail<6>() = u.segment<6>(num_dofs_);
  const VectorXd forces = tree_.CalcVelocityForces(rates);
  for (int joint = 0; joint < num_joints(); ++joint) {
    ForEachSpeed(joint, [&](int dof, double rate) { bias[dof] += rate * forces[joint]; });
  }
  bias.segment<6>(num_dofs_) += forces.tail<6>();
}

}  // namespace graspbench
