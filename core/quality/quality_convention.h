#pragma once
/** @file
Epsilon is not one number: tools that all report "the Ferrari-Canny epsilon" form it differently.
Each way is a row of one table here, with a name, and every result names the row it was formed by.

  id             force   moment / by, about                            mu     edges  not closed
  ferrari-canny  normal  given, given                                   x 1    8      0
  graspit        normal  given (largest distance of the surface),       x 1    8      -1
                         given (centre of mass)
  simox          total   given (half the bounding length),              x 1    8      as it is
                         given (centre of mass); from the hull's centre
  dexgraspbench  normal  mean distance of the contacts from their       x 1/2  8      2
                         centroid, centroid; shown as 2 - epsilon
  dex-net        normal  given (median of the bounding box's upper      x 1    8      0
                         corner), given (centre of mass)
  frogger        total   1 m (not scaled), origin of the frame          x 1    4      -1

"normal" and "total" say which force of a generator is one newton. "given" is what the caller gives;
in brackets, what the tool would give. All take the convex hull of the union of the generators (L1),
ferrari-canny and dexgraspbench together with the origin, which shows in the volume of a grasp that
is not closed; all but simox measure from the origin. ferrari-canny is ours: rho = largest distance
of the surface from the centre of mass.

Source: read in the tools' own code. Differences kept: Simox divides by the same number of some 300
points sampled on the whole surface, which contacts alone do not tell; GraspIt! and Simox joggle
their hull, which turns exact zeros into tiny numbers; here a flat set is exactly flat. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/quality/wrench_space.h"

namespace graspbench {

enum class TorqueScaleRule { kGiven, kMeanContactDistance, kOneMetre };
enum class ReferenceRule { kGiven, kContactCentroid, kFrameOrigin };
enum class EpsilonRule {
  kFromOrigin,      ///< distance of the nearest facet from the origin
  kFromHullCentre,  ///< ... from the mean of the hull's vertices
  kTwoMinus,        ///< 2 - distance from the origin: smaller is better
};

/** What tools take their lengths from. */
struct ObjectExtent {
  double radius = 0.0;  ///< largest distance of the surface from the centre of mass [m]
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< of the bounding box [m]
};

/** A new convention is a row of the table and a line of the list above. */
struct QualityConvention {
  std::string id;
  UnitForce unit_force;
  TorqueScaleRule torque_scale;
  ReferenceRule reference;
  EpsilonRule epsilon;
  bool includes_origin;                   ///< in the set whose hull is taken
  double friction_factor;                 ///< mu and torsion are multiplied by it
  int num_edges;                          ///< unless the caller says otherwise
  std::optional<double> without_closure;  ///< reported then; unset: the distance as it is
  std::string torque_scale_meaning;       ///< in words
  /** Where the caller gives it: the length the tool itself would take [m]. */
  double (*calc_torque_scale)(const ObjectExtent& object);
};

/** All rows in the order of the table. */
const std::vector<QualityConvention>& ListQualityConventions();
/** @throws Error(kNotFound) with suggestions. */
const QualityConvention& FindQualityConvention(const std::string& id);

}  // namespace graspbench
