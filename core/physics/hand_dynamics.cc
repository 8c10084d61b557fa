#include "core/physics/hand_dynamics.h"

#include <cmath>

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

SpatialInertia ShiftToWorld(const Pose& X_WL, double mass, const Vector3d& p_LLcm,
                            const Matrix3d& I_LLcm) {
  const Matrix3d R = X_WL.linear();
  const Vector3d c = X_WL * p_LLcm;
  SpatialInertia result;
  result.mass = mass;
  result.moment = mass * c;
  result.inertia = R * I_LLcm * R.transpose() +
                   mass * (c.squaredNorm() * Matrix3d::Identity() - c * c.transpose());
  return result;
}

SpatialVector CrossMotion(const SpatialVector& V, const SpatialVector& S) {
  SpatialVector result;
  const Vector3d w = V.head<3>(), v = V.tail<3>(), sw = S.head<3>(), sv = S.tail<3>();
  result.head<3>() = w.cross(sw);
  result.tail<3>() = w.cross(sv) + v.cross(sw);
  return result;
}

SpatialVector CrossForce(const SpatialVector& V, const SpatialVector& F) {
  SpatialVector result;
  const Vector3d w = V.head<3>(), v = V.tail<3>(), n = F.head<3>(), f = F.tail<3>();
  result.head<3>() = w.cross(n) + v.cross(f);
  result.tail<3>() = w.cross(f);
  return result;
}

/** Motion vector of the base's k-th speed: turns about W's axes at H's origin, then shifts. */
SpatialVector CalcBaseMotion(const Vector3d& p_WH, int k) {
  const Vector3d axis = Vector3d::Unit(k % 3);
  SpatialVector result;
  if (k < 3) {
    result << axis, p_WH.cross(axis);
  } else {
    result << Vector3d::Zero(), axis;
  }
  return result;
}

}  // namespace

SpatialVector SpatialInertia::operator*(const SpatialVector& V) const {
  const Vector3d w = V.head<3>(), v = V.tail<3>();
  SpatialVector momentum;
  momentum.head<3>() = inertia * w + moment.cross(v);
  momentum.tail<3>() = mass * v - moment.cross(w);
  return momentum;
}

HandDynamics::HandDynamics(const Hand& hand) {
  const size_t num_links = hand.links.size();
  chain_.resize(num_links);
  for (size_t i = 0; i < num_links; ++i) {
    const HandLink& link = hand.links[i];
    parent_.push_back(link.parent);
    joint_.push_back(link.joint);
    X_PJ_.push_back(link.X_PJ);
    axis_.push_back(link.axis);
    inertia_.push_back({link.mass, link.p_LLcm, link.I_LLcm});
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
  X_WL_.assign(num_links, Pose::Identity());
  inertia_W_.assign(num_links, SpatialInertia());
  S_.assign(hand.joints.size(), SpatialVector::Zero());
}

void HandDynamics::UpdatePositions(const Pose& X_WH, const Eigen::VectorXd& q) {
  p_WH_ = X_WH.translation();
  for (size_t i = 0; i < parent_.size(); ++i) {
    const Pose& X_WP = parent_[i] < 0 ? X_WH : X_WL_[parent_[i]];
    const Matrix3d R_WJ = X_WP.linear() * X_PJ_[i].linear();
    X_WL_[i].translation() = X_WP.translation() + X_WP.linear() * X_PJ_[i].translation();
    const int joint = joint_[i];
    if (joint < 0) {
      X_WL_[i].linear() = R_WJ;
      continue;
    }
    const Vector3d a_W = R_WJ * axis_[i];
    if (slides_[joint]) {
      X_WL_[i].linear() = R_WJ;
      X_WL_[i].translation() += q[joint] * a_W;
      S_[joint] << Vector3d::Zero(), a_W;
      continue;
    }
    X_WL_[i].linear() = R_WJ * Eigen::AngleAxisd(q[joint], axis_[i]).toRotationMatrix();
    S_[joint] << a_W, Vector3d(X_WL_[i].translation()).cross(a_W);
  }
  UpdateInertias();
}

void HandDynamics::TakePoses(const Pose& X_WH, const std::vector<Pose>& X_WL) {
  p_WH_ = X_WH.translation();
  X_WL_ = X_WL;
  for (size_t i = 0; i < parent_.size(); ++i) {
    const int joint = joint_[i];
    if (joint < 0) continue;
    const Vector3d a_W = X_WL_[i].linear() * axis_[i];  // which the joint does not turn
    if (slides_[joint]) {
      S_[joint] << Vector3d::Zero(), a_W;
    } else {
      S_[joint] << a_W, Vector3d(X_WL_[i].translation()).cross(a_W);
    }
  }
  UpdateInertias();
}

void HandDynamics::UpdateInertias() {
  for (size_t i = 0; i < parent_.size(); ++i) {
    inertia_W_[i] =
        ShiftToWorld(X_WL_[i], inertia_[i].mass, inertia_[i].p_LLcm, inertia_[i].I_LLcm);
  }
}

void HandDynamics::CalcMassMatrix(Eigen::Ref<Eigen::MatrixXd> M) const {
  const size_t num_links = parent_.size();
  thread_local std::vector<SpatialInertia> composite;
  composite = inertia_W_;
  M.setZero();
  thread_local Eigen::Matrix<double, 6, Eigen::Dynamic> joint_momentum;  // of a unit rate
  joint_momentum.setZero(6, num_dofs_);
  for (size_t i = num_links; i-- > 1;) {
    const int joint = joint_[i];
    if (joint >= 0 && Moves(joint)) {
      const SpatialVector F = composite[i] * S_[joint];
      ForEachSpeed(joint, [&](int dof, double rate) { joint_momentum.col(dof) += rate * F; });
      for (int ancestor : chain_[i]) {
        const double S_dot_F = S_[ancestor].dot(F);
        ForEachSpeed(joint, [&](int dof, double rate) {
          ForEachSpeed(ancestor, [&](int other, double other_rate) {
            const double value = rate * other_rate * S_dot_F;
            M(dof, other) += value;
            if (ancestor != joint) M(other, dof) += value;
          });
        });
      }
    }
    composite[parent_[i]].Add(composite[i]);
  }
  const SpatialInertia& whole = composite[0];
  for (int k = 0; k < 6; ++k) {
    const SpatialVector S_k = CalcBaseMotion(p_WH_, k);
    const SpatialVector F = whole * S_k;
    for (int j = 0; j < 6; ++j) {
      M(num_dofs_ + j, num_dofs_ + k) = CalcBaseMotion(p_WH_, j).dot(F);
    }
    M.col(num_dofs_ + k).head(num_dofs_) = joint_momentum.transpose() * S_k;
    M.row(num_dofs_ + k).head(num_dofs_) = M.col(num_dofs_ + k).head(num_dofs_).transpose();
  }
}

void HandDynamics::CalcBias(const Eigen::VectorXd& u, const Vector3d& gravity_W,
                            Eigen::Ref<Eigen::VectorXd> bias) const {
  const size_t num_links = parent_.size();
  thread_local std::vector<SpatialVector> V, A, F;
  V.resize(num_links);
  A.resize(num_links);
  F.resize(num_links);
  const Vector3d w_WH = u.segment<3>(num_dofs_), v_WH = u.segment<3>(num_dofs_ + 3);
  for (size_t i = 0; i < num_links; ++i) {
    if (i == 0) {
      V[0] << w_WH, v_WH + p_WH_.cross(w_WH);
      A[0] << Vector3d::Zero(), v_WH.cross(w_WH) - gravity_W;
    } else {
      V[i] = V[parent_[i]];
      A[i] = A[parent_[i]];
    }
    if (const int joint = joint_[i]; joint >= 0 && Moves(joint)) {
      const SpatialVector Su = S_[joint] * CalcJointSpeed(joint, u);
      A[i] += CrossMotion(V[i], Su);
      V[i] += Su;
    }
    const SpatialInertia& I = inertia_W_[i];
    F[i] = I * A[i] + CrossForce(V[i], I * V[i]);
  }
  bias.setZero();
  for (size_t i = num_links; i-- > 1;) {
    if (const int joint = joint_[i]; joint >= 0) {
      const double S_dot_F = S_[joint].dot(F[i]);
      ForEachSpeed(joint, [&](int dof, double rate) { bias[dof] += rate * S_dot_F; });
    }
    F[parent_[i]] += F[i];
  }
  for (int k = 0; k < 6; ++k) bias[num_dofs_ + k] = CalcBaseMotion(p_WH_, k).dot(F[0]);
}

}  // namespace graspbench
