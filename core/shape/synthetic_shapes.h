#pragma once
/** @file
Synthetic objects to grasp: procedurally generated solids whose sizes, densities and friction are
drawn uniformly from ranges. Grasps are developed on one set, so that none is developed on the
objects that evaluate it; benchmarks have another set (objects/catalogue.h). There are seven
families,

    sphere    with a flat spot of 1 mm to rest on
    box       a flat one is a plate
    cylinder  upright; a flat one is a disc
    rod       a lying cylinder with 24 sides
    ring      lying, with a vertical hole
    bulb      a ball on a neck with 24 sides, lying, with its centre of mass in the ball
    cross     four flat arms

assigned to grasp types. The power grasp gets large and heavy shapes, the precision grasp with two
digits and the pinch get thin and small ones, and the others get those in between (Roethling 2007,
section 2.3). Shapes of the power grasp are 40 to 85 mm wide and approached from the side. Those of
encompassing precision are approached from above, except some tall cylinders. All limits are
proposed by graspbench. */

#include <memory>
#include <string>
#include <vector>

#include "core/shape/grasp_object.h"

namespace graspbench {

/** Purpose of the shapes. Different purposes use independent random streams. */
enum class ShapeUse { kTraining, kValidation, kBenchmark };

/** Generates synthetic shapes.
@param grasp  id of a standard grasp, "g1" to "g6".
@param largest  largest width that the hand can take between its pads [m]; no width exceeds it.
@param judges  sizes of the objects that will evaluate the hand. A shape within 2 mm of one of them
in length, width and height is drawn again.
@returns objects without a distance field, with ids such as "training-g1-0". Their names describe
them: "box, 71 x 33 x 30 mm, 34 g". */
std::vector<std::shared_ptr<const GraspObject>> MakeShapes(
    const std::string& grasp, ShapeUse use, int seed, int count, double largest,
    const std::vector<Eigen::Vector3d>& judges);

}  // namespace graspbench
