#include "core/arm/arm_course.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/arm/arm_inverse.h"
#include "core/arm/load_arm.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/** A block at the origin, and a hand that comes from above, its palm down. */
class ArmCourseTest : public testing::Test {
 protected:
  MountedArm Mount(const char* arm, const ArmConfig& config) {
    return MountArm(config, std::make_shared<const Arm>(LoadArm(arm)), hand_);
  }

  ArmTask MakeTask(const Vector3d& p_WH) const {
    ArmTask task;
    task.object = &block_;
    task.X_WO = MakePose(Vector3d(0.0, 0.0, 0.5 * block_.size.z()));
    task.lift.X_WH = MakePose(MakeRotationRpy(kPi, 0.0, 0.0), p_WH);
    task.lift.motion_W = Vector3d(0.0, 0.0, 0.1);
    task.lift.time = 1.0;
    task.approach.X_WH = task.lift.X_WH;
    task.approach.X_WH.pretranslate(task.lift.motion_W);
    task.approach.motion_W = -task.lift.motion_W;
    task.approach.time = 0.8;
    task.hand = &hand_;
    task.q_rest = task.q_pre = VectorXd::Zero(hand_.num_joints());
    return task;
  }

  const Hand hand_ = LoadHand("tum");
  const GraspObject block_ = MakeBlock(0.1);
};

void ExpectKeepsLimits(const Arm& arm, const std::vector<VectorXd>& knots, double time) {
  const double interval = time / static_cast<double>(knots.size() - 1);
  for (size_t k = 0; k < knots.size(); ++k) {
    for (int i = 0; i < arm.num_joints(); ++i) {
      const ArmJoint& joint = arm.joints[static_cast<size_t>(i)];
      EXPECT_GE(knots[k][i], joint.lower);
      EXPECT_LE(knots[k][i], joint.upper);
      const VectorXd& before = knots[k == 0 ? 0 : k - 1];
      EXPECT_LE(std::abs(knots[k][i] - before[i]), joint.speed * interval);
    }
  }
}

/** The largest distance of the hand from the line, ten times as dense as the knots [m]. */
double CalcLargestMiss(const MountedArm& mounted, const std::vector<VectorXd>& knots,
                       const HandLine& line) {
  double largest = 0.0;
  for (size_t k = 1; k < knots.size(); ++k) {
    for (int i = 0; i <= 10; ++i) {
      const VectorXd q = knots[k - 1] + 0.1 * i * (knots[k] - knots[k - 1]);
      const Vector3d p =
          (mounted.X_WB * CalcFlangePose(*mounted.arm, q) * mounted.X_FH).translation() -
          line.X_WH.translation();
      largest = std::max(largest, p.cross(line.motion_W.normalized()).norm());
    }
  }
  return largest;
}

TEST_F(ArmCourseTest, StraightCoursesKeepLimitsSpeedsAndLine) {
  for (const char* id : {"puma560", "pa10"}) {
    const MountedArm mounted = Mount(id, ArmConfig());
    const ArmTask task = MakeTask(Vector3d(0.0, 0.0, 0.12));
    const ArmCourse course = PlanArmCourse(mounted, task);
    ASSERT_EQ(course.fault, ArmFault::kNone) << id << ": " << course.reason;
    ExpectKeepsLimits(*mounted.arm, course.approach, task.approach.time);
    ExpectKeepsLimits(*mounted.arm, course.lift, task.lift.time);
    EXPECT_LT(CalcLargestMiss(mounted, course.approach, task.approach), 0.0005) << id;
    EXPECT_LT(CalcLargestMiss(mounted, course.lift, task.lift), 0.0005) << id;
    const Pose X_WH = mounted.X_WB * CalcFlangePose(*mounted.arm, course.record.q) * mounted.X_FH;
    EXPECT_LT((X_WH.matrix() - task.lift.X_WH.matrix()).cwiseAbs().maxCoeff(), 1e-9) << id;
    EXPECT_GT(course.record.margin, 0.0);
    EXPECT_LE(course.record.speed_share, 1.0);
    EXPECT_GE(course.record.dexterity, kLeastDexterity);
    EXPECT_DOUBLE_EQ(course.record.straight_time, 1.8);
    EXPECT_NEAR(course.record.straight_path, 0.2, 1e-12);
    EXPECT_GT(course.record.reach_path, 0.0);
    // Minimum-jerk at the speed of the slowest joint: 15/8 of its mean speed at most its limit.
    const VectorXd turn = course.approach.front() - mounted.arm->ready;
    double time = 0.0;
    for (int i = 0; i < turn.size(); ++i) {
      time = std::max(time, 1.875 * std::abs(turn[i]) / mounted.arm->joints[i].speed);
    }
    EXPECT_NEAR(course.record.reach_time, time, 1e-12);
  }
}

TEST_F(ArmCourseTest, FarGraspIsOutOfReachByItsDistance) {
  ArmConfig config;
  config.x = -2.0;
  const MountedArm mounted = Mount("pa10", config);
  const ArmCourse course = PlanArmCourse(mounted, MakeTask(Vector3d(0.0, 0.0, 0.12)));
  EXPECT_EQ(course.fault, ArmFault::kOutOfReach);
  EXPECT_EQ(course.record.joint, "E1");
  // The wrist centre stands above the hand by its offset and the 80 mm of the wrist.
  const double height = 0.12 + mounted.X_FH.translation().z() + 0.08 - 0.315;
  const int shortfall_mm = static_cast<int>(std::lround(1e3 * (std::hypot(2.0, height) - 0.95)));
  EXPECT_NE(course.reason.find(std::to_string(shortfall_mm) + " mm out of the arm's reach"),
            std::string::npos)
      << course.reason;
}

/** A hand with its palm up: the wrist would have to stand below the table. */
TEST_F(ArmCourseTest, ArmBelowTableIsRefusedByItsLink) {
  const MountedArm mounted = Mount("pa10", ArmConfig());
  ArmTask task = MakeTask(Vector3d(0.0, 0.0, 0.12));
  for (HandLine* line : {&task.approach, &task.lift}) {
    line->X_WH.linear() = Eigen::Matrix3d::Identity();
  }
  const ArmCourse course = PlanArmCourse(mounted, task);
  EXPECT_EQ(course.fault, ArmFault::kOutOfReach);
  EXPECT_NE(course.reason.find("would meet the table"), std::string::npos) << course.reason;
}

/** One joint at its limit: the PA-10 whose wrist W1 may not bend. */
TEST_F(ArmCourseTest, NamesJointBeyondItsLimit) {
  Arm arm = LoadArm("pa10");
  arm.joints[5].lower = -RadFromDeg(5.0);
  arm.joints[5].upper = RadFromDeg(5.0);
  const MountedArm mounted = MountArm(ArmConfig(), std::make_shared<const Arm>(arm), hand_);
  const ArmCourse course = PlanArmCourse(mounted, MakeTask(Vector3d(0.0, 0.0, 0.12)));
  EXPECT_EQ(course.fault, ArmFault::kOutOfReach);
  EXPECT_NE(course.reason.find("joint 6 (W1) would be"), std::string::npos) << course.reason;
}

/** The lift to just below the longest reach straightens the elbow; beyond it there is no line. */
TEST_F(ArmCourseTest, StretchedElbowIsNearSingularOrNoPath) {
  const MountedArm mounted = Mount("pa10", ArmConfig());
  ArmTask task = MakeTask(Vector3d(0.0, 0.0, 1.0));
  for (HandLine* line : {&task.approach, &task.lift}) {
    line->X_WH = MakePose(Vector3d(-0.2, 0.0, 1.0));  // palm up
  }
  task.approach.motion_W.setZero();
  task.lift.motion_W = Vector3d(0.0, 0.0, 0.6);
  const ArmCourse beyond = PlanArmCourse(mounted, task);
  EXPECT_NE(beyond.fault, ArmFault::kNone);
  EXPECT_NE(beyond.fault, ArmFault::kOutOfReach) << beyond.reason;
}

/** The block stands where the hand would be half way: that gross motion is refused, or another
posture's is taken. From a shoulder that is lower than at the grasp the hand comes through the
table. */
TEST_F(ArmCourseTest, GrossMotionKeepsTheHandOffObjectAndTable) {
  MountedArm mounted = Mount("puma560", ArmConfig());
  ArmTask task = MakeTask(Vector3d(0.0, 0.0, 0.12));
  const ArmCourse free = PlanArmCourse(mounted, task);
  ASSERT_EQ(free.fault, ArmFault::kNone) << free.reason;
  const auto place = [&](const VectorXd& q) {
    return mounted.X_WB * CalcFlangePose(*mounted.arm, q) * mounted.X_FH;
  };
  const VectorXd half = 0.5 * (mounted.arm->ready + free.approach.front());
  const Pose X_HPalm = CalcLinkPose(hand_, task.q_pre, hand_.palm_link);
  task.X_WO = MakePose((place(half) * X_HPalm).translation());
  const ArmCourse other = PlanArmCourse(mounted, task);
  if (other.fault == ArmFault::kNone) {
    EXPECT_GT((other.approach.front() - free.approach.front()).norm(), 0.1);
  } else {
    EXPECT_EQ(other.fault, ArmFault::kNoStraightPath);
    EXPECT_NE(other.reason.find("on the way from the ready posture to the pre-grasp pose the hand "
                                "would meet the object"),
              std::string::npos)
        << other.reason;
  }
  task = MakeTask(Vector3d(0.0, 0.0, 0.12));
  Arm low = LoadArm("puma560");
  low.ready = free.record.q;
  const auto palm_height = [&](double turn) {
    VectorXd q = free.record.q;
    q[1] += turn;
    return (place(q) * X_HPalm).translation().z();
  };
  const double down = palm_height(0.01) < palm_height(0.0) ? 0.01 : -0.01;
  while (palm_height(low.ready[1] - free.record.q[1]) > 0.0) low.ready[1] += down;
  mounted.arm = std::make_shared<const Arm>(low);
  const ArmCourse through = PlanArmCourse(mounted, task);
  EXPECT_EQ(through.fault, ArmFault::kNoStraightPath);
  EXPECT_NE(through.reason.find("the hand would meet the table"), std::string::npos)
      << through.reason;
}

/** Damped Newton steps within the limits from random postures of joint space: no closed form. */
bool IsReachedBySearch(const Arm& arm, const Pose& X_BF, RandomStream& random, int num_starts) {
  for (int start = 0; start < num_starts; ++start) {
    VectorXd q(arm.num_joints());
    for (int i = 0; i < arm.num_joints(); ++i) {
      const ArmJoint& joint = arm.joints[static_cast<size_t>(i)];
      q[i] = random.NextUniform(joint.lower, joint.upper);
    }
    double before = 1e9;
    for (int step = 0; step < 60; ++step) {
      const std::vector<Pose> X_BL = CalcArmPoses(arm, q);
      Eigen::Matrix<double, 6, 1> miss;
      miss.head<3>() = X_BF.translation() - X_BL.back().translation();
      const Eigen::AngleAxisd turn(X_BF.linear() * X_BL.back().linear().transpose());
      miss.tail<3>() = turn.angle() * turn.axis();
      if (miss.norm() < 1e-6) return true;
      if (step % 20 == 19) {
        if (miss.norm() > 0.7 * before) break;
        before = miss.norm();
      }
      const Eigen::MatrixXd J = CalcArmJacobian(X_BL);
      const Eigen::MatrixXd gram =
          J * J.transpose() + 1e-4 * Eigen::MatrixXd::Identity(6, 6) * std::min(1.0, miss.norm());
      q += J.transpose() * gram.ldlt().solve(miss);
      for (int i = 0; i < arm.num_joints(); ++i) {
        const ArmJoint& joint = arm.joints[static_cast<size_t>(i)];
        q[i] = std::clamp(q[i], joint.lower, joint.upper);
      }
    }
  }
  return false;
}

TEST_F(ArmCourseTest, ReachAgreesWithSearchOfJointSpace) {
  for (const char* id : {"puma560", "pa10"}) {
    const MountedArm mounted = Mount(id, ArmConfig());
    RandomStream random(id, "random grasps");
    int num_reached = 0, num_missed = 0, num_false = 0;
    for (int n = 0; n < 150; ++n) {
      const double tilt = random.NextUniform(0.0, 0.6 * kPi), way = random.NextUniform(-kPi, kPi);
      const Eigen::Matrix3d R = MakeRotationRpy(kPi, 0.0, random.NextUniform(-kPi, kPi));
      const Vector3d axis(std::cos(way), std::sin(way), 0.0);
      const Pose X_WH =
          MakePose(Eigen::AngleAxisd(tilt, axis) * R,
                   Vector3d(random.NextUniform(-0.2, 0.8), random.NextUniform(-0.5, 0.5),
                            random.NextUniform(0.05, 0.4)));
      const Pose X_BF = mounted.X_WB.inverse() * X_WH * mounted.X_FH.inverse();
      const bool is_reached = !FindArmReach(*mounted.arm, X_BF).postures.empty();
      const bool is_found = IsReachedBySearch(*mounted.arm, X_BF, random, is_reached ? 200 : 40);
      num_reached += is_reached;
      num_missed += is_found && !is_reached;
      num_false += is_reached && !is_found;
    }
    RecordProperty(std::string(id) + "_reached", num_reached);
    RecordProperty(std::string(id) + "_not_found_by_search", num_false);
    EXPECT_GT(num_reached, 30) << id;
    EXPECT_LT(num_reached, 120) << id;
    EXPECT_EQ(num_missed, 0) << id;
    EXPECT_EQ(num_false, 0) << id;
  }
}

}  // namespace
}  // namespace graspbench
