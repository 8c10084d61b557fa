#pragma once
/** @file
The hand's positions, mass matrix and bias as Simbody's matter subsystem has them, in the degrees of
freedom of HandDynamics: for the check at the end of every trial, and for sim.multibody=simbody,
which takes them in every step. */

#include <Eigen/Core>
#include <vector>

#include "core/physics/hand_dynamics.h"
#include "core/physics/simbody_model.h"

namespace graspbench {

class SimbodyDynamics {
 public:
  /** @param simbody  of the same hand; outlives this. */
  explicit SimbodyDynamics(SimbodyModel& simbody) : simbody_(&simbody) {}

  /** @param dynamics  gives the rates of coupled joints. */
  void SetPositions(const HandDynamics& dynamics, const Pose& X_WH, const Eigen::VectorXd& q);
  const std::vector<Pose>& CalcLinkPoses();  ///< X_WL
  /** (num_speeds x num_speeds). @pre SetPositions. */
  Eigen::MatrixXd CalcMassMatrix();
  /** (num_speeds). @pre SetPositions. @param u  (num_speeds). */
  Eigen::VectorXd CalcBias(const Eigen::VectorXd& u, const Eigen::Vector3d& gravity_W);

 private:
  SimbodyModel* simbody_;
  Eigen::MatrixXd T_;  // Simbody's rates of joints and base = T_ u
  std::vector<Pose> X_WL_;
};

}  // namespace graspbench
