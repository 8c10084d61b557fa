#include "core/physics/simbody_dynamics.h"

namespace graspbench {

void SimbodyDynamics::SetPositions(const HandDynamics& dynamics, const Pose& X_WH,
                                   const Eigen::VectorXd& q) {
  T_ = Eigen::MatrixXd::Zero(dynamics.num_joints() + 6, dynamics.num_speeds());
  for (int j = 0; j < dynamics.num_joints(); ++j) {
    dynamics.ForEachSpeed(j, [&](int dof, double rate) { T_(j, dof) = rate; });
  }
  T_.bottomRightCorner<6, 6>().setIdentity();
  simbody_->SetPositions(X_WH, q, Pose::Identity());
}

const std::vector<Pose>& SimbodyDynamics::CalcLinkPoses() {
  simbody_->CalcLinkPoses(X_WL_);
  return X_WL_;
}

Eigen::MatrixXd SimbodyDynamics::CalcMassMatrix() {
  const Eigen::Index n = T_.rows();
  return T_.transpose() * simbody_->CalcMassMatrix().topLeftCorner(n, n) * T_;
}

Eigen::VectorXd SimbodyDynamics::CalcBias(const Eigen::VectorXd& u,
                                          const Eigen::Vector3d& gravity_W) {
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(T_.rows() + 6);  // the object stands still
  rates.head(T_.rows()) = T_ * u;
  simbody_->SetSpeeds(rates);
  return T_.transpose() * simbody_->CalcBias(gravity_W).head(T_.rows());
}

}  // namespace graspbench
