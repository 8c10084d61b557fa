#pragma once
/** @file
All quality measures of one set of contacts under one convention.

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

#include <optional>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/quality/quality_convention.h"
#include "core/quality/wrench_space.h"

namespace graspbench {

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

/** @returns every problem of a request in words, contacts by their zero-based index; empty: none.
 */
std::vector<std::string> ListProblems(const QualityRequest& request);

/** @pre ListProblems finds nothing.
@throws Error(kUnsupported) should the hull fail, see CalcWrenchHull. */
GraspQuality CalcGraspQuality(const QualityRequest& request);

Json ToJson(const GraspQuality& quality);

}  // namespace graspbench
