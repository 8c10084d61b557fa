#pragma once
/** @file
Collision shapes of a URDF as contact: balls against objects and table, capsules against other
links. */

#include "core/hand/hand.h"

namespace graspbench {

struct CollisionShape {
  enum class Kind { kSphere, kCylinder, kBox };
  int link = -1;
  Pose X_LS = Pose::Identity();  ///< the shape's frame S, at its middle, in the link
  Kind kind = Kind::kSphere;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< extent along the axes of S [m]
  /** Objects and the table meet it, other links of the hand do not: it lies within the others'
  solid and fills in their surface. In hand.urdf: `<collision name="cover">`. */
  bool is_cover = false;
};

/** Adds the shape to contact_spheres and, but for a cover, to capsules. Balls lie so close that the
surface dips between two of them by a third of their radius at most, on a pad by a twelfth.

- A sphere stays one.
- A cylinder (along z) becomes the inscribed capsule: its ends are round and end where the cylinder
  ends. A disc, shorter than thick, becomes the box of equal volume.
- A box becomes a layer of balls of half its smallest side, which round its edges and corners. */
void AddContact(const CollisionShape& shape, bool is_pad, Hand& hand);

}  // namespace graspbench
