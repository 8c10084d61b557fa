#pragma once
/** @file
Balls and capsules inside the solid of a link (core/hand/link_solid.h).

Balls, for objects and the table: at some open boundary points p (a probe of 5 mm gets there) with
outward normal n the largest ball that stays inside touches p,

    c = p - rho n,  rho the largest with  |c - s| >= rho - 0.15 mm  for all boundary points s,

and counts with the radius rho + 0.35 mm; rho shrinks until no more than 0.5 mm sticks out at points
some 2 mm apart. The one that stops a probe ball of 5 mm (CalcSink) within 0.65 mm of most of the
points where none does so yet is taken, repeatedly (greedy set cover), until 98 of 100 points are
covered; then in the same way within 3 mm, until all are. Where that takes more than 600 balls, as
of a sheet of 0.3 m, it is done again with three times as many points. At most 2400.

Capsules, for the hand against itself: inscribed, between centres of such balls; the one that is
within 2 mm of most of the points is taken, repeatedly, at most 8. Where less than a third of the
points is within 5 mm of one, as in a thin plate or shell, more follow between balls of the points
that are left, at most 48. */

#include <Eigen/Core>
#include <vector>

#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"
#include "core/hand/import/shapes/fit_capsules.h"
#include "core/hand/link_solid.h"

namespace graspbench {

/** Boundary points that are to be covered, where they are open. */
constexpr int kNumCoverPoints = 16000;
/** Of a link; 600 do but for sheets of 0.3 m. */
constexpr size_t kMostBalls = 2400;

/** A soft pad has no smaller ones where larger ones fit [m]. */
constexpr double kSmallestPadBall = 0.001;

/** @param present  balls that are there already, of this link. @param smallest  radius [m]; smaller
ones only where no other comes near. */
std::vector<Ball> PackBalls(const LinkSolid& solid, const std::vector<ContactSphere>& present,
                            double smallest, int num_points = kNumCoverPoints);

/** At least one where the solid has a boundary. */
std::vector<FittedCapsule> InscribeCapsules(const LinkSolid& solid);

}  // namespace graspbench
