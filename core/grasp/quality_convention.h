#pragma once
/** @file
Epsilon is not one number: tools that all report "the Ferrari-Canny epsilon" form it differently.
Each way is a row of one table here, with a name, and every result names the row it was formed by.

| id            | force in a generator | moment divided by         | about            | distance
from  | mu    | edges | no closure | | ferrari-canny | unit normal          | given | given | origin
| x 1   | 8     | 0          | | graspit       | unit normal          | given: largest distance   |
given: centre    | origin         | x 1   | 8     | -1         | |               | | of the surface
from it    | of mass          |                |       |       |            | | simox         | unit
total           | given: half the bounding  | given: centre    | hull's centre  | x 1   | 8     | as
it is   | |               |                      | length                    | of mass          | |
|       |            | | dexgraspbench | unit normal          | mean distance of contacts |
contacts'        | origin, shown  | x 1/2 | 8     | 2          | |               | | from their
centroid       | centroid         | as 2 - epsilon |       |       |            | | dex-net       |
unit normal          | given: median of bounding | given: centre    | origin         | x 1   | 8 | 0
| |               |                      | box's upper corner        | of mass          | |       |
|            | | frogger       | unit total           | 1 m (not scaled)          | contacts' frame
| origin         | x 1   | 4     | -1         |

All take the convex hull of the union of the generators (L1). "given" is what the caller gives; the
text behind the colon says what the tool would give. ferrari-canny is ours: rho = largest distance
of the surface from the centre of mass.

Source: read in the tools' own code. Differences kept: Simox divides by the same number of some 300
points sampled on the whole surface, which contacts alone do not tell; GraspIt! and Simox joggle
their hull, which turns exact zeros into tiny numbers; here a flat set is exactly flat. */

#include <optional>
#include <string>
#include <vector>

#include "core/grasp/wrench_space.h"

namespace graspbench {

enum class TorqueScaleRule { kGiven, kMeanContactDistance, kOneMetre };
enum class ReferenceRule { kGiven, kContactCentroid, kFrameOrigin };
enum class EpsilonRule {
  kFromOrigin,      ///< distance of the nearest facet from the origin
  kFromHullCentre,  ///< ... from the mean of the hull's vertices
  kTwoMinus,        ///< 2 - distance from the origin: smaller is better
};

struct QualityConvention {
  std::string id;
  UnitForce unit_force;
  TorqueScaleRule torque_scale;
  ReferenceRule reference;
  EpsilonRule epsilon;
  double friction_factor;                 ///< mu and torsion are multiplied by it
  int num_edges;                          ///< unless the caller says otherwise
  std::optional<double> without_closure;  ///< reported then; unset: the distance as it is
  std::string torque_scale_meaning;       ///< in words
};

/** All rows in the order of the table. */
const std::vector<QualityConvention>& ListQualityConventions();
/** @throws Error(kNotFound) with suggestions. */
const QualityConvention& FindQualityConvention(const std::string& id);

}  // namespace graspbench
