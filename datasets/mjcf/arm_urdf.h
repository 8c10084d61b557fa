#pragma once
/** @file
A hand on its robot arm as one URDF, for programs that plan or show motions.

    world            the root link; the fixed joint "arm" puts the arm's base B in it
    arm/<joint>      links and revolute joints of the arm, limits, torques and speeds included. The
                     frame of a link is that of its joint, z along the axis; the frame of
                     Denavit and Hartenberg lies behind it (core/arm/arm.h)
    the hand         hand.urdf, unchanged; the fixed joint "arm to hand" puts its root on the flange

Forward kinematics are those of CalcArmPoses and CalcLinkPoses. URDF has no place for stiffness,
armature and the coupling of a finger's joints; these are left out. */

#include <string>

#include "core/arm/mounted_arm.h"

namespace graspbench {

/** Moments of inertia as bodies have them: none is larger than the other two together. What an arm's
data leave at 0, because no joint moves it, is raised. */
Eigen::Vector3d MakePossibleInertia(Eigen::Vector3d inertia);

/** The file's text. @param hand_urdf  text of the hand's hand.urdf; addresses of meshes stay as they
are. @throws Error(kFormat) when it is no URDF, Error(kUnsupported) when the hand has a name of the
arm's. */
std::string FormatArmUrdf(const MountedArm& mounted, const Hand& hand,
                          const std::string& hand_urdf);

}  // namespace graspbench
