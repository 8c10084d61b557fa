#pragma once
/** @file
How a hand closes beyond the posture that a file states, as the sources of grasps of one stage do:
their posture touches the object, and what presses is a command beyond it. */

#include <Eigen/Core>

#include "core/trial/protocols/profiled_scene.h"

namespace graspbench {

/** What the joints are asked for after the last stage, by the profile's rule:

  stated  what that stage states
  press   q + c sum J^T (-n), over the links whose point nearest to the object lies less than the
          reach from its surface: J its Jacobian (3, joints), n the outward normal there. The step
          along the gradient of DexGraspNet (Wang et al. 2023, scripts/validate_grasps.py):
          c = 2 x 0.001 m x 500 rad/m^2 = 1 rad/m
  limits  every joint that bends a digit at the end at which it is closed (core/hand/closing.h),
          others as stated. MultiGripperGrasp (Casas et al. 2024): its table of closing joints

@returns (num_joints) [rad], [m]. */
Eigen::VectorXd CalcClosingCommand(const ProfiledScene& scene, const FreeSpaceProfile& profile);

}  // namespace graspbench
