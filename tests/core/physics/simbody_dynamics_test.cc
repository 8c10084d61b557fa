#include "core/physics/simbody_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

// Both find the same poses, mass matrix and bias, in the same degrees of freedom.
TEST(SimbodyDynamics, AgreesWithTheArrays) {
  for (const char* id : {"tum", "shadow"}) {
    const Hand hand = LoadHand(id);
    MassProperties object;
    object.mass = 0.1;
    object.I_OOcm = 1e-4 * Eigen::Matrix3d::Identity();
    SimbodyModel model(hand, object);
    SimbodyDynamics theirs(model);
    HandDynamics ours(hand), taken(hand);
    const Pose X_WH = MakePose(MakeRotationRpy(0.3, -0.4, 1.1), Eigen::Vector3d(0.1, 0.2, 0.3));
    Eigen::VectorXd q(ours.num_joints()), u(ours.num_speeds());
    for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = 0.3 * std::sin(1.0 + 2.0 * i);
    for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = std::cos(3.0 * i);
    ours.UpdatePositions(X_WH, q);
    theirs.SetPositions(ours, X_WH, q);
    taken.TakePoses(X_WH, theirs.CalcLinkPoses());
    for (size_t link = 0; link < hand.links.size(); ++link) {
      const int i = static_cast<int>(link);
      EXPECT_TRUE(taken.X_WL(i).isApprox(ours.X_WL(i), 1e-12)) << id << " " << link;
    }
    for (int joint = 0; joint < ours.num_joints(); ++joint) {
      EXPECT_TRUE(taken.motion(joint).isApprox(ours.motion(joint), 1e-12)) << id << " " << joint;
    }
    Eigen::MatrixXd M(ours.num_speeds(), ours.num_speeds());
    ours.CalcMassMatrix(M);
    EXPECT_LT((theirs.CalcMassMatrix() - M).cwiseAbs().maxCoeff(), 1e-12 * M.cwiseAbs().maxCoeff());
    const Eigen::Vector3d gravity_W(0.5, -1.0, -9.0);
    Eigen::VectorXd bias(ours.num_speeds());
    ours.CalcBias(u, gravity_W, bias);
    EXPECT_LT((theirs.CalcBias(u, gravity_W) - bias).cwiseAbs().maxCoeff(),
              1e-10 * bias.cwiseAbs().maxCoeff())
        << id;
  }
}

}  // namespace
}  // namespace graspbench
