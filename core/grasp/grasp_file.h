#pragma once
/** @file
A grasp of its own file: what the optimisation writes, and `graspbench run --grasp PATH` reads.

    format: graspbench grasp
    format_version: 1
    id: new-target
    hand: tum
    made_from: g3              # the standard grasp, whose type, d and alpha it has
    object: adhesive_tape      # if given, the grasp is for this object only
    digits: [TH, FF, MF]
    tilt_deg: -3.000000
    palm_may_touch: true
    pre_deg: {FF: [..], MF: [..], TH: [..]}
    target_deg: {FF: [..], MF: [..], TH: [..]}
    placement:                 # if absent, computed (placement.h)
      position_m: [0, 0, 0.1]            # of H in W, the object at rest above W's origin
      orientation_wxyz: [0, 1, 0, 0]
      approach: [0, 0, -1]               # unit, in W
      closing_at_contact: 0.4

The same grasp can be written as isaac_grasp 1.0 (https://nvidia-isaac-ros.github.io/concepts/
manipulation/isaac_grasp.html) for other programs: the pose of the hand's root link in the object's
frame O (centre of the bounding box, x along length, z up), metres, radians, the joint names of
hand.urdf. That
format knows no digits, approach or closing law, so it is not read back. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"

namespace graspbench {

struct GraspFile {
  std::string hand;  ///< id
  Grasp grasp;
};

/** @param hands  one of them must be the file's.
@throws Error(kNotFound, kIo) when it cannot be read; Error(kFormat) listing every problem with file
and line, also that it is for none of these hands. */
GraspFile LoadGraspFile(const std::string& path, const std::vector<const Hand*>& hands);
/** The same for text in memory; `file` names it in messages. */
GraspFile ParseGraspFile(const std::string& text, const std::string& file,
                         const std::vector<const Hand*>& hands);

/** Angles with six decimals, lengths with nine: what is parsed from it differs by rounding from
`grasp` and is written again with the same text.
@param made_from  id of the standard grasp. */
std::string FormatGraspFile(const Hand& hand, const Grasp& grasp, const std::string& made_from);

/** @param object_size  length, width, height [m].  @param confidence  a success rate, in [0, 1]. */
std::string FormatIsaacGrasp(const Hand& hand, const Grasp& grasp, const std::string& object_id,
                             const Eigen::Vector3d& object_size, const Eigen::Vector3d& p_OOcm,
                             double confidence);

}  // namespace graspbench
