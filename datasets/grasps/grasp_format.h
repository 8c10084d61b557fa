#pragma once
/** @file
The formats of foreign grasps: one file `<id>_grasps.cc` and one line of grasp_format_list.inc each.
*/

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "datasets/grasps/foreign_grasp.h"

namespace graspbench {

/** What a file does not say, or what must not be taken from it. */
struct GraspReadOptions {
  std::string hand_frame;                ///< link of the hand whose pose the file gives
  std::string object_frame;              ///< "mesh": poses are given in it; empty: not said
  std::vector<std::string> joint_names;  ///< of a file that lists positions without names
  std::optional<double> scale;           ///< of the object's mesh
  /** Positions of an open hand, for files that state none [rad], of a prismatic joint [m]. */
  std::vector<std::pair<std::string, double>> open_joints;
};

struct GraspFormat {
  const char* id;
  const char* title;
  /** Looks at the whole file; a file may be damaged behind what is looked at. */
  bool (*recognises)(std::string_view bytes);
  /** @param file  the file's name in messages and, without folder, in the records.
  @throws Error(kFormat, kRange, kUsage) with the place. */
  std::vector<ForeignGrasp> (*read)(std::string_view bytes, const std::string& file,
                                    const GraspReadOptions& options);
};

/** In the order in which content is tried. */
const std::vector<GraspFormat>& ListGraspFormats();

#define GRASPBENCH_GRASP_FORMAT(Name) GraspFormat Make##Name##GraspFormat();
#include "datasets/grasps/grasp_format_list.inc"
#undef GRASPBENCH_GRASP_FORMAT

}  // namespace graspbench
