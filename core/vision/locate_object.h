#pragma once
/** @file
Where a known object lies, from one picture of it on the table and one of the empty table.

What differs from the empty table is the object: its contour, undistorted, is thrown onto the level
plane through the object's middle, and the object's own outline is laid onto it (silhouette.h). O is
the middle of its bounding box, however its area is spread. Nothing is ever guessed: an empty
picture, several things, one that the picture's edge cuts, or an outline that is not the object's
give a reason instead of a pose. */

#include <string>
#include <vector>

#include "core/render/scene.h"
#include "core/vision/lens.h"
#include "core/vision/picture_tools.h"
#include "core/vision/silhouette.h"

namespace graspbench {

struct Sighting {
  bool is_found = false;
  std::string reason;  ///< why not, for a person; empty when it is found
  PlanarPose pose;
  KnownDirection direction = KnownDirection::kNone;
  /** What is seen, thrown onto the level plane through the object's middle [m]. */
  std::vector<Eigen::Vector2d> outline = {};
  /** The smallest around the outline; its length and width once more. */
  Rectangle rectangle = {};
  double length = 0.0, width = 0.0;
  double fill = 0.0;  ///< area of the outline over that of its convex hull
};

/** @param empty_table   from the same place, of the same size.
@param X_WK      of the camera, which looks down.
@param supposed  decides between turns that look alike. */
Sighting LocateObject(const Image& picture, const Image& empty_table, const Lens& lens,
                      const Pose& X_WK, const OutlineModel& object, const PlanarPose& supposed);

}  // namespace graspbench
