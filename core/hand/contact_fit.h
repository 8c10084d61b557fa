#pragma once
/** @file
How well balls cover the solid of a link (link_solid.h), measured both ways:

- out: how far their surface sticks out of the solid, of points on the parts of the balls that no
  other ball holds;
- sink: how far a probe ball of 5 mm sinks into the solid before a ball stops it. It comes along the
  outward normal of a boundary point p: with v = p + R n - c from the ball's centre c, radius r,

      sink = n.v - sqrt((n.v)^2 - v.v + (R + r)^2),

  the least of all balls of the hand at zero posture that it meets, at least 0. Where none is met it
  counts as 10 mm;
- self contact: which share of the boundary points lies within 5 mm of a capsule of the link. Other
  links of the hand meet the capsules alone.

Points inside a ball of a neighbouring link do not count. A point is palmar where its normal is
within 60 deg of the palm's, all joints at zero. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/hand/link_solid.h"

namespace graspbench {

/** Farther out or in at the palmar side or a tip, a hand is not believed; a warning from the second
on [m]. */
inline constexpr double kMostContactError = 0.005, kFairContactError = 0.001;
/** A point is near a capsule [m]; a warning where a smaller share of a link's points is. */
inline constexpr double kNearSelfContact = 0.005, kFairSelfContact = 0.5;

/** Of a quantity over points: 95 of 100 have no more; the most [m]. */
struct ContactError {
  double at_95 = 0.0, most = 0.0;
};

struct ContactFit {
  std::string link;  ///< its name
  int num_balls = 0;
  ContactError out, sink, palmar_out, palmar_sink;
  int num_capsules = 0;
  double self_contact = 0.0;  ///< share of the boundary points
};

/** One place where a ball of radius `radius` comes along -nhat to p. @returns its sink, 10 mm where
the ball is not met [m]. */
double CalcSink(const Eigen::Vector3d& p, const Eigen::Vector3d& nhat, const Eigen::Vector3d& c,
                double r);

/** Unit vectors to points 1.5 mm apart on a sphere, at least 60 and at most 2000 (a spiral). */
std::vector<Eigen::Vector3d> SpreadOnSphere(double radius);

/** Of the links that have both balls and a solid. @param num_points  on a link. */
std::vector<ContactFit> MeasureContact(const Hand& hand, const LinkSolids& solids,
                                       int num_points = 2000);

/** Of a hand against its pictures. */
std::vector<ContactFit> MeasureContact(const Hand& hand);

/** "its 12 balls stick out of its surface by up to 0.5 mm, a ball of 5 mm sinks in by 0.8 mm at 95
of 100 points". */
std::string DescribeContactError(const ContactFit& fit);

/** "its 2 capsules for contact with the hand itself are within 5 mm of 31 % of its surface; other
links enter the rest". */
std::string DescribeSelfContact(const ContactFit& fit);

}  // namespace graspbench
