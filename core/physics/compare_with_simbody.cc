#include "core/physics/compare_with_simbody.h"

#include <algorithm>

namespace graspbench {

using Eigen::VectorXd;

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
  const int joints = dynamics.num_joints(), speeds = dynamics.num_speeds();
  // Theirs = T ours: rates of joints, then the base.
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(joints + 6, speeds);
  for (int j = 0; j < joints; ++j) {
    dynamics.ForEachSpeed(j, [&](int dof, double rate) { T(j, dof) = rate; });
  }
  T.bottomRightCorner<6, 6>().setIdentity();

  VectorXd u(joints + 12);
  u << T * world.CalcHandSpeeds(), state.w_WO, state.v_WOcm;
  simbody.SetPositions(state.X_WH, state.q, MakePose(state.R_WO, state.p_WOcm));
  simbody.SetSpeeds(u);
  const Eigen::MatrixXd M_theirs =
      T.transpose() * simbody.CalcMassMatrix().topLeftCorner(joints + 6, joints + 6) * T;
  const VectorXd bias_theirs = T.transpose() * simbody.CalcBias(state.gravity_W).head(joints + 6);

  dynamics.UpdatePositions(state.X_WH, state.q);
  Eigen::MatrixXd M(speeds, speeds);
  dynamics.CalcMassMatrix(M);
  VectorXd bias(speeds);
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
