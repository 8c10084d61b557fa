#pragma once
/** @file
Where the tactile elements of the project's hands lie. Their number is known, their places are
proposals: centres of cells of nearly equal area. */

#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/hand/tactile.h"

namespace graspbench {

/** Cuts a surface into `count` cells (Lloyd 1982, from the points farthest from each other) and
puts an element into the middle of each. @pre there are as many points. */
std::vector<TactileElement> PlaceElements(const SensedPart& part,
                                          const std::vector<SurfacePoint>& points, int count);

/** tactile.yaml of a form of the Shadow Hand ("shadow..."), else of the TUM Hand, in full. */
std::string MakeTactileYaml(const Hand& hand);

}  // namespace graspbench
