#pragma once
/** @file
A hand on its robot arm as one URDF, for programs that plan or show motions.

    world            the root link; the fixed joint "arm" attaches the arm's base B to it
    arm/<joint>      links and revolute joints of the arm, with limits, torques and speeds. A link
                     has the frame of its joint, with z along the axis; the Denavit-Hartenberg
                     frame follows it (core/arm/arm.h)
    the hand         hand.urdf, unchanged; the fixed joint "arm to hand" attaches its root to the
                     flange

Forward kinematics equal CalcArmPoses and CalcLinkPoses. URDF cannot represent stiffness, armature
and the coupling of finger joints; these are left out. */

#include <string>

#include "core/arm/mounted_arm.h"

namespace graspbench {

/** Makes moments of inertia physically possible: none may exceed the sum of the other two.
Increases those that an arm's data leave at 0 because no joint excites them. */
Eigen::Vector3d MakePossibleInertia(Eigen::Vector3d inertia);

/** Formats the file. @param hand_urdf  text of the hand's hand.urdf; mesh paths are not changed.
@throws Error(kFormat) when it is not a URDF; Error(kUnsupported) when the hand uses a name of the
arm. */
std::string FormatArmUrdf(const MountedArm& mounted, const Hand& hand,
                          const std::string& hand_urdf);

}  // namespace graspbench
