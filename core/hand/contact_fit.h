#pragma once
/** @file
How well the balls of a link cover its solid (link_solid.h), measured in both directions:

- out: how far the balls stick out of the solid, at points of a ball's surface that lie in no other
  ball;
- sink: how far a probe ball of 5 mm sinks into the solid before a ball stops it. The probe
  approaches a boundary point p along its outward normal n. With v = p + R n - c from the centre c
  of a ball of radius r,

      sink = n.v - sqrt((n.v)^2 - v.v + (R + r)^2).

  The result is the least value over all balls of the hand in its zero posture, at least 0. It is
  10 mm if the probe meets no ball;
- self contact: the share of the boundary points within 5 mm of a capsule of the link. Other links
  of the hand touch the capsules only.

Points inside a ball of another link do not count. A point is palmar if its normal is within 60 deg
of the palm's, with all joints at zero. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/hand/link_solid.h"

namespace graspbench {

/** Largest error on the palmar side or at a tip beyond which a hand is rejected, and the error
beyond which there is a warning [m]. */
inline constexpr double kMostContactError = 0.005, kFairContactError = 0.001;
/** Distance at which a point counts as near a capsule [m], and the share of near points of a link
below which there is a warning. */
inline constexpr double kNearSelfContact = 0.005, kFairSelfContact = 0.5;

/** Distribution of an error over points: 95th percentile and maximum [m]. */
struct ContactError {
  double at_95 = 0.0, most = 0.0;
};

struct ContactFit {
  std::string link;  ///< name of the link
  int num_balls = 0;
  ContactError out, sink, palmar_out, palmar_sink;
  int num_capsules = 0;
  double self_contact = 0.0;  ///< share of the boundary points
};

/** Sink of a probe that comes along -nhat to boundary point p, at a single ball with centre c and
radius r [m]; 10 mm if it misses the ball. */
double CalcSink(const Eigen::Vector3d& p, const Eigen::Vector3d& nhat, const Eigen::Vector3d& c,
                double r);

/** Unit vectors to points 1.5 mm apart on a sphere, at least 60 and at most 2000, on a spiral. */
std::vector<Eigen::Vector3d> SpreadOnSphere(double radius);

/** Measures the links that have both balls and a solid. @param num_points  points per link. */
std::vector<ContactFit> MeasureContact(const Hand& hand, const LinkSolids& solids,
                                       int num_points = 2000);

/** Measures a hand against the solids of its visual meshes. */
std::vector<ContactFit> MeasureContact(const Hand& hand);

/** Formats "its 12 balls stick out of its surface by up to 0.5 mm, a ball of 5 mm sinks in by 0.8
mm at 95 of 100 points". */
std::string DescribeContactError(const ContactFit& fit);

/** Formats "its 2 capsules for contact with the hand itself are within 5 mm of 31 % of its surface;
other links enter the rest". */
std::string DescribeSelfContact(const ContactFit& fit);

}  // namespace graspbench
