#pragma once
/** @file
All quality measures of one set of contacts under one convention. A grasp has force closure if the
hull of its generators contains the origin in its interior (wrench_hull.h).

@code
QualityRequest request;
for (const double angle : {0.0, 2.1, 4.2}) {
  GraspContact contact;
  contact.nhat_O = {-std::cos(angle), -std::sin(angle), 0.0};
  contact.p_OC = -0.03 * contact.nhat_O;
  contact.mu = 0.5;
  request.contacts.push_back(contact);
}
const GraspQuality quality = CalcGraspQuality(request);  // @pre ListProblems(request) is empty
@endcode */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/quality/wrench_space.h"

namespace graspbench {

/* Epsilon is ambiguous: tools that all report "the Ferrari-Canny epsilon" define it differently.
Each definition is a named row of this table, and every result states its row.

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

"normal" and "total" state which force of a generator is one newton. "given" is supplied by the
caller; the tool's own choice is in brackets. All use the convex hull of the union of the generators
(L1). ferrari-canny and dexgraspbench also include the origin, which changes the volume of a grasp
without force closure. All except simox measure from the origin. ferrari-canny is our default: rho =
largest distance of the surface from the centre of mass.

Source: the code of the tools. Remaining differences: Simox divides by the same measure of some 300
points sampled on the whole surface, which contacts alone do not determine. GraspIt! and Simox
joggle their hull, which turns exact zeros into tiny numbers; here a flat set is exactly flat. */

enum class TorqueScaleRule { kGiven, kMeanContactDistance, kOneMetre };
enum class ReferenceRule { kGiven, kContactCentroid, kFrameOrigin };
enum class EpsilonRule {
  kFromOrigin,      ///< distance from the origin to the nearest facet
  kFromHullCentre,  ///< distance from the mean of the hull's vertices
  kTwoMinus,        ///< 2 - distance from the origin: smaller is better
};

/** Lengths of an object from which tools derive their scales. */
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
  bool includes_origin;                   ///< whether the hull includes the origin
  double friction_factor;                 ///< factor on mu and torsion
  int num_edges;                          ///< default number of edges
  std::optional<double> without_closure;  ///< epsilon without force closure; nullopt: the distance
  std::string torque_scale_meaning;       ///< in words
  /** If the caller gives the scale: the length that the tool itself would use [m]. */
  double (*calc_torque_scale)(const ObjectExtent& object);
};

/** Returns all rows in the order of the table. */
const std::vector<QualityConvention>& ListQualityConventions();
/** Returns the convention with this id. @throws Error(kNotFound) with suggestions. */
const QualityConvention& FindQualityConvention(const std::string& id);

/** Returns the smallest of the six singular values of the grasp matrix: the distance of the
contacts from a configuration in which some wrench cannot be resisted even with unlimited friction.
0 if there is such a wrench. Source: Li and Sastry, IEEE J. Robotics and Automation 4, 1988. */
double CalcMinSingularValue(const WrenchMatrix& grasp_matrix);

/** Limit on the normal forces of the contacts. */
enum class ForceLimit {
  kSum,   ///< sum at most 1 N: a fixed effort, shared freely; consistent with epsilon
  kEach,  ///< at most 1 N per contact: fingers of equal strength
};

/** Computes the largest wrench s * direction that the grasp can apply to the object:

    maximise s   subject to   sum_j lambda_j w_j = s direction,  lambda >= 0,  ForceLimit

with the weights lambda_j in newtons of normal force (of total force if the generators have unit
total force). With kSum it is the distance from the origin to the hull along the direction, and so
never below epsilon. 0 if no wrench in this direction is possible; NaN if rounding defeats the
program.

Source: Haschke, Steil, Steuwer, Ritter, "Task-oriented quality measures for dextrous grasping",
CIRA 2005, with its conic constraints replaced by the pyramids of wrench_space.h (a linear program).
@pre direction is a unit vector. */
double CalcTaskForce(const ConeWrenches& cones, const Eigen::Matrix<double, 6, 1>& direction,
                     ForceLimit limit);

/** Input of CalcGraspQuality. */
struct QualityRequest {
  std::vector<GraspContact> contacts;  ///< 2 .. 64
  QualityConvention convention = ListQualityConventions().front();
  /** 3 .. 64; times the number of contacts at most 640 (the exact hull would take minutes). Unset:
  as in the convention. */
  std::optional<int> num_edges;
  std::optional<double> torque_scale;  ///< 1e-6 .. 1e6 [m]; required if the convention uses it
  Eigen::Vector3d p_OR = Eigen::Vector3d::Zero();  ///< reference point of the moments [m]
};

/** Largest force or moment in one direction, see CalcTaskForce. */
struct TaskForce {
  std::string direction;      ///< "force +x", ..., "moment -z"; moments about the reference point
  double sum_limited = 0.0;   ///< for 1 N of normal force in total [N/N; moments: N m/N]
  double each_limited = 0.0;  ///< for at most 1 N of normal force at each contact
};

struct GraspQuality {
  std::string convention;   ///< id
  std::string description;  ///< the convention in words, with all numbers used
  WrenchSpace space;        ///< as used
  double epsilon = 0.0;     ///< as defined by the convention
  bool force_closure = false;
  double volume = 0.0;
  double min_singular_value = 0.0;
  /** Unit wrench in the direction in which the grasp can apply least; its opposite is the first
  disturbance that the grasp cannot resist. Unset without force closure. */
  std::optional<Eigen::Matrix<double, 6, 1>> weakest_wrench;
  std::vector<TaskForce> task_forces;  ///< six forces, six moments
};

/** Returns all problems of a request in words, contacts by their zero-based index. */
std::vector<std::string> ListProblems(const QualityRequest& request);

/** Computes all measures. @pre ListProblems(request) is empty.
@throws Error(kUnsupported) if the hull fails, see CalcWrenchHull. */
GraspQuality CalcGraspQuality(const QualityRequest& request);

Json ToJson(const GraspQuality& quality);

}  // namespace graspbench
