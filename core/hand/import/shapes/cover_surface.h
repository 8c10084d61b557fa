#pragma once
/** @file
Balls for what the contact shapes of a link leave out of its surface: edges, corners and flat ends,
which balls of the link's half thickness round off.

Points are spread evenly over the outside of the solids. At each the largest ball that touches the
surface there and stays inside the solid is a candidate,

    c = p - rho n,  rho the largest with  dist(c, surface) >= rho,

so none of them sticks out. The one that comes near to most of the points that are still too far
away is taken, repeatedly (greedy set cover). */

#include <Eigen/Core>
#include <vector>

#include "core/hand/hand.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

/** As much of the surface may lie outside all balls, at 95 of 100 points [m]. */
constexpr double kMostUncovered = 0.0015;

/** Spread over the surface of a link. */
constexpr int kNumCoverPoints = 2000;

struct SurfaceCover {
  struct Ball {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double radius = 0.0;  ///< [m]
  };
  std::vector<Ball> balls;
  double uncovered = 0.0;  ///< 95 of 100 points lie no farther outside all balls [m]
};

/** @param solids  of one link, in its frame [m]; they may overlap and be open.
@param present  balls that are there already, of this link. At most 200 balls are added. */
SurfaceCover CoverSurface(const std::vector<TriMesh>& solids,
                          const std::vector<ContactSphere>& present,
                          int num_points = kNumCoverPoints);

}  // namespace graspbench
