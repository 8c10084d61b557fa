#pragma once
/** @file
The hand and the object as a Simbody multibody system, as a reference.

Bodies: the hand's root on a Free mobilizer, one Pin, Slider or Weld per link, and the object on a
Free mobilizer about its centre of mass. Generalised speeds are ordered as

    u = [ joint rates (num_joints) | w_WH (3) | v_WH (3) | w_WO (3) | v_WOcm (3) ]

with the last four expressed in W; v_WH is the velocity of H's origin.

Debian's Simbody is built without NDEBUG, which changes the layout of its classes, so this library
must be built without it, too (checked in the .cc). One model belongs to one thread. */

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

class SimbodyModel {
 public:
  /** @param coupled  if given, constraints tie coupled joints to their middle joints as the hand's
  rule prescribes in this mode; otherwise all joints are free. */
  SimbodyModel(const Hand& hand, const MassProperties& object,
               std::optional<DistalMode> coupled = std::nullopt);
  ~SimbodyModel();

  int num_speeds() const;  ///< num_joints + 12

  /** Sets all positions.
  @param X_WH  the hand's frame H; @param q  all joint angles;
  @param X_WOcm  the object's centre of mass, axes of O. */
  void SetPositions(const Pose& X_WH, const Eigen::VectorXd& q, const Pose& X_WOcm);
  /** Sets all speeds. @pre SetPositions. */
  void SetSpeeds(const Eigen::VectorXd& u);

  /** Returns the poses X_WL of all links; requires a realisation of the position stage. */
  void CalcLinkPoses(std::vector<Pose>& X_WL);

  /** Returns the mass matrix (num_speeds x num_speeds) by Simbody's calcM. Too slow for a loop. */
  Eigen::MatrixXd CalcMassMatrix();
  /** Returns the generalised force (num_speeds) that gives zero acceleration under gravity:
  Coriolis, centrifugal, gyroscopic and gravitational, by Simbody's
  calcResidualForceIgnoringConstraints. */
  Eigen::VectorXd CalcBias(const Eigen::Vector3d& gravity_W);
  /** Returns the accelerations of all joints under torques and gravity (num_joints) [rad/s^2], with
  the root at constant velocity and the constraints of coupled joints. By Simbody's
  calcAcceleration. */
  Eigen::VectorXd CalcJointAccelerations(const Eigen::VectorXd& torques,
                                         const Eigen::Vector3d& gravity_W);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace graspbench
