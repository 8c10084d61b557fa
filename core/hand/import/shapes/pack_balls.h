#pragma once
/** @file
Packs balls and capsules into the solid of a link (core/hand/link_solid.h).

Balls, for objects and the table: candidates touch open boundary points p (which a probe of 5 mm can
reach) with outward normal n and are the largest balls that stay inside,

    c = p - rho n,  rho the largest with  |c - s| >= rho - 0.15 mm  for all boundary points s.

Their radius is rho + 0.35 mm; rho shrinks until they stick out by at most 0.5 mm at points about
2 mm apart. The ball that stops a probe ball of 5 mm (CalcSink) within 0.65 mm of most of the points
not yet covered is added, repeatedly (greedy set cover), until 98 of 100 points are covered. The
same is repeated with 3 mm until all are covered. If this takes more than 600 balls, as for a sheet
of 0.3 m, it is done again with three times as many points and at most 2400 balls.

Capsules, for self-contact of the hand: inscribed, between centres of such balls. The one within 2
mm of most of the points is added, repeatedly, up to 8. If fewer than a third of the points are then
within 5 mm of a capsule, as in a thin plate or shell, more are added between balls of the remaining
points, up to 48. */

#include <Eigen/Core>
#include <vector>

#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"
#include "core/hand/import/shapes/fit_capsules.h"
#include "core/hand/link_solid.h"

namespace graspbench {

/** Number of boundary points, of which the open ones are to be covered. */
constexpr int kNumCoverPoints = 16000;
/** Largest number of balls of a link; 600 suffice except for sheets of 0.3 m. */
constexpr size_t kMostBalls = 2400;

/** Smallest radius of a ball on a soft pad where larger ones fit [m]. */
constexpr double kSmallestPadBall = 0.001;

/** @param present  balls that the link already has. @param smallest  least radius [m]; smaller
balls are used only where no other comes near. */
std::vector<Ball> PackBalls(const LinkSolid& solid, const std::vector<ContactSphere>& present,
                            double smallest, int num_points = kNumCoverPoints);

/** Returns at least one capsule if the solid has a boundary. */
std::vector<FittedCapsule> InscribeCapsules(const LinkSolid& solid);

}  // namespace graspbench
