#pragma once
/** @file
Synthetic things to grasp: solids made on the spot, with sizes, densities and friction drawn
between limits. Grasps are developed on some, so that none is developed on what it is judged by, and
benchmarks have others (objects/catalogue.h). Seven families,

    sphere    with a flat spot of 1 mm to rest on
    box       a plate when it is flat
    cylinder  standing: a disc when it is flat
    rod       a cylinder that lies, of 24 sides
    ring      lying, its hole upright
    bulb      a ball on a neck, of 24 sides, lying, its weight in the ball
    cross     four flat arms

chosen by grasp type: the power grasp gets the large and the heavy, the precision grasp with two
digits and the pinch the thin and the small, the others what is in between (Roethling 2007, section
2.3). Shapes of the power grasp are 40 to 85 mm wide and taken from the side; those of encompassing
precision from above, some tall cylinders from the side. All limits are proposed by graspbench. */

#include <memory>
#include <string>
#include <vector>

#include "core/shape/grasp_object.h"

namespace graspbench {

/** Shapes of another purpose share no stream of random numbers. */
enum class ShapeUse { kTraining, kValidation, kBenchmark };

/** @param grasp  id of a standard grasp, "g1" to "g6".
@param largest  what the hand can take between its pads [m]: no width is larger.
@param judges  sizes of the objects that will judge the hand: what comes within 2 mm of one in
length, width and height is drawn again.
@returns objects without a distance field, called "training-g1-0", ..; their names say what they
are: "box, 71 x 33 x 30 mm, 34 g". */
std::vector<std::shared_ptr<const GraspObject>> MakeShapes(
    const std::string& grasp, ShapeUse use, int seed, int count, double largest,
    const std::vector<Eigen::Vector3d>& judges);

}  // namespace graspbench
