#include "core/physics/compare_with_simbody.h"

#include <algorithm>

#include "core/physics/simbody_dynamics.h"

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
  const int speeds = dynamics.num_speeds();
  SimbodyDynamics theirs(simbody);
  theirs.SetPositions(dynamics, state.X_WH, state.q);
  const Eigen::MatrixXd M_theirs = theirs.CalcMassMatrix();
  const VectorXd bias_theirs = theirs.CalcBias(world.CalcHandSpeeds(), state.gravity_W);

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
