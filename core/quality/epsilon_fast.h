#pragma once
/** @file
Epsilon without the whole hull: the radius of the largest ball around the origin inside the convex
hull of points,

    epsilon = min over unit u of h(u),    h(u) = max over i of w_i.u,

exactly, in a fraction of a millisecond (ten contacts with eight edges: about 0.15 ms, a hundred
times faster than the hull).

Method: an inner polytope grows where it is weakest. It starts as a simplex of the points; its facet
nearest to the origin (the signed distance d counts, so the origin may still lie outside) is looked
through: the point farthest beyond it, at h(normal), joins the polytope, which regains convexity
along the horizon of that point. At every moment

    min d over facets  <=  epsilon  <=  min h over the normals looked through,

the left side because the polytope lies inside the hull, the right side because every h is an upper
bound; when no point lies beyond the nearest facet, both are equal. If some h is not positive the
points lie on one side of a plane through the origin: no force closure, epsilon = 0. Only the part
of the hull near its weakest facet is ever built.

Source: the expanding polytope algorithm, van den Bergen, "Proximity queries and penetration depth
computation on 3D game objects", GDC 2001; for wrench spaces Zheng, "An efficient algorithm for a
grasp quality measure", IEEE Trans. Robotics 29, 2013. Facets are made as positive combinations of
the two planes that meet at a horizon ridge, so that coplanar points (the rule on boxes) need no
special care. */

#include <Eigen/Core>

namespace graspbench {

struct EpsilonBounds {
  double lower = 0.0;  ///< [N]; equal to upper but for rounding
  double upper = 0.0;
  /** Unit vector (dim) along which the grasp can apply least, `upper`; a disturbance along the
  opposite direction is the first it cannot resist. Without force closure: a direction in which it
  can apply nothing at all; empty if the points are flat. */
  Eigen::VectorXd weakest_direction;
};

/** Bounds for the columns of `points` (dim x num_points), dim 3 (planar grasps) or 6. Both are
exactly 0 without force closure and for flat sets. */
EpsilonBounds CalcEpsilonBounds(const Eigen::MatrixXd& points);

}  // namespace graspbench
