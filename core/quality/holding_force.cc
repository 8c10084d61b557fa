#include "core/quality/holding_force.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <deque>
#include <numeric>

#include "core/base/error.h"
#include "core/quality/linear_program.h"

namespace graspbench {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kMomentShare = 0.03;
/** What carrying the whole weight is worth to a program, in its unit of force: more than any pull
can gain by carrying less, and more than any force costs. A grasp that would need more cannot bear
it for any practical purpose. */
constexpr double kWeightValue = 1e3;
/** Of all normal force beside F, so that free digits press no harder than they must. */
constexpr double kFreeCost = 1e-3;
/** Of a moment that is left over, over the radius: what contacts balance for less, they do. */
constexpr double kMomentCost = 20.0;
constexpr double kCarried = 1.0 - 1e-6;
/** From the optimum at which the search ends, relative. That of a grip is smaller, because where
balance and the price of a moment weigh the same F changes faster than the optimum. */
constexpr double kPullGap = 3e-4, kGripGap = 1e-5;
constexpr double kLeastForce =
    1e-2;  // in the program's unit, to which the gap is relative at least
constexpr int kMostRounds = 50;

/** A cone {W u : u_0 >= |(u_1, u_2, u_3)|}, spanned by its generators W (1, e) with |e| = 1. Of a
contact u_0 is the normal force, (u_1, u_2) friction over mu, u_3 the moment about the normal over
the torsion. Of the tolerance u_0 is the length of the moment that is left over. */
struct WrenchCone {
  Eigen::Matrix<double, 6, 4> W = Eigen::Matrix<double, 6, 4>::Zero();
  Index digit_row = -1;    // in which its digit's force counts
  double tolerated = 0.0;  // its entry in the tolerance's row
  double cost = 0.0;
};

/** The cones of a grasp, that of the tolerance first, and the rows of its digits. */
struct GraspCones {
  /** @param is_free  of a contact: its digit has no row. */
  GraspCones(const LoadedGrasp& grasp, const std::vector<bool>& is_free);
  Index num_rows() const;
  Index FindRow(int digit) const;

  std::vector<int> digits;  // ascending
  std::vector<WrenchCone> cones;
};

/** One program, over the generators that it has so far. Rows: balance of forces and moments (6,
both ways), the tolerance, the carried share of the weight, digits. Variables: that share, the force
that is looked for, weights of the generators. */
class BalanceProgram {
 public:
  static constexpr Index kTolerance = 12, kShare = 13, kDigits = 14;

  /** @param weight  in the program's unit. @param b  of the rows. @param force  column of the force
  that is looked for. @param gain  what a unit of it is worth. @param gap  from the optimum. */
  BalanceProgram(const GraspCones& grasp, const Vector3d& weight, const VectorXd& b,
                 const VectorXd& force, double gain, double gap);

  /** Adds the generators that gain most by the prices of the last solution, and solves again. */
  void Improve();
  /** No generator gains more than the gap, or rounding allows no better solution. */
  bool is_closed() const { return is_closed_; }
  double value() const { return result_.value; }
  double share() const { return result_.x[0]; }
  double force() const { return result_.x[1]; }

 private:
  void Add(const WrenchCone& cone, const Vector3d& e);

  const std::vector<WrenchCone>& cones_;
  LinearProgram program_;
  double gap_;
  Index num_rows_;
  LinearProgramResult result_;
  int num_rounds_ = 0;
  bool is_closed_ = false;
};

GraspCones::GraspCones(const LoadedGrasp& grasp, const std::vector<bool>& is_free) : cones(1) {
  for (size_t i = 0; i < grasp.contacts.size(); ++i) {
    if (!is_free[i]) digits.push_back(grasp.digits[i]);
  }
  std::sort(digits.begin(), digits.end());
  digits.erase(std::unique(digits.begin(), digits.end()), digits.end());
  cones[0].W.bottomRightCorner<3, 3>().setIdentity();
  cones[0].tolerated = 1.0;
  for (size_t i = 0; i < grasp.contacts.size(); ++i) {
    const GraspContact& contact = grasp.contacts[i];
    const Vector3d& n = contact.nhat_O;
    // The first generators lie along the weight and across it: a pinch needs no others.
    const Vector3d across = n.cross(grasp.weight);
    const bool is_along = across.norm() <= 1e-3 * grasp.weight.norm();
    const Vector3d t = is_along ? n.unitOrthogonal() : across.normalized();
    WrenchCone& cone = cones.emplace_back();
    cone.W.topLeftCorner<3, 3>() << n, contact.mu * t, contact.mu * n.cross(t);
    for (Index j = 0; j < 3; ++j) {
      const Vector3d force = cone.W.block<3, 1>(0, j);
      cone.W.block<3, 1>(3, j) = contact.p_OC.cross(force) / grasp.radius;
    }
    cone.W.block<3, 1>(3, 3) = contact.torsion / grasp.radius * n;
    if (!is_free[i]) cone.digit_row = FindRow(grasp.digits[i]);
  }
}

Index GraspCones::num_rows() const {
  return BalanceProgram::kDigits + static_cast<Index>(digits.size());
}

Index GraspCones::FindRow(int digit) const {
  return BalanceProgram::kDigits +
         (std::lower_bound(digits.begin(), digits.end(), digit) - digits.begin());
}

BalanceProgram::BalanceProgram(const GraspCones& grasp, const Vector3d& weight, const VectorXd& b,
                               const VectorXd& force, double gain, double gap)
    : cones_(grasp.cones), program_(b), gap_(gap), num_rows_(b.size()) {
  VectorXd share = VectorXd::Zero(num_rows_);
  share.head<3>() = weight;
  share.segment<3>(6) = -weight;
  share[kShare] = 1.0;
  program_.AddVariable(share, kWeightValue);
  program_.AddVariable(force, gain);
  for (const WrenchCone& cone : cones_) {
    if (cone.W.rightCols<3>().isZero(0.0)) Add(cone, Vector3d::Zero());
    for (Index axis = 0; axis < 3; ++axis) {
      if (cone.W.col(axis + 1).isZero(0.0)) continue;
      for (const double sign : {1.0, -1.0}) Add(cone, sign * Vector3d::Unit(axis));
    }
  }
  result_ = program_.Solve();
  if (result_.end == LinearProgramEnd::kOptimum) return;
  throw Error(
      ErrorKind::kRange,
      fmt::format("the balance of {} contacts is lost to rounding: their places, normals or "
                  "friction are too far apart",
                  cones_.size() - 1));
}

void BalanceProgram::Add(const WrenchCone& cone, const Vector3d& e) {
  VectorXd column = VectorXd::Zero(num_rows_);
  column.head<6>() = cone.W.col(0) + cone.W.rightCols<3>() * e;
  column.segment<6>(6) = -column.head<6>();
  column[kTolerance] = cone.tolerated;
  if (cone.digit_row >= 0) column[cone.digit_row] = 1.0;
  program_.AddVariable(column, -cone.cost);
}

void BalanceProgram::Improve() {
  // With the prices l of balance W (1, e) is worth v_0 + (v_1, v_2, v_3).e, v = W'l: most along v.
  const VectorXd& prices = result_.prices;
  const Eigen::Matrix<double, 6, 1> l = prices.segment<6>(6) - prices.head<6>();
  const double total = std::max(1.0, result_.x.tail(result_.x.size() - 2).sum());
  const double enough = gap_ * std::max(kLeastForce, std::abs(force())) / total;
  double most = 0.0;
  bool has_added = false;
  for (const WrenchCone& cone : cones_) {
    const Eigen::Vector4d v = cone.W.transpose() * l;
    const double length = v.tail<3>().norm();
    double gain = v[0] + length - cone.cost - cone.tolerated * prices[kTolerance];
    if (cone.digit_row >= 0) gain -= prices[cone.digit_row];
    most = std::max(most, gain);
    if (!(gain > enough) || length == 0.0) continue;
    Add(cone, v.tail<3>() / length);
    has_added = true;
  }
  // Nor where forces of a thousand weights could not carry what is missing.
  const bool is_lost = most < 1.0 - share();
  is_closed_ = !has_added || is_lost || ++num_rounds_ == kMostRounds;
  if (is_closed_) return;
  const LinearProgramResult next = program_.Solve();
  is_closed_ = next.end != LinearProgramEnd::kOptimum;  // rounding: the last solution stands
  if (!is_closed_) result_ = next;
}

/** What measured contacts hold against pulls, in units of the sum of their normal forces. */
class Pulls {
 public:
  Pulls(const LoadedGrasp& grasp, const std::vector<Vector3d>& directions)
      : cones_(grasp, std::vector<bool>(grasp.contacts.size(), false)),
        unit_(std::accumulate(grasp.normal_forces.begin(), grasp.normal_forces.end(), 0.0)) {
    VectorXd b = VectorXd::Zero(cones_.num_rows()), pull = b;
    b[BalanceProgram::kShare] = 1.0;
    b[BalanceProgram::kTolerance] = kMomentShare;
    for (size_t i = 0; i < grasp.contacts.size(); ++i) {
      b[cones_.FindRow(grasp.digits[i])] += grasp.normal_forces[i] / unit_;
    }
    for (const Vector3d& direction : directions) {
      pull.head<3>() = direction;
      pull.segment<3>(6) = -direction;
      programs_.emplace_back(cones_, grasp.weight / unit_, b, pull, 1.0, kPullGap);
    }
  }
  std::deque<BalanceProgram>& programs() { return programs_; }
  /** Continuous in all that goes in, also where the weight can just no longer be carried. */
  double CalcForce(const BalanceProgram& program) const {
    return unit_ * std::max(0.0, program.value() - kWeightValue);
  }

 private:
  GraspCones cones_;  // the programs refer to it
  double unit_;
  std::deque<BalanceProgram> programs_;
};

bool IsPressed(const LoadedGrasp& grasp) {
  return std::any_of(grasp.normal_forces.begin(), grasp.normal_forces.end(),
                     [](double force) { return force > 0.0; });
}

}  // namespace

std::vector<double> CalcHoldingForces(const LoadedGrasp& grasp,
                                      const std::vector<Vector3d>& directions) {
  std::vector<double> holding(directions.size(), 0.0);
  if (!IsPressed(grasp)) return holding;
  Pulls pulls(grasp, directions);
  for (size_t k = 0; k < directions.size(); ++k) {
    BalanceProgram& program = pulls.programs()[k];
    while (!program.is_closed()) program.Improve();
    holding[k] = pulls.CalcForce(program);
  }
  return holding;
}

double CalcWeakestHoldingForce(const LoadedGrasp& grasp, const std::vector<Vector3d>& directions) {
  if (!IsPressed(grasp)) return 0.0;
  Pulls pulls(grasp, directions);
  auto& programs = pulls.programs();
  // Values only rise: the lowest, once closed, is the least of all.
  while (true) {
    const auto lowest = std::min_element(
        programs.begin(), programs.end(),
        [](const BalanceProgram& a, const BalanceProgram& b) { return a.value() < b.value(); });
    if (lowest->is_closed()) return pulls.CalcForce(*lowest);
    lowest->Improve();
  }
}

std::optional<double> CalcSmallestGrip(const LoadedGrasp& grasp, const std::vector<bool>& is_free) {
  const double weight = grasp.weight.norm();
  if (weight == 0.0) return 0.0;
  if (grasp.contacts.empty()) return std::nullopt;
  GraspCones cones(grasp, is_free);
  cones.cones[0].cost = kMomentCost;
  for (size_t i = 1; i < cones.cones.size(); ++i) {
    cones.cones[i].tolerated = -kMomentShare;
    cones.cones[i].cost = kFreeCost;
  }
  VectorXd b = VectorXd::Zero(cones.num_rows()), grip = b;
  b[BalanceProgram::kShare] = 1.0;
  grip.tail(cones.num_rows() - BalanceProgram::kDigits).setConstant(-1.0);
  BalanceProgram program(cones, grasp.weight / weight, b, grip, -1.0, kGripGap);
  while (!program.is_closed()) program.Improve();
  if (program.share() < kCarried) return std::nullopt;
  return weight * program.force();
}

}  // namespace graspbench
