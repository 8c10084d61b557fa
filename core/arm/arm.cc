#include "core/arm/arm.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace graspbench {

std::vector<Pose> CalcArmPoses(const Arm& arm, const Eigen::VectorXd& q) {
  GRASPBENCH_DEMAND(q.size() == arm.num_joints(), arm.id);
  std::vector<Pose> X_BL = {Pose::Identity()};
  X_BL.reserve(arm.joints.size() + 1);
  for (size_t i = 0; i < arm.joints.size(); ++i) {
    const ArmJoint& joint = arm.joints[i];
    const double theta = q[static_cast<Eigen::Index>(i)] + joint.offset;
    const double ct = std::cos(theta), st = std::sin(theta);
    const double ca = std::cos(joint.alpha), sa = std::sin(joint.alpha);
    Eigen::Matrix3d R;
    R << ct, -st * ca, st * sa, st, ct * ca, -ct * sa, 0.0, sa, ca;
    X_BL.push_back(X_BL.back() * MakePose(R, Eigen::Vector3d(joint.a * ct, joint.a * st, joint.d)));
  }
  return X_BL;
}

Pose CalcArmPoseAtZero(const ArmJoint& joint) {
  Arm one;
  one.joints = {joint};
  return CalcFlangePose(one, Eigen::VectorXd::Zero(1));
}

Pose CalcFlangePose(const Arm& arm, const Eigen::VectorXd& q) {
  return CalcArmPoses(arm, q).back();
}

Eigen::MatrixXd CalcArmJacobian(const std::vector<Pose>& X_BL) {
  const auto num_joints = static_cast<Eigen::Index>(X_BL.size()) - 1;
  Eigen::MatrixXd jacobian(6, num_joints);
  for (Eigen::Index i = 0; i < num_joints; ++i) {
    const Pose& X_BP = X_BL[static_cast<size_t>(i)];
    const Eigen::Vector3d axis = X_BP.linear().col(2);
    jacobian.col(i).head<3>() = axis.cross(X_BL.back().translation() - X_BP.translation());
    jacobian.col(i).tail<3>() = axis;
  }
  return jacobian;
}

Eigen::Matrix<double, 6, 1> CalcArmVelocityTerm(const std::vector<Pose>& X_BL,
                                                const Eigen::VectorXd& u) {
  Eigen::Vector3d w = Eigen::Vector3d::Zero(), alpha = w, a = w;
  for (size_t i = 0; i + 1 < X_BL.size(); ++i) {
    const Eigen::Vector3d turn = u[static_cast<Eigen::Index>(i)] * X_BL[i].linear().col(2);
    alpha += w.cross(turn);
    w += turn;
    const Eigen::Vector3d r = X_BL[i + 1].translation() - X_BL[i].translation();
    a += alpha.cross(r) + w.cross(w.cross(r));
  }
  Eigen::Matrix<double, 6, 1> result;
  result << a, alpha;
  return result;
}

namespace {

/** By joint the speed of a link's centre of mass for a unit speed of the joint (3, link). */
Eigen::Matrix3Xd CalcComJacobian(const Arm& arm, const std::vector<Pose>& X_BL, size_t link) {
  const Eigen::Vector3d p_BCom = X_BL[link] * arm.joints[link - 1].p_com;
  Eigen::Matrix3Xd jacobian(3, static_cast<Eigen::Index>(link));
  for (size_t i = 0; i < link; ++i) {
    jacobian.col(static_cast<Eigen::Index>(i)) =
        X_BL[i].linear().col(2).cross(p_BCom - X_BL[i].translation());
  }
  return jacobian;
}

}  // namespace

Eigen::MatrixXd CalcArmMass(const Arm& arm, const std::vector<Pose>& X_BL) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(arm.num_joints(), arm.num_joints());
  Eigen::Matrix3Xd axes(3, arm.num_joints());
  for (size_t link = 1; link < X_BL.size(); ++link) {
    const ArmJoint& joint = arm.joints[link - 1];
    const auto n = static_cast<Eigen::Index>(link);
    axes.col(n - 1) = X_BL[link - 1].linear().col(2);
    const Eigen::Matrix3Xd linear = CalcComJacobian(arm, X_BL, link);
    const Eigen::Matrix3Xd angular = X_BL[link].linear().transpose() * axes.leftCols(n);
    M.topLeftCorner(n, n) += joint.mass * linear.transpose() * linear +
                             angular.transpose() * joint.inertia.asDiagonal() * angular;
    M(n - 1, n - 1) += joint.armature;
  }
  return M;
}

Eigen::VectorXd CalcArmWeight(const Arm& arm, const std::vector<Pose>& X_BL,
                              const Eigen::Vector3d& gravity_B) {
  Eigen::VectorXd torque = Eigen::VectorXd::Zero(arm.num_joints());
  for (size_t link = 1; link < X_BL.size(); ++link) {
    torque.head(static_cast<Eigen::Index>(link)) +=
        CalcComJacobian(arm, X_BL, link).transpose() * (arm.joints[link - 1].mass * gravity_B);
  }
  return torque;
}

Eigen::Matrix<double, 6, 6> CalcArmCompliance(const Arm& arm, const Eigen::MatrixXd& jacobian) {
  Eigen::VectorXd compliance(arm.num_joints());
  for (int i = 0; i < arm.num_joints(); ++i) {
    compliance[i] = 1.0 / arm.joints[static_cast<size_t>(i)].stiffness;
  }
  return jacobian * compliance.asDiagonal() * jacobian.transpose();
}

double CalcArmReach(const Arm& arm) {
  double reach = 0.0;
  for (size_t i = 1; i < arm.joints.size(); ++i) {
    reach += std::hypot(arm.joints[i].a, arm.joints[i].d);
  }
  return reach;
}

double CalcDexterity(const Arm& arm, const Eigen::MatrixXd& jacobian) {
  Eigen::MatrixXd scaled = jacobian;
  scaled.topRows<3>() /= CalcArmReach(arm);
  if (scaled.cols() < 6) return scaled.jacobiSvd().singularValues().tail<1>()(0);
  // The smallest eigenvalue of J J^T is that value squared; exact enough for a threshold of 1e-2.
  const Eigen::Matrix<double, 6, 6> gram = scaled * scaled.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(gram,
                                                                         Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[0]));
}

}  // namespace graspbench
