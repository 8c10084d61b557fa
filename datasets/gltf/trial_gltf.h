#pragma once
/** @file
A trial as binary glTF 2.0 (GLB), for viewers of 3-D models and for the pages of reports.

    world           rotated so that W's z axis is glTF's y axis, up
      hand          X_WH, moving
        <link> ..   the hand's tree as in hand.urdf: node frame L, revolute joints as rotations,
                    prismatic joints as translations; below each link its visual meshes
      object        X_WO, moving
      arm           X_WB of a robot arm that carries the hand; its links as a chain below it, each
                    with its capsules

Lengths are in metres, times in seconds since the start of placing. All channels share one list of
key times and are interpolated linearly (rotations spherically); nodes that do not move have no
channel. Key times have single precision and include the first and the last instant of the trial, or
the last finite one of a trial that failed numerically.

The scene's `extras` hold

    outcome, reason    of the trial
    phases             {name, time_s}: start of each phase
    times_s            of the keys
    contacts           fields: the numbers of one contact; units: their units; keys: the contacts
                       at each key, in W

Meshes are coarse, some 10,000 triangles for hand and object together (glb_file.h). */

#include <string>

#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_trace.h"

namespace graspbench {

inline constexpr double kGltfKeyRate = 30.0;  ///< keys per second

/** Makes the file. @param traced  with instants at least at the key rate. @param key_rate  [1/s].
@throws Error(kUnsupported) for a trial that could not begin. */
std::string MakeTrialGlb(const Hand& hand, const GraspObject& object, const TracedTrial& traced,
                         double key_rate = kGltfKeyRate);

/** Make the file in parts, for a page that shows many trials with few hands and objects: the motion
without meshes and names, and the meshes without motion. The `extras` of each node state its part:
{"part": index of the link, -1 for the object}. The arm's links, base first, follow the hand's. The
hand's meshes include the arm's. */
///@{
std::string MakeMotionGlb(const Hand& hand, const GraspObject& object, const TracedTrial& traced);
std::string MakeHandGlb(const Hand& hand, const MountedArm* arm = nullptr);
std::string MakeObjectGlb(const GraspObject& object);
///@}

}  // namespace graspbench
