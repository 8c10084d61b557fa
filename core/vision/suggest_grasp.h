#pragma once
/** @file
A type of grasp from what the camera sees, after the thesis's words (Roethling 2007, 2.3.2): power
for what is large and roundish, two fingers for what is small or thin, all fingers for the rest.
With the smallest rectangle around the outline, length L and width W, and its fill f:

    power                 W >= 47 mm, L < 1.85 W, f >= 0.8
    two finger precision  W < 22 mm and L < 200 mm, or L < 35 mm
    all finger precision  else

The numbers are proposals of graspbench that separate the 21 objects, which they were chosen on;
mass, height and what a thing is for are not seen. Of 51 things that they were not chosen on it
suggests the wanted type for 38 (tests/core/vision/held_out_things.h): it takes flat boxes with
1.4 to 1.75 times their width as length for roundish, and does not see that a thing is thin from its
height or where it is longer than 200 mm. No pinch is suggested: only a task asks for it. Trials
choose by it where the grasp is "by-sight" (core/trial/grasp_by_sight.h). */

#include "core/grasp/standard_grasp.h"
#include "core/vision/locate_object.h"

namespace graspbench {

/** @pre the object was found. */
GraspType SuggestGraspType(const Sighting& seen);

}  // namespace graspbench
