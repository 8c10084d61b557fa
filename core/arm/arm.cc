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
