#pragma once
/** @file
How far what a link touches with sticks out of the link: the largest distance of its contact shapes
from the convex hull of its surface (core/shape/protrusion.h, which states the error).

A hollow of the surface that contact fills is within the hull and does not count. */

#include <string>
#include <vector>

#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Beyond, an object is touched visibly before the link reaches it; a warning [m]. */
inline constexpr double kMostProtrusion = 0.005;

/** Of the shapes of one link [m]. @param surface  meshes in the link's frame; a vertex at least. */
double CalcContactProtrusion(const std::vector<CollisionShape>& shapes,
                             const std::vector<TriMesh>& surface);

struct LinkProtrusion {
  std::string link;         ///< its name
  double protrusion = 0.0;  ///< [m]
};

/** Of the links of a hand that have both contact and a picture, whose hull is taken. */
std::vector<LinkProtrusion> CalcContactProtrusions(const Hand& hand);

}  // namespace graspbench
