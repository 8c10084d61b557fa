#pragma once
/** @file
File of a single grasp, written by the optimisation and read by `graspbench run --grasp PATH`.

    format: graspbench grasp
    format_version: 1
    id: new-target
    hand: tum
    made_from: g3              # the standard grasp that gives type, d and alpha
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
    course:                    # if given, placing and closing follow it (grasp_course.h)
      period_s: 0.02
      closure_start_s: 0.02
      x_m: [0, 0, 0]           # displacement of H from its grasp position in its axes, last zero
      y_m: [0.001, 0, 0]
      z_m: [-0.02, -0.01, 0]
      closing: {FF: [0, 0, 0.4], MF: [0, 0.1, 0.4], TH: [0, 0.2, 0.4]}

The same grasp can be exported as isaac_grasp 1.0 (https://nvidia-isaac-ros.github.io/concepts/
manipulation/isaac_grasp.html). It states the pose of the hand's root link in the object's frame O
(centre of the bounding box, x along length, z up), in metres and radians, with the joint names of
hand.urdf. That format has no digits, approach, course or closing law, so it cannot be read back. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"

namespace graspbench {

struct GraspFile {
  std::string hand;  ///< id of the hand
  Grasp grasp;
};

/** @param hands  known hands; the file's hand must be one of them.
@throws Error(kNotFound, kIo) when the file cannot be read; Error(kFormat) with every problem by
file and line, including a hand that is not in `hands`. */
GraspFile LoadGraspFile(const std::string& path, const std::vector<const Hand*>& hands);
/** Parses the text of a grasp file; `file` names it in messages. */
GraspFile ParseGraspFile(const std::string& text, const std::string& file,
                         const std::vector<const Hand*>& hands);

/** Formats a grasp file, angles with six decimals and lengths with nine. The parsed text differs
from `grasp` by rounding only, and is written again as the same text.
@param made_from  id of the standard grasp. */
std::string FormatGraspFile(const Hand& hand, const Grasp& grasp, const std::string& made_from);

/** @param object_size  length, width, height [m].  @param confidence  success rate in [0, 1]. */
std::string FormatIsaacGrasp(const Hand& hand, const Grasp& grasp, const std::string& object_id,
                             const Eigen::Vector3d& object_size, const Eigen::Vector3d& p_OOcm,
                             double confidence);

}  // namespace graspbench
