#pragma once
/** @file
The hand alone as a Simbody tree, with the queries of every step: link poses, carried masses and
velocity-dependent forces.

Positions, speeds and results are passed as flat arrays, and only requested quantities are computed:
the packaged library checks every access, and its full mass matrix costs several times the
contraction of composite inertias with joint motions (hand_dynamics.h).

A copy shares the tree and gets its own state at its first query. A tree belongs to one thread at a
time; copies may belong to others. */

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"

namespace graspbench {

/** A link and everything that it carries, as one rigid body about the link's origin, in W. */
struct CarriedMass {
  double mass = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< mass times position of the centre of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

class HandTree {
 public:
  explicit HandTree(const Hand& hand);
  HandTree(const HandTree& other);
  HandTree& operator=(const HandTree& other);
  ~HandTree();

  /** Sets the positions.
  @param q  (num_joints) [rad], prismatic joints [m]   @param X_WL  output, by link. */
  void SetPositions(const Pose& X_WH, const Eigen::VectorXd& q, std::vector<Pose>& X_WL);
  /** Computes the carried masses by link. @pre SetPositions. */
  void CalcCarriedMasses(std::vector<CarriedMass>& carried);
  /** Returns the Coriolis, centrifugal and gyroscopic forces (num_joints + 6); those of the base
  are about H's origin. They keep the joint rates and the velocity of H constant without gravity.
  @pre SetPositions   @param rates  (num_joints + 6): joints, then w_WH, v_WH. */
  Eigen::VectorXd CalcVelocityForces(const Eigen::VectorXd& rates);

 private:
  struct Tree;
  struct Scratch;
  Scratch& scratch();

  std::shared_ptr<const Tree> tree_;
  std::unique_ptr<Scratch> scratch_;  // null: no query yet
};

}  // namespace graspbench
