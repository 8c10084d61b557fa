#pragma once
/** @file
The hand alone as a tree of Simbody, with what every step asks of it: where the links are, what each
carries, and the forces of velocity.

Positions, speeds and results go through flat arrays, and only what is asked for is calculated: the
packaged library checks every access, and its whole mass matrix costs several times the
contraction of composite inertias with the joints' motions (hand_dynamics.h).

A copy shares the tree and gets a state of its own when it is first asked; a tree belongs to one
thread at a time, copies may belong to others. */

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"

namespace graspbench {

/** A link and all that it carries, as one rigid body, about the link's origin, in W. */
struct CarriedMass {
  double mass = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< mass times place of the centre of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

class HandTree {
 public:
  explicit HandTree(const Hand& hand);
  HandTree(const HandTree& other);
  HandTree& operator=(const HandTree& other);
  ~HandTree();

  /** @param q  (num_joints) [rad], of prismatic joints [m]   @param X_WL  set, by link. */
  void SetPositions(const Pose& X_WH, const Eigen::VectorXd& q, std::vector<Pose>& X_WL);
  /** By link. @pre SetPositions. */
  void CalcCarriedMasses(std::vector<CarriedMass>& carried);
  /** Coriolis, centrifugal and gyroscopic forces (num_joints + 6), those of the base about H's
  origin: what keeps the joints' rates and the velocity of H constant without gravity.
  @pre SetPositions   @param rates  (num_joints + 6): of the joints, then w_WH, v_WH. */
  Eigen::VectorXd CalcVelocityForces(const Eigen::VectorXd& rates);

 private:
  struct Tree;
  struct Scratch;
  Scratch& scratch();

  std::shared_ptr<const Tree> tree_;
  std::unique_ptr<Scratch> scratch_;  // null: not asked yet
};

}  // namespace graspbench
