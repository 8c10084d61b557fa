#pragma once
/** @file
All quality measures of one set of contacts under one convention; a grasp is force closed where the
hull of its generators has the origin inside (wrench_hull.h).

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

/* Epsilon is not one number: tools that all report "the Ferrari-Canny epsilon" form it differently.
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

/** Smallest of the six singular values of the grasp matrix: how far the contacts are from a
configuration in which some wrench cannot be resisted at all, friction being unlimited. 0 if there
is such a wrench. Source: Li and Sastry, IEEE J. Robotics and Automation 4, 1988. */
double CalcMinSingularValue(const WrenchMatrix& grasp_matrix);

/** What the normal forces of the contacts may be. */
enum class ForceLimit {
  kSum,   ///< together at most 1 N: a fixed effort shared freely; consistent with epsilon
  kEach,  ///< at most 1 N at each contact: fingers of equal strength
};

/** The largest wrench s * direction the grasp can put on the object:

    maximise s   subject to   sum_j lambda_j w_j = s direction,  lambda >= 0,  ForceLimit

with the weights lambda_j in newtons of normal force (of total force where the generators have unit
total force). With kSum, the distance from the origin to the hull along the direction, thus never
below epsilon. 0 if the direction cannot be served at all; NaN should rounding defeat the program.

Source: Haschke, Steil, Steuwer, Ritter, "Task-oriented quality measures for dextrous grasping",
CIRA 2005, with its conic constraints replaced by the pyramids of wrench_space.h (a linear program).
@pre direction is a unit vector. */
double CalcTaskForce(const ConeWrenches& cones, const Eigen::Matrix<double, 6, 1>& direction,
                     ForceLimit limit);

/** What is asked. */
struct QualityRequest {
  std::vector<GraspContact> contacts;  ///< 2 .. 64
  QualityConvention convention = ListQualityConventions().front();
  /** 3 .. 64, times the contacts at most 640 (the exact hull would take minutes); unset: as the
  convention has it. */
  std::optional<int> num_edges;
  std::optional<double> torque_scale;  ///< 1e-6 .. 1e6 [m]; needed if the convention uses it
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
  std::string description;  ///< the convention in words, with every number that went in
  WrenchSpace space;        ///< as it was used
  double epsilon = 0.0;     ///< as the convention reports it
  bool force_closure = false;
  double volume = 0.0;
  double min_singular_value = 0.0;
  /** Unit wrench the grasp resists least (its opposite, put on the object, is the first to break
  it); unset without force closure. */
  std::optional<Eigen::Matrix<double, 6, 1>> weakest_wrench;
  std::vector<TaskForce> task_forces;  ///< six forces, six moments
};

/** @returns every problem of a request in words, contacts by their zero-based index. */
std::vector<std::string> ListProblems(const QualityRequest& request);

/** @pre ListProblems finds nothing.
@throws Error(kUnsupported) should the hull fail, see CalcWrenchHull. */
GraspQuality CalcGraspQuality(const QualityRequest& request);

Json ToJson(const GraspQuality& quality);

}  // namespace graspbench
