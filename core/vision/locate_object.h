#pragma once
/** @file
Locates a known object from one picture of it on the table and one of the empty table.

The object is the region that differs from the empty table. Its contour, undistorted, is projected
onto the horizontal plane through the object's middle, and the object's own outline is fitted to it
(silhouette.h). O is the middle of its bounding box, however its area is distributed. The result is
never a guess. An empty picture, several objects, an object that is cut by the picture's edge, and
an outline that does not match give a reason instead of a pose. */

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
  std::string reason;  ///< the reason for a person; empty if the object is found
  PlanarPose pose;
  KnownDirection direction = KnownDirection::kNone;
  /** Observed outline, projected onto the horizontal plane through the object's middle [m]. */
  std::vector<Eigen::Vector2d> outline = {};
  /** Smallest rectangle around the outline; its length and width are repeated below. */
  Rectangle rectangle = {};
  double length = 0.0, width = 0.0;
  double fill = 0.0;  ///< ratio of the outline's area to that of its convex hull
};

/** Locates the object.
@param empty_table   from the same camera pose, of the same size.
@param X_WK      pose of the camera, which looks down.
@param supposed  decides between rotations with the same outline. */
Sighting LocateObject(const Image& picture, const Image& empty_table, const Lens& lens,
                      const Pose& X_WK, const OutlineModel& object, const PlanarPose& supposed);

/** Suggests a type of grasp from the observed outline, following the thesis (Roethling 2007,
2.3.2): power for large and roundish objects, two fingers for small or thin ones, all fingers for
the rest. The rules use the smallest rectangle around the outline, with length L and width W, and
the fill f:

    power                 W >= 47 mm, L < 1.85 W, f >= 0.8
    two finger precision  W < 22 mm and L < 200 mm, or L < 35 mm
    all finger precision  else

The thresholds are proposed by graspbench and were chosen to separate the 21 objects. Mass, height
and the purpose of an object are not observed. For 51 other objects the suggestion is the desired
type in 38 cases (tests/core/vision/held_out_things.h). It classifies flat boxes with a length of
1.4 to 1.75 times their width as roundish. It does not recognise objects that are thin in height, or
thin and longer than 200 mm. A pinch is never suggested, because only a task can require it. Trials
with the grasp "by-sight" use this function (core/trial/trial_runner.h).

@pre the object was found. */
GraspType SuggestGraspType(const Sighting& seen);

}  // namespace graspbench
