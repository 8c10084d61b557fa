#include "core/physics/simbody/simbody_dynamics.h"

#include <algorithm>

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

namespace {

/** Largest difference over the largest of their entries, or over `least` if that is more. */
double CalcDifference(const Eigen::MatrixXd& ours, const Eigen::MatrixXd& theirs,
                      double least = 0.0) {
  return (ours - theirs).cwiseAbs().maxCoeff() / std::max(theirs.cwiseAbs().maxCoeff(), least);
}

}  // namespace

double CompareWithSimbody(World& world, SimbodyModel& simbody) {
  HandDynamics& dynamics = world.dynamics();
  const WorldState& state = world.state();
  const int speeds = dynamics.num_speeds();
  SimbodyDynamics theirs(simbody);
  theirs.SetPositions(dynamics, state.X_WH, state.q);
  const Eigen::MatrixXd M_theirs = theirs.CalcMassMatrix();
  const Eigen::VectorXd bias_theirs = theirs.CalcBias(world.CalcHandSpeeds(), state.gravity_W);

  dynamics.UpdatePositions(state.X_WH, state.q);
  Eigen::MatrixXd M(speeds, speeds);
  dynamics.CalcMassMatrix(M);
  Eigen::VectorXd bias(speeds);
  dynamics.CalcBias(world.CalcHandSpeeds(), state.gravity_W, bias);
  // The base is so much heavier than a finger that both have a scale of their own.
  const int dofs = dynamics.num_dofs();
  // Slides that lie level have no bias but rounding: what their masses weigh is its scale then.
  const double weight =
      M_theirs.topLeftCorner(dofs, dofs).cwiseAbs().maxCoeff() * state.gravity_W.norm();
  return std::max({CalcDifference(M, M_theirs),
                   CalcDifference(M.topLeftCorner(dofs, dofs), M_theirs.topLeftCorner(dofs, dofs)),
                   CalcDifference(bias, bias_theirs),
                   CalcDifference(bias.head(dofs), bias_theirs.head(dofs), weight)});
}

}  // namespace graspbench
