#pragma once
/** @file
Layout of the tactile elements of the project's hands. Their number is published; their positions
are proposals: centres of cells of nearly equal area. */

#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/hand/tactile.h"

namespace graspbench {

/** Partitions a surface into `count` cells (Lloyd 1982, starting from the points farthest apart)
and places an element at the centre of each. @pre there are at least `count` points. */
std::vector<TactileElement> PlaceElements(const SensedPart& part,
                                          const std::vector<SurfacePoint>& points, int count);

/** The complete tactile.yaml of a variant of the Shadow Hand ("shadow..."), otherwise of the TUM
Hand. */
std::string MakeTactileYaml(const Hand& hand);

}  // namespace graspbench
