#pragma once
/** @file
Collision shapes of a URDF as contact: balls against objects and table, capsules against other
links. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"
#include "core/shape/tri_mesh.h"

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

/** How far what a link touches with sticks out of the link: the largest distance of its contact
shapes from the convex hull of its surface (CalcProtrusion, which states the error).

A hollow of the surface that contact fills is within the hull and does not count.

Beyond, an object is touched visibly before the link reaches it; a warning [m]. */
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

/** How far balls stick out of the convex hull of points.

With K the hull, the protrusion of a ball of centre c and radius r is the largest distance of its
points from K,

    max over |u| = 1 of  dist(c + r u, K).

A capsule has that of its two end balls, because the distance from a convex set is convex. The
distance of one point is found by the algorithm of Gilbert, Johnson and Keerthi (1988). The largest
is sought from 400 fixed directions u, evenly spread; from each that exceeds the largest so far, u
turns away from the nearest point of K until the distance grows no more.

Error: K is the hull of so many of the points that none lies more than 0.05 mm outside it, so the
result is at most 0.05 mm too large. Every direction lies within 0.14 rad of one of the 400, so the
result is at most 1 - cos(0.14), 1 % of the ball's radius, too small. Both are upper bounds: over a
flat face of a polyhedron the result is exact to 0.1 micrometres. */
struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 0.0;                               ///< [m]
};

/** The largest of all balls [m]; 0: none sticks out. @pre points and balls are finite, and there is
a point. */
double CalcProtrusion(const std::vector<Eigen::Vector3d>& points, const std::vector<Ball>& balls);

/** Which capsules of a hand can meet each other, and how near they are: fingers against each other
and against the palm. A finger cannot reach itself, what touches in the rest posture is built that
way, and Hand::apart names links that never count. */
struct ClosestPoints {
  Eigen::Vector3d on_a, on_b;
};
/** Nearest points of two segments (Ericson 2005, section 5.1.9). */
ClosestPoints FindClosestPoints(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                                const Eigen::Vector3d& b0, const Eigen::Vector3d& b1);

/** Indices into hand.capsules. */
struct CapsulePair {
  int a = -1, b = -1;
};
std::vector<CapsulePair> FindCapsulePairs(const Hand& hand);

/** Between the surfaces of the pair; negative: inside each other [m]. */
double CalcCapsuleGap(const Hand& hand, const CapsulePair& pair, const std::vector<Pose>& X_HL);

}  // namespace graspbench
