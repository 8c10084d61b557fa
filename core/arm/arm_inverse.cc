#include "core/arm/arm_inverse.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kSameLength = 1e-12;  // [m]
constexpr double kSamePosture = 1e-6;  // [rad]
constexpr int kMostIterations = 200;
/** Beyond its range an angle's cosine still counts as at its end: rounding, no distance. */
constexpr double kCosineSlack = 1e-12;

Matrix3d RotateX(double angle) {
  return Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix();
}
Matrix3d RotateZ(double angle) {
  return Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
}

/** What follows the joint's rotation: Shift(z, d) Shift(x, a) Rot(x, alpha). */
Pose MakeLink(const ArmJoint& joint) {
  return MakePose(RotateX(joint.alpha), Vector3d(joint.a, 0.0, joint.d));
}

/** Angles with a cos(angle) + b sin(angle) = c. @param over  grows to how far |c| is too large. */
std::vector<double> SolveCosine(double a, double b, double c, double& over) {
  const double size = std::hypot(a, b);
  if (size < 1e-15) return {0.0};
  const double cosine = c / size;
  if (std::abs(cosine) > 1.0 + kCosineSlack) {
    over = std::abs(c) - size;
    return {};
  }
  const double middle = std::atan2(b, a), half = std::acos(std::clamp(cosine, -1.0, 1.0));
  return {middle + half, middle - half};
}

/** The representative nearest to the middle of the joint's range. */
double Centre(const ArmJoint& joint, double angle) {
  const double middle = 0.5 * (joint.lower + joint.upper);
  return middle + std::remainder(angle - middle, 2.0 * kPi);
}

Vector6d CalcMiss(const Pose& X_BF, const Pose& X_BT) {
  Vector6d miss;
  miss.head<3>() = X_BT.translation() - X_BF.translation();
  const Eigen::AngleAxisd turn(X_BT.linear() * X_BF.linear().transpose());
  miss.tail<3>() = turn.angle() * turn.axis();
  return miss;
}

bool IsMet(const Vector6d& miss) {
  return miss.head<3>().norm() < kPoseTolerance && miss.tail<3>().norm() < kPoseTolerance;
}

/** The closed form of one arm and pose. */
class WristSolver {
 public:
  /** @param elbow  index of the joint behind the shoulder's that the distance of P gives. */
  WristSolver(const Arm& arm, const Pose& X_BF, size_t elbow)
      : arm_(arm), X_BF_(X_BF), elbow_(elbow) {}

  void Solve(double free_angle, ArmPostures& found) const {
    const auto& joints = arm_.joints;
    const size_t last = joints.size() - 1;
    const Vector3d p_BP = X_BF_ * (MakeLink(joints[last]).inverse() * Vector3d::Zero());
    const Vector3d p_SP = p_BP - Vector3d(0.0, 0.0, joints[0].d);
    // P in the frame of the elbow's link, and what stands between joint 2 and the elbow's.
    const Vector3d p_EP = MakeLink(joints[elbow_]) * Vector3d(0.0, 0.0, joints[elbow_ + 1].d);
    Pose X_1E = MakeLink(joints[1]);
    if (elbow_ == 3) {
      X_1E = X_1E * MakePose(RotateZ(free_angle + joints[2].offset), Vector3d::Zero()) *
             MakeLink(joints[2]);
    }
    const Vector3d v = X_1E.linear().transpose() * X_1E.translation();
    const double a = v.x() * p_EP.x() + v.y() * p_EP.y();
    const double b = v.y() * p_EP.x() - v.x() * p_EP.y();
    const double c =
        0.5 * (p_SP.squaredNorm() - v.squaredNorm() - p_EP.squaredNorm()) - v.z() * p_EP.z();
    double over = 0.0;
    const std::vector<double> elbows = SolveCosine(a, b, c, over);
    if (elbows.empty()) {
      const double nearest = p_SP.squaredNorm() + (c > 0.0 ? -2.0 : 2.0) * over;
      const double shortfall = std::abs(p_SP.norm() - std::sqrt(std::max(0.0, nearest)));
      Note(elbow_, shortfall, found);
    }
    for (const double elbow : elbows) {
      const Vector3d p_1P = X_1E * (RotateZ(elbow) * p_EP);
      const double ca = std::cos(joints[0].alpha), sa = std::sin(joints[0].alpha);
      double height_over = 0.0;
      const std::vector<double> shoulders =
          SolveCosine(sa * p_1P.y(), sa * p_1P.x(), p_SP.z() - ca * p_1P.z(), height_over);
      if (shoulders.empty()) Note(0, height_over, found);
      for (const double shoulder : shoulders) {
        const Vector3d p_0P = RotateX(joints[0].alpha) * (RotateZ(shoulder) * p_1P);
        const double waist = p_0P.head<2>().norm() < kSameLength
                                 ? 0.0
                                 : std::atan2(p_SP.y(), p_SP.x()) - std::atan2(p_0P.y(), p_0P.x());
        VectorXd q(arm_.num_joints());
        q[0] = waist - joints[0].offset;
        q[1] = shoulder - joints[1].offset;
        if (elbow_ == 3) q[2] = free_angle;
        q[static_cast<Eigen::Index>(elbow_)] = elbow - joints[elbow_].offset;
        SolveWrist(q, found);
      }
    }
  }

 private:
  static void Note(size_t joint, double shortfall, ArmPostures& found) {
    if (found.fault.joint >= 0 && found.fault.shortfall <= shortfall) return;
    found.fault = {static_cast<int>(joint), shortfall};
  }

  void SolveWrist(VectorXd q, ArmPostures& found) const {
    const auto& joints = arm_.joints;
    Matrix3d R_BE = Matrix3d::Identity();
    for (size_t i = 0; i <= elbow_; ++i) {
      R_BE = R_BE * RotateZ(q[static_cast<Eigen::Index>(i)] + joints[i].offset) *
             RotateX(joints[i].alpha);
    }
    const size_t first = elbow_ + 1;
    const Matrix3d R = R_BE.transpose() * X_BF_.linear() * RotateX(-joints[first + 2].alpha);
    const double ca = std::cos(joints[first].alpha), sa = std::sin(joints[first].alpha);
    const double cb = std::cos(joints[first + 1].alpha), sb = std::sin(joints[first + 1].alpha);
    double over = 0.0;
    for (const double bend : SolveCosine(sa * sb, 0.0, ca * cb - R(2, 2), over)) {
      const Matrix3d R_bend =
          RotateX(joints[first].alpha) * RotateZ(bend) * RotateX(joints[first + 1].alpha);
      const Eigen::Vector2d from = R_bend.col(2).head<2>(), to = R.col(2).head<2>();
      const double roll =
          from.norm() < 1e-9 ? 0.0 : std::atan2(to.y(), to.x()) - std::atan2(from.y(), from.x());
      const Matrix3d rest = (RotateZ(roll) * R_bend).transpose() * R;
      const auto k = static_cast<Eigen::Index>(first);
      q[k] = roll - joints[first].offset;
      q[k + 1] = bend - joints[first + 1].offset;
      q[k + 2] = std::atan2(rest(1, 0), rest(0, 0)) - joints[first + 2].offset;
      for (int i = 0; i < arm_.num_joints(); ++i) {
        q[i] = Centre(joints[static_cast<size_t>(i)], q[i]);
      }
      found.postures.push_back(q);
    }
  }

  const Arm& arm_;
  const Pose& X_BF_;
  size_t elbow_;
};

/** Free angles that are tried, and those tried where none of them gives a posture. */
constexpr int kFewFree = 24, kManyFree = 360;

ArmReach SelectReaching(const Arm& arm, const Pose& X_BF, const ArmPostures& found) {
  struct Ranked {
    double margin;
    VectorXd q;
  };
  ArmReach reach;
  reach.fault = found.fault;
  std::vector<Ranked> ranked;
  for (const VectorXd& q : found.postures) {
    const LimitMargin margin = FindLimitMargin(arm, q);
    if (reach.closest.joint < 0 || margin.margin > reach.closest.margin) reach.closest = margin;
    if (margin.margin >= 0.0) ranked.push_back({margin.margin, q});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Ranked& a, const Ranked& b) { return a.margin > b.margin; });
  for (const Ranked& one : ranked) {
    const std::optional<VectorXd> exact = RefinePosture(arm, X_BF, one.q);
    if (exact && FindLimitMargin(arm, *exact).margin >= 0.0) reach.postures.push_back(*exact);
  }
  return reach;
}

bool IsNew(const VectorXd& q, const std::vector<VectorXd>& known) {
  return std::none_of(known.begin(), known.end(), [&](const VectorXd& other) {
    return (q - other).cwiseAbs().maxCoeff() < kSamePosture;
  });
}

/** From random postures. */
void SolveNumerically(const Arm& arm, const Pose& X_BF, ArmPostures& found) {
  RandomStream random(arm.content_hash, "starts of inverse kinematics");
  found.fault.shortfall = std::numeric_limits<double>::infinity();
  for (int start = 0; start < kNumStarts; ++start) {
    VectorXd q(arm.num_joints());
    for (int i = 0; i < arm.num_joints(); ++i) {
      const ArmJoint& joint = arm.joints[static_cast<size_t>(i)];
      q[i] = random.NextUniform(joint.lower, joint.upper);
    }
    found.postures.push_back(q);
  }
  std::vector<VectorXd> exact;
  for (const VectorXd& q : found.postures) {
    std::optional<VectorXd> refined = RefinePosture(arm, X_BF, q);
    if (!refined) continue;
    for (int i = 0; i < arm.num_joints(); ++i) {
      (*refined)[i] = Centre(arm.joints[static_cast<size_t>(i)], (*refined)[i]);
    }
    if (IsNew(*refined, exact)) exact.push_back(*refined);
  }
  found.postures = std::move(exact);
  found.fault.shortfall =
      std::max(0.0, X_BF.translation().norm() - CalcArmReach(arm) - arm.joints.front().d);
}

}  // namespace

ArmForm FindArmForm(const Arm& arm) {
  const size_t n = arm.joints.size();
  if (n < 6 || n > 7) return ArmForm::kOther;
  const auto& j = arm.joints;
  const auto is_zero = [](double value) { return std::abs(value) < kSameLength; };
  const bool has_wrist = is_zero(j[n - 3].a) && is_zero(j[n - 2].a) && is_zero(j[n - 2].d);
  const auto is_turned = [&](size_t i) { return std::abs(std::sin(j[i].alpha)) > 1e-6; };
  const bool are_turned = is_turned(0) && is_turned(n - 3) && is_turned(n - 2);
  if (!has_wrist || !is_zero(j[0].a) || !are_turned) return ArmForm::kOther;
  return n == 6 ? ArmForm::kSixJoints : ArmForm::kFree;
}

ArmPostures FindArmPostures(const Arm& arm, const Pose& X_BF, int num_free,
                            std::optional<double> free_angle) {
  ArmPostures found;
  const ArmForm form = FindArmForm(arm);
  if (form == ArmForm::kOther) {
    SolveNumerically(arm, X_BF, found);
    return found;
  }
  if (form == ArmForm::kSixJoints) {
    WristSolver(arm, X_BF, 2).Solve(0.0, found);
  } else if (free_angle) {
    WristSolver(arm, X_BF, 3).Solve(*free_angle, found);
  } else {
    GRASPBENCH_DEMAND(num_free >= 1, arm.id);
    const ArmJoint& free = arm.joints[2];
    for (int i = 0; i < num_free; ++i) {
      const double share = (i + 0.5) / num_free;
      WristSolver(arm, X_BF, 3).Solve(free.lower + share * (free.upper - free.lower), found);
    }
  }
  return found;
}

std::optional<VectorXd> RefinePosture(const Arm& arm, const Pose& X_BF, VectorXd q) {
  double damping = 1e-6;
  std::vector<Pose> X_BL = CalcArmPoses(arm, q);
  Vector6d miss = CalcMiss(X_BL.back(), X_BF);
  for (int i = 0; i < kMostIterations; ++i) {
    if (IsMet(miss)) return q;
    const Eigen::MatrixXd jacobian = CalcArmJacobian(X_BL);
    const Matrix6d gram = jacobian * jacobian.transpose() + damping * Matrix6d::Identity();
    const VectorXd moved = q + jacobian.transpose() * gram.ldlt().solve(miss);
    const std::vector<Pose> X_BM = CalcArmPoses(arm, moved);
    const Vector6d next = CalcMiss(X_BM.back(), X_BF);
    if (next.norm() < miss.norm()) {
      q = moved;
      X_BL = X_BM;
      miss = next;
      damping = std::max(1e-14, 0.1 * damping);
    } else {
      damping *= 10.0;
      if (damping > 1e3) break;
    }
  }
  if (IsMet(miss)) return q;
  return std::nullopt;
}

LimitMargin FindLimitMargin(const Arm& arm, const VectorXd& q) {
  LimitMargin least = {-1, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < arm.num_joints(); ++i) {
    const ArmJoint& joint = arm.joints[static_cast<size_t>(i)];
    const double margin = std::min(q[i] - joint.lower, joint.upper - q[i]);
    if (margin < least.margin) least = {i, margin};
  }
  return least;
}

ArmReach FindArmReach(const Arm& arm, const Pose& X_BF) {
  ArmReach reach = SelectReaching(arm, X_BF, FindArmPostures(arm, X_BF, kFewFree));
  if (reach.postures.empty() && FindArmForm(arm) == ArmForm::kFree) {
    reach = SelectReaching(arm, X_BF, FindArmPostures(arm, X_BF, kManyFree));
  }
  return reach;
}

}  // namespace graspbench
