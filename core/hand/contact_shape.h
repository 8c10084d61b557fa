#pragma once
/** @file
Collision shapes of a URDF as contact: balls against objects and table, capsules against other
links. */

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
  Pose X_LS = Pose::Identity();  ///< the shape's frame S, at its middle, in the link
  Kind kind = Kind::kSphere;
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< extent along the axes of S [m]
  /** Objects and the table meet it, other links of the hand do not. In hand.urdf:
  `<collision name="cover">`. */
  bool is_cover = false;
  /** Other links of the hand meet it, objects and the table do not. In hand.urdf:
  `<collision name="self_contact">`. */
  bool is_self_contact = false;
  /** Of an import: stands for a mesh while a hand is judged; not what it touches with. */
  bool is_fitted = false;
};

/** Adds the shape to contact_spheres and to capsules, or to one of them. Balls lie so close that the
surface dips between two of them by a third of their radius at most, on a pad by a twelfth.

- A sphere stays one.
- A cylinder (along z) becomes the inscribed capsule: its ends are round and end where the cylinder
  ends. A disc, shorter than thick, becomes the box of equal volume.
- A box becomes a layer of balls of half its smallest side, which round its edges and corners. */
void AddContact(const CollisionShape& shape, bool is_pad, Hand& hand);

/** Which capsules of a hand can meet each other, and how near they are: fingers against each other
and against the palm. A finger cannot reach itself, what touches in the rest posture is built that
way, and Hand::apart names links that never count. */
struct ClosestPoints {
  Eigen::Vector3d on_a, on_b;
};
/** Nearest points of two segments (Ericson 2005, section 5.1.9). */
ClosestPoints FindClosestPoints(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                                const Eigen::Vector3d& b0, const Eigen::Vector3d& b1);

/** Of the capsule's axis, nearest to a point of its link. */
Eigen::Vector3d FindNearestOnAxis(const LinkCapsule& capsule, const Eigen::Vector3d& p_L);

/** From the capsule's surface to a point of its link; negative: inside [m]. */
double CalcDistanceToCapsule(const LinkCapsule& capsule, const Eigen::Vector3d& p_L);

/** Indices into hand.capsules. */
struct CapsulePair {
  int a = -1, b = -1;
};
std::vector<CapsulePair> FindCapsulePairs(const Hand& hand);

/** Between the surfaces of the pair; negative: inside each other [m]. */
double CalcCapsuleGap(const Hand& hand, const CapsulePair& pair, const std::vector<Pose>& X_HL);

}  // namespace graspbench
