#pragma once
/** @file
A trial as binary glTF 2.0 (GLB), for viewers of 3-D models and for the pages of reports.

    world           turned so that W's z axis is glTF's y, up
      hand          X_WH, moving
        <link> ..   the hand's tree as in hand.urdf: node frame L, joints as rotations, sliding
                    joints as translations; below each the meshes of its looks
      object        X_WO, moving
      arm           X_WB of a robot arm that carries the hand; its links in a chain below it, each
                    with its capsules

Lengths are metres, times seconds since the start of placing. All channels share one row of key
times and are linear (rotations spherically) between them; what does not move has no channel. The
first and the last instant of the trial are keys, in single precision; of a trial that failed
numerically the last that is finite.

The scene's `extras` hold

    outcome, reason    of the trial
    phases             {name, time_s}: where each began
    times_s            of the keys
    contacts           fields: what the numbers of one contact are; units: what 1 stands for;
                       keys: for each key its contacts, in W

Meshes are coarse, some 10,000 triangles for hand and object together (glb_file.h). */

#include <string>

#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_trace.h"

namespace graspbench {

inline constexpr double kGltfKeyRate = 30.0;  ///< keys a second

/** @param traced  with instants at least as often as there are keys.   @param key_rate  [1/s]
@throws Error(kUnsupported) for a trial that could not begin. */
std::string MakeTrialGlb(const Hand& hand, const GraspObject& object, const TracedTrial& traced,
                         double key_rate = kGltfKeyRate);

/** The same in parts, for a page that shows many trials with few hands and objects: the motion
without meshes and names, the meshes without motion. A node of either says where it belongs in its
`extras`: {"part": link's index, -1 for the object;
behind the hand's links come those of the arm, its base first}. The hand's meshes are with the
arm's. */
///@{
std::string MakeMotionGlb(const Hand& hand, const GraspObject& object, const TracedTrial& traced);
std::string MakeHandGlb(const Hand& hand, const MountedArm* arm = nullptr);
std::string MakeObjectGlb(const GraspObject& object);
///@}

}  // namespace graspbench
