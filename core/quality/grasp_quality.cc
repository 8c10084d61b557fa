#include "core/quality/grasp_quality.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/quality/linear_program.h"
#include "core/quality/wrench_hull.h"

namespace graspbench {
namespace {

double CalcRadius(const ObjectExtent& object) { return object.radius; }

double CalcHalfDiagonal(const ObjectExtent& object) { return 0.5 * object.size.norm(); }

double CalcMedianHalfSide(const ObjectExtent& object) {
  std::array<double, 3> corner = {0.5 * object.size.x(), 0.5 * object.size.y(),
                                  0.5 * object.size.z()};
  std::sort(corner.begin(), corner.end());
  return corner[1];
}

}  // namespace

const std::vector<QualityConvention>& ListQualityConventions() {
  static const auto* const kConventions = new std::vector<QualityConvention>{
      {"ferrari-canny", UnitForce::kNormal, TorqueScaleRule::kGiven, ReferenceRule::kGiven,
       EpsilonRule::kFromOrigin, true, 1.0, 8, 0.0,
       "as given; meant: largest distance of the surface from the centre of mass", CalcRadius},
      {"graspit", UnitForce::kNormal, TorqueScaleRule::kGiven, ReferenceRule::kGiven,
       EpsilonRule::kFromOrigin, false, 1.0, 8, -1.0,
       "as given; meant: largest distance of the surface from the centre of mass", CalcRadius},
      {"simox", UnitForce::kTotal, TorqueScaleRule::kGiven, ReferenceRule::kGiven,
       EpsilonRule::kFromHullCentre, false, 1.0, 8, std::nullopt,
       "as given; meant: half the bounding length", CalcHalfDiagonal},
      {"dexgraspbench", UnitForce::kNormal, TorqueScaleRule::kMeanContactDistance,
       ReferenceRule::kContactCentroid, EpsilonRule::kTwoMinus, true, 0.5, 8, 2.0,
       "mean distance of the contacts from their centroid", CalcRadius},
      {"dex-net", UnitForce::kNormal, TorqueScaleRule::kGiven, ReferenceRule::kGiven,
       EpsilonRule::kFromOrigin, false, 1.0, 8, 0.0,
       "as given; meant: median of the bounding box's upper corner", CalcMedianHalfSide},
      {"frogger", UnitForce::kTotal, TorqueScaleRule::kOneMetre, ReferenceRule::kFrameOrigin,
       EpsilonRule::kFromOrigin, false, 1.0, 4, -1.0, "not scaled", CalcRadius},
  };
  return *kConventions;
}

const QualityConvention& FindQualityConvention(const std::string& id) {
  const auto& all = ListQualityConventions();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const QualityConvention& row) { return row.id == id; });
  if (found != all.end()) return *found;
  std::vector<std::string> known;
  for (const QualityConvention& row : all) known.push_back(row.id);
  throw Error(ErrorKind::kNotFound,
              "no quality convention \"" + id + "\"" + SuggestNames(id, known));
}

double CalcMinSingularValue(const WrenchMatrix& grasp_matrix) {
  if (grasp_matrix.cols() < 6) return 0.0;
  // The values of R in G' = Q R are those of G. Eigen's SVD of a matrix of any size would do this
  // step itself, and takes six seconds to compile.
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(grasp_matrix.transpose());
  const Matrix6 R = qr.matrixR().topRows<6>().triangularView<Eigen::Upper>();
  const Eigen::Matrix<double, 6, 1> values =
      Eigen::JacobiSVD<Matrix6, Eigen::NoQRPreconditioner>(R).singularValues();
  return values[5] > kNegligibleShare * values[0] ? values[5] : 0.0;
}

double CalcTaskForce(const ConeWrenches& cones, const Eigen::Matrix<double, 6, 1>& direction,
                     ForceLimit limit) {
  GRASPBENCH_DEMAND(std::abs(direction.norm() - 1.0) < 1e-9,
                    "length: " + std::to_string(direction.norm()));
  if (cones.contact_indices.empty()) return 0.0;
  const Eigen::Index num_generators = cones.wrenches.cols();
  const int num_limits = limit == ForceLimit::kSum ? 1 : cones.contact_indices.back() + 1;
  // Variables: the weights, then s. Rows: W lambda - s d <= 0, the same >= 0, the limits, and a
  // bound on s that it cannot reach, so that rounding never looks like a way to infinity. Dividing
  // by the largest wrench makes all entries at most one, so |W lambda| <= sqrt(6) num_limits.
  const double scale = cones.wrenches.cwiseAbs().maxCoeff();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(13 + num_limits, num_generators + 1);
  A.topLeftCorner(6, num_generators) = cones.wrenches / scale;
  A.block<6, 1>(0, num_generators) = -direction;
  A.middleRows<6>(6) = -A.topRows<6>();
  for (Eigen::Index j = 0; j < num_generators; ++j) {
    A(12 + (limit == ForceLimit::kSum ? 0 : cones.contact_indices[j]), j) = 1.0;
  }
  A(12 + num_limits, num_generators) = 1.0;
  const double unreachable = 3.0 * num_limits;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(13 + num_limits);
  b.segment(12, num_limits).setOnes();
  b[12 + num_limits] = unreachable;
  const Eigen::VectorXd c = Eigen::VectorXd::Unit(num_generators + 1, num_generators);
  const LinearProgramResult result = SolveLinearProgram(A, b, c);
  // The program is bounded by its last row: what looks otherwise is rounding.
  if (result.end != LinearProgramEnd::kOptimum || result.value > 0.9 * unreachable) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return result.value * scale;
}

namespace {

WrenchSpace MakeWrenchSpace(const QualityRequest& request) {
  const QualityConvention& convention = request.convention;
  WrenchSpace space;
  space.num_edges = request.num_edges.value_or(convention.num_edges);
  space.unit_force = convention.unit_force;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const GraspContact& contact : request.contacts) {
    centroid += contact.p_OC / request.contacts.size();
  }
  switch (convention.reference) {
    case ReferenceRule::kGiven:
      space.p_OR = request.p_OR;
      break;
    case ReferenceRule::kContactCentroid:
      space.p_OR = centroid;
      break;
    case ReferenceRule::kFrameOrigin:
      space.p_OR.setZero();
      break;
  }
  switch (convention.torque_scale) {
    case TorqueScaleRule::kGiven:
      space.torque_scale = *request.torque_scale;
      break;
    case TorqueScaleRule::kMeanContactDistance:
      space.torque_scale = 0.0;
      for (const GraspContact& contact : request.contacts) {
        space.torque_scale += (contact.p_OC - centroid).norm() / request.contacts.size();
      }
      break;
    case TorqueScaleRule::kOneMetre:
      space.torque_scale = 1.0;
      break;
  }
  return space;
}

std::string Describe(const QualityConvention& convention, const WrenchSpace& space) {
  std::string text = convention.id + ": ";
  switch (convention.epsilon) {
    case EpsilonRule::kFromOrigin:
      text += "epsilon = distance of the origin from the hull";
      break;
    case EpsilonRule::kFromHullCentre:
      text += "epsilon = distance of the mean of the hull's vertices from the hull";
      break;
    case EpsilonRule::kTwoMinus:
      text += "epsilon = 2 - distance of the origin from the hull (smaller is better)";
      break;
  }
  if (convention.without_closure) {
    text += ", " + FormatSignificant(*convention.without_closure, 6) + " without force closure";
  }
  text += "; hull of the union of all cone edges (L1)";
  text += convention.includes_origin ? " and the origin, " : ", ";
  text += space.unit_force == UnitForce::kNormal ? "unit normal force" : "unit total force";
  text += "; " + std::to_string(space.num_edges) + " edges; friction and torsion x " +
          FormatSignificant(convention.friction_factor, 6) + "; moments about (" +
          FormatSignificant(space.p_OR.x(), 6) + ", " + FormatSignificant(space.p_OR.y(), 6) +
          ", " + FormatSignificant(space.p_OR.z(), 6) + ") m, divided by " +
          FormatSignificant(space.torque_scale, 6) + " m (" + convention.torque_scale_meaning + ")";
  return text;
}

double CalcReportedEpsilon(const WrenchHull& hull, bool force_closure,
                           const QualityConvention& convention) {
  if (!force_closure && convention.without_closure) return *convention.without_closure;
  switch (convention.epsilon) {
    case EpsilonRule::kFromOrigin:
      return CalcEpsilon(hull);
    case EpsilonRule::kTwoMinus:
      return 2.0 - CalcEpsilon(hull);
    case EpsilonRule::kFromHullCentre:
      break;
  }
  return hull.is_flat ? 0.0 : (hull.offsets - hull.normals.transpose() * hull.centre).minCoeff();
}

std::vector<TaskForce> CalcTaskForces(const ConeWrenches& cones, double torque_scale) {
  static const char* const kNames[] = {"force", "moment"};
  static const char kAxes[] = "xyz";
  std::vector<TaskForce> forces;
  for (int axis = 0; axis < 6; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Eigen::Matrix<double, 6, 1> direction = sign * Eigen::Matrix<double, 6, 1>::Unit(axis);
      const double unit = axis < 3 ? 1.0 : torque_scale;
      forces.push_back(
          {std::string(kNames[axis / 3]) + (sign > 0.0 ? " +" : " -") + kAxes[axis % 3],
           unit * CalcTaskForce(cones, direction, ForceLimit::kSum),
           unit * CalcTaskForce(cones, direction, ForceLimit::kEach)});
    }
  }
  return forces;
}

}  // namespace

std::vector<std::string> ListProblems(const QualityRequest& request) {
  std::vector<std::string> problems;
  const auto expect = [&](bool condition, const std::string& problem) {
    if (!condition) problems.push_back(problem);
  };
  const size_t num_contacts = request.contacts.size();
  expect(num_contacts >= 2 && num_contacts <= 64,
         "contacts: found " + std::to_string(num_contacts) + ", expected 2 to 64");
  for (size_t i = 0; i < num_contacts; ++i) {
    const std::string problem = FindProblem(request.contacts[i]);
    expect(problem.empty(), "contacts[" + std::to_string(i) + "]: " + problem);
  }
  const int num_edges = request.num_edges.value_or(request.convention.num_edges);
  expect(num_edges >= 3 && num_edges <= 64,
         "edges: found " + std::to_string(num_edges) + ", expected 3 to 64");
  expect(num_contacts * std::max(num_edges, 0) <= 640,
         "contacts and edges: found " + std::to_string(num_contacts) + " x " +
             std::to_string(num_edges) +
             " cone edges, expected at most 640; their exact hull would take minutes");
  expect(IsPosition(request.p_OR), "reference_m: expected three numbers within 100 m");
  if (request.torque_scale) {
    expect(*request.torque_scale >= 1e-6 && *request.torque_scale <= 1e6,
           "torque_scale_m: found " + FormatSignificant(*request.torque_scale, 6) +
               ", expected a length from 1e-6 to 1e6 m");
  } else {
    expect(request.convention.torque_scale != TorqueScaleRule::kGiven,
           "torque_scale_m: missing; the convention " + request.convention.id +
               " needs a length to divide moments by (" + request.convention.torque_scale_meaning +
               ")");
  }
  if (problems.empty()) {
    const double scale = MakeWrenchSpace(request).torque_scale;
    expect(scale >= 1e-6, "contacts: all lie in one point; the convention " +
                              request.convention.id + " divides moments by their mean distance");
  }
  return problems;
}

GraspQuality CalcGraspQuality(const QualityRequest& request) {
  const QualityConvention& convention = request.convention;
  std::vector<GraspContact> contacts = request.contacts;
  for (GraspContact& contact : contacts) {
    contact.nhat_O.normalize();
    contact.mu *= convention.friction_factor;
    contact.torsion *= convention.friction_factor;
  }
  GraspQuality quality;
  quality.convention = convention.id;
  quality.space = MakeWrenchSpace(request);
  quality.description = Describe(convention, quality.space);
  const ConeWrenches cones = CalcConeWrenches(contacts, quality.space);
  Eigen::MatrixXd points = cones.wrenches;
  if (convention.includes_origin) {
    points.conservativeResize(Eigen::NoChange, points.cols() + 1);
    points.rightCols<1>().setZero();
  }
  const WrenchHull hull = CalcWrenchHull(points);
  quality.volume = hull.volume;
  quality.force_closure = CalcEpsilon(hull) > 0.0;
  quality.epsilon = CalcReportedEpsilon(hull, quality.force_closure, convention);
  if (quality.force_closure) {
    Eigen::Index nearest = 0;
    hull.offsets.minCoeff(&nearest);
    quality.weakest_wrench = hull.normals.col(nearest);
  }
  quality.min_singular_value = CalcMinSingularValue(CalcGraspMatrix(contacts, quality.space));
  quality.task_forces = CalcTaskForces(cones, quality.space.torque_scale);
  return quality;
}

Json ToJson(const GraspQuality& quality) {
  Json task_forces = Json::array();
  for (const TaskForce& force : quality.task_forces) {
    task_forces.push_back({{"direction", force.direction},
                           {"unit", force.direction[0] == 'f' ? "N/N" : "N m/N"},
                           {"sum_of_normal_forces_limited", JsonNumber(force.sum_limited)},
                           {"each_normal_force_limited", JsonNumber(force.each_limited)}});
  }
  Json weakest = nullptr;
  if (quality.weakest_wrench) {
    weakest = Json::array();
    for (const double value : *quality.weakest_wrench) weakest.push_back(JsonNumber(value));
  }
  return {{"convention", quality.convention},
          {"description", quality.description},
          {"edges", quality.space.num_edges},
          {"torque_scale_m", JsonNumber(quality.space.torque_scale)},
          {"reference_m", JsonVector(quality.space.p_OR)},
          {"epsilon", JsonNumber(quality.epsilon)},
          {"volume", JsonNumber(quality.volume)},
          {"force_closure", quality.force_closure},
          {"min_singular_value", JsonNumber(quality.min_singular_value)},
          {"weakest_wrench", weakest},
          {"task_forces", task_forces}};
}

}  // namespace graspbench
