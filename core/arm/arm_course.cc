#include "core/arm/arm_course.h"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/arm/arm_inverse.h"
#include "core/base/minimum_jerk.h"
#include "core/base/units.h"
#include "core/hand/closing.h"
#include "core/hand/contact_shape.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kNumKnots = 21;  // of a line, evenly in time
constexpr int kNumReachKnots = 21;
/** A joint that is too fast is so because of a singular posture below this dexterity. Proposed. */
constexpr double kLowDexterity = 0.1;
/** Of minimum-jerk motion: largest over mean speed. */
constexpr double kPeakSpeed = 15.0 / 8.0;

std::string NameLink(int link) { return link == 0 ? "the base" : fmt::format("link {}", link); }

std::string NameJoint(const Arm& arm, int joint) {
  return fmt::format("joint {} ({})", joint + 1, arm.joints[static_cast<size_t>(joint)].name);
}

/** In W; a ball where a is b. */
struct PlacedCapsule {
  Vector3d a, b;
  double radius;
  int link;
};

/** @param X_BL  of CalcArmPoses. */
std::vector<PlacedCapsule> PlaceCapsules(const MountedArm& mounted, const std::vector<Pose>& X_BL) {
  std::vector<PlacedCapsule> placed;
  for (const ArmCapsule& capsule : mounted.arm->capsules) {
    const Pose X_WL = mounted.X_WB * X_BL[static_cast<size_t>(capsule.link)];
    placed.push_back({X_WL * capsule.p_LA, X_WL * capsule.p_LB, capsule.radius, capsule.link});
  }
  return placed;
}

bool DoMeet(const PlacedCapsule& a, const PlacedCapsule& b) {
  const ClosestPoints nearest = FindClosestPoints(a.a, a.b, b.a, b.b);
  return (nearest.on_a - nearest.on_b).norm() < a.radius + b.radius;
}

/** What the arm's capsules touch; empty: nothing. @param object  at X_WO; null: none. */
std::string FindCollision(const MountedArm& mounted, const VectorXd& q, const GraspObject* object,
                          const Pose& X_WO) {
  const std::vector<PlacedCapsule> capsules = PlaceCapsules(mounted, CalcArmPoses(*mounted.arm, q));
  const Pose X_OW = X_WO.inverse();
  for (size_t i = 0; i < capsules.size(); ++i) {
    const PlacedCapsule& capsule = capsules[i];
    if (capsule.link > 0 && std::min(capsule.a.z(), capsule.b.z()) < capsule.radius) {
      return NameLink(capsule.link) + " would meet the table";
    }
    // Balls a radius apart stand for the capsule.
    const int num = 1 + static_cast<int>((capsule.b - capsule.a).norm() / capsule.radius);
    for (int k = 0; object != nullptr && k <= num; ++k) {
      const Vector3d p_W = capsule.a + static_cast<double>(k) / num * (capsule.b - capsule.a);
      if (object->field->Query(X_OW * p_W).distance < capsule.radius) {
        return NameLink(capsule.link) + " would meet the object";
      }
    }
    for (size_t k = 0; k < i; ++k) {
      if (std::abs(capsules[k].link - capsule.link) > 1 && DoMeet(capsule, capsules[k])) {
        return NameLink(capsules[k].link) + " would meet " + NameLink(capsule.link);
      }
    }
  }
  return "";
}

/** What the hand's contact surface touches, the arm's last two links apart; empty: nothing.
@param object  at X_WO; null: none. */
std::string FindHandCollision(const MountedArm& mounted, const VectorXd& q, const Hand& hand,
                              const VectorXd& q_hand, const GraspObject* object, const Pose& X_WO) {
  const std::vector<Pose> X_BL = CalcArmPoses(*mounted.arm, q);
  const std::vector<PlacedCapsule> capsules = PlaceCapsules(mounted, X_BL);
  const Pose X_WH = mounted.X_WB * X_BL.back() * mounted.X_FH;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q_hand);
  const Pose X_OW = X_WO.inverse();
  for (const ContactSphere& ball : hand.contact_spheres) {
    const Vector3d p_W = X_WH * (X_HL[static_cast<size_t>(ball.link)] * ball.p_LS);
    if (p_W.z() < ball.radius) return "the hand would meet the table";
    if (object != nullptr && object->field->Query(X_OW * p_W).distance < ball.radius) {
      return "the hand would meet the object";
    }
    for (const PlacedCapsule& capsule : capsules) {
      if (capsule.link <= mounted.arm->num_joints() - 2 &&
          DoMeet(capsule, {p_W, p_W, ball.radius, ball.link})) {
        return "the hand would meet " + NameLink(capsule.link);
      }
    }
  }
  return "";
}

/** How far one posture came. */
struct Attempt {
  int stage = 0;  ///< of the checks, in their order
  ArmFault fault = ArmFault::kOutOfReach;
  std::string reason;
  int joint = -1;
  double margin = kUnset;
};

/** Follows one posture through the whole course. */
class CourseTracker {
 public:
  CourseTracker(const MountedArm& mounted, const ArmTask& task)
      : mounted_(mounted), arm_(*mounted.arm), task_(task) {}

  /** Whether the course that starts with this posture at the grasp pose is free. */
  bool Follow(const VectorXd& q_grasp, ArmCourse& course, Attempt& attempt) {
    least_ = FindLimitMargin(arm_, q_grasp);
    dexterity_ = std::numeric_limits<double>::infinity();
    speed_share_ = 0.0;
    const std::string touched = FindArmCollision(mounted_, q_grasp, *task_.object, task_.X_WO);
    if (!touched.empty()) {
      attempt = {1, ArmFault::kOutOfReach, "at the grasp " + touched, -1, kUnset};
      return false;
    }
    // The approach is followed from its end.
    std::vector<VectorXd> lift = {q_grasp}, approach = {q_grasp};
    if (!FollowLine(task_.lift, false, lift, attempt)) return Fail(2, "lift", attempt);
    if (!FollowLine(task_.approach, true, approach, attempt)) return Fail(3, "approach", attempt);
    std::reverse(approach.begin(), approach.end());
    if (!Reach(approach.front(), course.record, attempt)) return false;
    course.approach = std::move(approach);
    course.lift = std::move(lift);
    course.record.joint = arm_.joints[static_cast<size_t>(least_.joint)].name;
    course.record.margin = least_.margin;
    course.record.speed_share = speed_share_;
    course.record.dexterity = dexterity_;
    course.record.straight_time = task_.approach.time + task_.lift.time;
    course.record.straight_path = task_.approach.motion_W.norm() + task_.lift.motion_W.norm();
    course.record.q = q_grasp;
    return true;
  }

 private:
  static bool Fail(int stage, const char* line, Attempt& attempt) {
    attempt.stage = stage;
    attempt.reason = fmt::format("in the {} {}", line, attempt.reason);
    return false;
  }

  Pose CalcFlangeAt(const HandLine& line, double share) const {
    Pose X_WH = line.X_WH;
    X_WH.pretranslate(share * line.motion_W);
    return mounted_.X_WB.inverse() * X_WH * mounted_.X_FH.inverse();
  }

  /** Appends the knots behind the first. @param backward  from the line's end to its start. */
  bool FollowLine(const HandLine& line, bool backward, std::vector<VectorXd>& knots,
                  Attempt& attempt) {
    const double interval = line.time / (kNumKnots - 1);
    for (int k = 1; k < kNumKnots; ++k) {
      const double x = static_cast<double>(k) / (kNumKnots - 1);
      const double share = backward ? 1.0 - CalcMinimumJerk(x) : CalcMinimumJerk(x);
      const Pose X_BF = CalcFlangeAt(line, share);
      const std::optional<VectorXd> q = RefinePosture(arm_, X_BF, knots.back());
      if (!q) {
        attempt = {0, ArmFault::kNoStraightPath,
                   fmt::format("the arm comes {:.0f} mm far of {:.0f} mm",
                               MmFromM((backward ? 1.0 - share : share) * line.motion_W.norm()),
                               MmFromM(line.motion_W.norm())),
                   FindArmPostures(arm_, X_BF, 1).fault.joint, kUnset};
        return false;
      }
      const Vector3d carried_W = backward ? Vector3d(0, 0, 0) : Vector3d(share * line.motion_W);
      if (!CheckKnot(*q, knots.back(), interval, carried_W, attempt)) {
        return false;
      }
      const Pose X_BM = CalcFlangePose(arm_, 0.5 * (*q + knots.back()));
      const double off = CalcLineMiss(line, mounted_.X_WB * X_BM * mounted_.X_FH);
      if (off > kLineTolerance) {
        attempt = {0, ArmFault::kNearSingularity,
                   fmt::format("the hand would leave the line by {:.1f} mm", MmFromM(off)), -1,
                   kUnset};
        return false;
      }
      knots.push_back(*q);
    }
    return true;
  }

  static double CalcLineMiss(const HandLine& line, const Pose& X_WH) {
    const Vector3d p = X_WH.translation() - line.X_WH.translation();
    const double length = line.motion_W.norm();
    if (length == 0.0) return p.norm();
    return p.cross(line.motion_W).norm() / length;
  }

  bool CheckKnot(const VectorXd& q, const VectorXd& before, double interval,
                 const Vector3d& carried_W, Attempt& attempt) {
    const LimitMargin margin = FindLimitMargin(arm_, q);
    if (margin.margin < least_.margin) least_ = margin;
    if (margin.margin < 0.0) {
      attempt = {0, ArmFault::kNoStraightPath,
                 NameJoint(arm_, margin.joint) + " would exceed its limit", margin.joint,
                 margin.margin};
      return false;
    }
    const double dexterity = CalcDexterity(arm_, CalcArmJacobian(CalcArmPoses(arm_, q)));
    dexterity_ = std::min(dexterity_, dexterity);
    int fastest = 0;
    double share = 0.0, speed = 0.0;
    for (int i = 0; i < arm_.num_joints(); ++i) {
      const double of_joint = std::abs(q[i] - before[i]) / interval;
      const double of_limit = of_joint / arm_.joints[static_cast<size_t>(i)].speed;
      if (of_limit <= share) continue;
      fastest = i;
      share = of_limit;
      speed = of_joint;
    }
    speed_share_ = std::max(speed_share_, share);
    if (dexterity < kLeastDexterity) {
      attempt = {0, ArmFault::kNearSingularity,
                 fmt::format("the posture is nearly singular: dexterity {:.3f} (least {:.2f}), "
                             "fastest {}",
                             dexterity, kLeastDexterity, NameJoint(arm_, fastest)),
                 fastest, margin.margin};
      return false;
    }
    if (share > 1.0) {
      attempt = {0,
                 dexterity < kLowDexterity ? ArmFault::kNearSingularity : ArmFault::kNoStraightPath,
                 fmt::format("{} would turn at {:.0f} deg/s (limit {:.0f} deg/s)",
                             NameJoint(arm_, fastest), DegFromRad(speed),
                             DegFromRad(arm_.joints[static_cast<size_t>(fastest)].speed)),
                 fastest, margin.margin};
      return false;
    }
    Pose X_WO = task_.X_WO;
    X_WO.pretranslate(carried_W);
    const std::string touched = FindArmCollision(mounted_, q, *task_.object, X_WO);
    if (touched.empty()) return true;
    attempt = {0, ArmFault::kNoStraightPath, touched, -1, kUnset};
    return false;
  }

  bool Reach(const VectorXd& q_pre, ArmRecord& record, Attempt& attempt) const {
    const VectorXd turn = q_pre - arm_.ready;
    double time = 0.0, path = 0.0;
    for (int i = 0; i < arm_.num_joints(); ++i) {
      time = std::max(time,
                      kPeakSpeed * std::abs(turn[i]) / arm_.joints[static_cast<size_t>(i)].speed);
    }
    Vector3d p_WH =
        (mounted_.X_WB * CalcFlangePose(arm_, arm_.ready) * mounted_.X_FH).translation();
    for (int k = 0; k < kNumReachKnots; ++k) {
      const double share = static_cast<double>(k) / (kNumReachKnots - 1);
      const VectorXd q = arm_.ready + share * turn;
      std::string touched = FindArmCollision(mounted_, q, *task_.object, task_.X_WO);
      if (touched.empty()) {
        touched = FindHandCollision(mounted_, q, *task_.hand,
                                    task_.q_rest + share * (task_.q_pre - task_.q_rest),
                                    task_.object, task_.X_WO);
      }
      if (!touched.empty()) {
        attempt = {4, ArmFault::kNoStraightPath,
                   "on the way from the ready posture to the pre-grasp pose " + touched, -1,
                   kUnset};
        return false;
      }
      const Vector3d next = (mounted_.X_WB * CalcFlangePose(arm_, q) * mounted_.X_FH).translation();
      path += (next - p_WH).norm();
      p_WH = next;
    }
    record.reach_time = time;
    record.reach_path = path;
    return true;
  }

  const MountedArm& mounted_;
  const Arm& arm_;
  const ArmTask& task_;
  LimitMargin least_;
  double dexterity_ = 0.0, speed_share_ = 0.0;
};

ArmCourse MakeOutOfReach(const Arm& arm, const ArmReach& reach) {
  const LimitMargin& closest = reach.closest;
  const ReachFault& fault = reach.fault;
  ArmCourse course;
  course.fault = ArmFault::kOutOfReach;
  if (closest.joint >= 0) {
    course.record.joint = arm.joints[static_cast<size_t>(closest.joint)].name;
    course.record.margin = closest.margin;
    course.reason = fmt::format("{} would be {:.1f} deg beyond its limit",
                                NameJoint(arm, closest.joint), DegFromRad(-closest.margin));
    return course;
  }
  course.reason =
      fmt::format("the grasp is {:.0f} mm out of the arm's reach", MmFromM(fault.shortfall));
  if (fault.joint >= 0) {
    course.record.joint = arm.joints[static_cast<size_t>(fault.joint)].name;
    course.reason += "; " + NameJoint(arm, fault.joint) + " cannot go farther";
  }
  return course;
}

}  // namespace

std::string FindArmCollision(const MountedArm& mounted, const VectorXd& q,
                             const GraspObject& object, const Pose& X_WO) {
  return FindCollision(mounted, q, &object, X_WO);
}

VectorXd CalcRestPosture(const Hand& hand) { return CalcClosedPosture(hand, {}, 0.0); }

std::string FindReadyCollision(const MountedArm& mounted, const Hand& hand) {
  const VectorXd& q = mounted.arm->ready;
  const std::string touched = FindCollision(mounted, q, nullptr, Pose::Identity());
  if (!touched.empty()) return touched;
  return FindHandCollision(mounted, q, hand, CalcRestPosture(hand), nullptr, Pose::Identity());
}

ArmCourse PlanArmCourse(const MountedArm& mounted, const ArmTask& task) {
  const Arm& arm = *mounted.arm;
  const Pose X_BF = mounted.X_WB.inverse() * task.lift.X_WH * mounted.X_FH.inverse();
  const ArmReach reach = FindArmReach(arm, X_BF);
  if (reach.postures.empty()) return MakeOutOfReach(arm, reach);
  CourseTracker tracker(mounted, task);
  Attempt farthest;
  for (const VectorXd& q : reach.postures) {
    ArmCourse course;
    Attempt attempt;
    if (tracker.Follow(q, course, attempt)) return course;
    if (attempt.stage > farthest.stage) farthest = attempt;
  }
  ArmCourse course;
  course.fault = farthest.fault;
  course.reason = farthest.reason;
  if (farthest.joint >= 0) {
    course.record.joint = arm.joints[static_cast<size_t>(farthest.joint)].name;
    course.record.margin = farthest.margin;
  }
  return course;
}

}  // namespace graspbench
