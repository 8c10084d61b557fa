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

#include "core/grasp/standard_grasp.h"
#include "core/render/scene.h"
#include "core/vision/camera_config.h"
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

/** A type of grasp from what the camera sees, after the thesis's words (Roethling 2007, 2.3.2):
power for what is large and roundish, two fingers for what is small or thin, all fingers for the
rest. With the smallest rectangle around the outline, length L and width W, and its fill f:

    power                 W >= 47 mm, L < 1.85 W, f >= 0.8
    two finger precision  W < 22 mm and L < 200 mm, or L < 35 mm
    all finger precision  else

The numbers are proposals of graspbench that separate the 21 objects, which they were chosen on;
mass, height and what a thing is for are not seen. Of 51 things that they were not chosen on it
suggests the wanted type for 38 (tests/core/vision/held_out_things.h): it takes flat boxes with
1.4 to 1.75 times their width as length for roundish, and does not see that a thing is thin from its
height or where it is longer than 200 mm. No pinch is suggested: only a task asks for it. Trials
choose by it where the grasp is "by-sight" (core/trial/trial_runner.h).

@pre the object was found. */
GraspType SuggestGraspType(const Sighting& seen);

}  // namespace graspbench
