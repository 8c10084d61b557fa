#pragma once
/** @file
The exact convex hull of generators: the set of wrenches a grasp can apply while its normal forces
sum to at most one newton (if the origin lies in it). From its facets n.w <= d follow

    epsilon = min d over all facets, 0 if negative     the wrench resisted in every direction [N]
    volume                                             [N^6]

Source: Ferrari and Canny, ICRA 1992 (the L1 measure); Miller and Allen, ICRA 1999 (volume). Hull by
Qhull (Barber, Dobkin, Huhdanpaa, ACM TOMS 22, 1996), the reentrant library: any number of threads.

Cost: some 20 ms for ten contacts with eight edges, growing faster than their square. This is the
oracle and the means of reports; inside a loop use epsilon_fast.h. */

#include <Eigen/Core>

namespace graspbench {

struct WrenchHull {
  bool is_flat = false;  ///< the points fill fewer dimensions than they have: no facets, volume 0
  Eigen::MatrixXd normals;  ///< (dim x num_facets) unit, outward
  Eigen::VectorXd offsets;  ///< (num_facets) distance of each facet's plane from the origin; signed
  Eigen::VectorXd centre;   ///< (dim) mean of the hull's vertices
  double volume = 0.0;
  /** How far Qhull moved each coordinate to get rid of a degenerate configuration: 0 as a rule,
  else about 1e-10 of the largest one. Never applied to flat sets. */
  double joggle = 0.0;
};

/** Hull of the columns of `points` (dim x num_points), 2 <= dim <= 6.
@throws Error(kUnsupported) with Qhull's own words, should it give up even on joggled points. */
WrenchHull CalcWrenchHull(const Eigen::MatrixXd& points);

/** Radius of the largest ball around the origin inside the hull; exactly 0 if the hull is flat or
does not have the origin well inside (kNegligibleShare of its largest offset). */
double CalcEpsilon(const WrenchHull& hull);

}  // namespace graspbench
