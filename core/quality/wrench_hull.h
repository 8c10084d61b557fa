#pragma once
/** @file
The exact convex hull of generators. If it contains the origin, it is the set of wrenches that a
grasp can apply while its normal forces sum to at most one newton. Its facets n.w <= d give

    epsilon = min d over all facets, 0 if negative     the wrench resisted in every direction [N]
    volume                                             [N^6]

Source: Ferrari and Canny, ICRA 1992 (the L1 measure); Miller and Allen, ICRA 1999 (volume). The
hull is computed by Qhull (Barber, Dobkin, Huhdanpaa, ACM TOMS 22, 1996) in its reentrant version,
which allows any number of threads.

Cost: some 20 ms for ten contacts with eight edges, growing faster than their square. Use this as
the reference and for reports, and epsilon_fast.h in loops. */

#include <Eigen/Core>

namespace graspbench {

struct WrenchHull {
  bool is_flat = false;  ///< the points span fewer dimensions than they have: no facets, volume 0
  Eigen::MatrixXd normals;  ///< (dim x num_facets) unit, outward
  Eigen::VectorXd offsets;  ///< (num_facets) signed distance of each facet's plane from the origin
  Eigen::VectorXd centre;   ///< (dim) mean of the hull's vertices
  double volume = 0.0;
  /** Distance by which Qhull moved each coordinate to resolve a degenerate configuration: usually
  0, otherwise about 1e-10 of the largest coordinate. Flat sets are never joggled. */
  double joggle = 0.0;
};

/** Computes the hull of the columns of `points` (dim x num_points), 2 <= dim <= 6.
@throws Error(kUnsupported) with Qhull's message if it fails even on joggled points. */
WrenchHull CalcWrenchHull(const Eigen::MatrixXd& points);

/** Returns the radius of the largest ball around the origin inside the hull. It is exactly 0 if the
hull is flat or if the origin is not well inside it (kNegligibleShare of its largest offset). */
double CalcEpsilon(const WrenchHull& hull);

}  // namespace graspbench
