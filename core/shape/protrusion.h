#pragma once
/** @file
How far balls stick out of the convex hull of points.

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

#include <Eigen/Core>
#include <vector>

namespace graspbench {

struct Ball {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 0.0;                               ///< [m]
};

/** The largest of all balls [m]; 0: none sticks out. @pre points and balls are finite, and there is
a point. */
double CalcProtrusion(const std::vector<Eigen::Vector3d>& points, const std::vector<Ball>& balls);

}  // namespace graspbench
