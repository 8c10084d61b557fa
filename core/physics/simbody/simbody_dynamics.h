#pragma once
/** @file
The hand's positions, mass matrix and bias as Simbody's matter subsystem has them, in the degrees of
freedom of HandDynamics: for the check at the end of every trial, and for sim.multibody=simbody,
which takes them in every step. */

#include <Eigen/Core>
#include <vector>

#include "core/physics/hand_dynamics.h"
#include "core/physics/simbody/simbody_model.h"
#include "core/physics/world.h"

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

/** A larger difference means that one of both is wrong; rounding alone makes about 1e-11. */
inline constexpr double kSimbodyTolerance = 1e-9;

/** Compares the hand's equations of motion with Simbody's: every trial does so once, so that a wrong
inertia never yields a result.
@returns the largest difference of mass matrix and bias from Simbody's at the world's state, each
relative to its largest entry; the degrees of freedom also apart from the base, which is so much
heavier that both have a scale of their own.
@param simbody  of the same hand and object, all joints free; its state is overwritten. */
double CompareWithSimbody(World& world, SimbodyModel& simbody);

}  // namespace graspbench
