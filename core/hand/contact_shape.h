#pragma once
/** @file
Contact geometry of URDF collision shapes: balls for contact with objects and table, capsules for
contact with other links. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"

namespace graspbench {

struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 0.0;                               ///< [m]
};

struct CollisionShape {
  enum class Kind { kSphere, kCylinder, kBox };
  int link = -1;
  Pose X_LS = Pose::Identity();  ///< the shape's frame S, at its centre, in the link's frame
  Kind kind = Kind::kSphere;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< extent along the axes of S [m]
  /** Touches objects and the table, but no other links of the hand. In hand.urdf:
  `<collision name="cover">`. */
  bool is_cover = false;
  /** Touches other links of the hand, but neither objects nor the table. In hand.urdf:
  `<collision name="self_contact">`. */
  bool is_self_contact = false;
  /** In an import: replaces a mesh while the hand is checked; not used for contact. */
  bool is_fitted = false;
};

/** Adds the shape to contact_spheres and to capsules, or to one of them. Balls are spaced so that
the surface between two of them dips by at most a third of their radius, on a pad by a twelfth.

- A sphere stays a sphere.
- A cylinder (along z) becomes the inscribed capsule, with round ends of the same total length. A
  disc, shorter than wide, becomes the box of equal volume.
- A box becomes a layer of balls of half its smallest side in radius, so its edges and corners are
  rounded. */
void AddContact(const CollisionShape& shape, bool is_pad, Hand& hand);

/** Pairs of capsules that can touch, and their distance: fingers with each other and with the palm.
Excluded are pairs within one finger, pairs that touch in the rest posture, and links paired in
Hand::apart. */
struct ClosestPoints {
  Eigen::Vector3d on_a, on_b;
};
/** Closest points of two segments (Ericson 2005, section 5.1.9). */
ClosestPoints FindClosestPoints(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                                const Eigen::Vector3d& b0, const Eigen::Vector3d& b1);

/** Point of the capsule's axis nearest to a point in the frame of its link. */
Eigen::Vector3d FindNearestOnAxis(const LinkCapsule& capsule, const Eigen::Vector3d& p_L);

/** Signed distance of a point in the link's frame from the capsule's surface; negative inside
[m]. */
double CalcDistanceToCapsule(const LinkCapsule& capsule, const Eigen::Vector3d& p_L);

/** Indices into hand.capsules. */
struct CapsulePair {
  int a = -1, b = -1;
};
std::vector<CapsulePair> FindCapsulePairs(const Hand& hand);

/** Distance between the surfaces of the pair; negative if they overlap [m]. */
double CalcCapsuleGap(const Hand& hand, const CapsulePair& pair, const std::vector<Pose>& X_HL);

}  // namespace graspbench
