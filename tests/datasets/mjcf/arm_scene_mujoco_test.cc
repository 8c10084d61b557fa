// Scenes with a robot arm, opened by MuJoCo: poses, masses, and a hand that stays where it is.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>
#include <unistd.h>

#include <memory>
#include <regex>

#include "core/arm/load_arm.h"
#include "core/base/files/files.h"
#include "core/physics/carrying_arm.h"
#include "core/physics/hand_dynamics.h"
#include "datasets/mjcf/mjcf_export.h"
#include "tests/datasets/mjcf/best_grasp_setup.h"

namespace graspbench {
namespace {

struct FreeMujoco {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

/** What scenes for MuJoCo 3 say and Debian's 2.2 does not know: without gravity none of it moves
the arm. */
std::string RemoveNewer(const std::string& text) {
  static const std::regex newer(
      " (inertia=\"convex\"|gravcomp=\"[^\"]*\"|actuatorfrcrange=\"[^\"]*\"|kv=\"[^\"]*\"(?= "
      "forcerange))");
  return std::regex_replace(std::regex_replace(text, newer, ""), std::regex("implicitfast"),
                            "implicit");
}

class ArmScene : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    Arm arm = LoadArm(GetParam());
    for (ArmJoint& joint : arm.joints) joint.inertia = Eigen::Vector3d(0.02, 0.03, 0.04);
    setup_ = MakeBestGraspSetup("tum-evolved", "toy_cube");
    setup_.arm = std::make_shared<const MountedArm>(
        MountArm(ArmConfig(), std::make_shared<const Arm>(arm), *setup_.hand));
    motion_ = RecordMotion(setup_);
    ASSERT_NE(motion_.start.arm, nullptr);
    ConvexPart cube;
    for (int i = 0; i < 8; ++i) {
      cube.vertices.push_back(0.02 *
                              Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    }
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) /
                                       ("arm_scene_" + std::to_string(getpid()) + ".xml");
    WriteFile(file, RemoveNewer(FormatMjcf(setup_, motion_.start, {cube})));
    char fault[1000] = "";
    model_.reset(mj_loadXML(file.c_str(), nullptr, fault, sizeof(fault)));
    std::filesystem::remove(file);
    ASSERT_NE(model_, nullptr) << fault;
    for (mjtNum& part : model_->opt.gravity) part = 0.0;  // with the compensation of weights
    data_.reset(mj_makeData(model_.get()));
    mj_resetDataKeyframe(model_.get(), data_.get(), 0);
    mj_forward(model_.get(), data_.get());
  }

  /** p_WRoot of the hand. */
  Eigen::Vector3d FindRoot() const {
    const std::string name = "hand/" + setup_.hand->links[0].name;
    const int body = mj_name2id(model_.get(), mjOBJ_BODY, name.c_str());
    return Eigen::Map<const Eigen::Vector3d>(data_->xpos + 3 * body);
  }

  TrialSetup setup_;
  CommandedMotion motion_;
  std::unique_ptr<mjModel, FreeMujoco> model_;
  std::unique_ptr<mjData, FreeMujoco> data_;
};

TEST_P(ArmScene, HasPoseMassAndDrivesOfTheTrial) {
  const WorldState& start = motion_.start;
  const Eigen::Vector3d root = (start.X_WH * setup_.hand->links[0].X_PJ).translation();
  EXPECT_LT((FindRoot() - root).norm(), 1e-9);

  const int n = setup_.arm->arm->num_joints();
  HandDynamics hand(*setup_.hand);
  hand.UpdatePositions(start.X_WH, start.q);
  Eigen::MatrixXd M(hand.num_speeds(), hand.num_speeds());
  hand.CalcMassMatrix(M);
  CarryingArm arm(*setup_.arm, start.q_arm, start.u_arm);
  const Eigen::MatrixXd expected =
      arm.jacobian().transpose() * M.bottomRightCorner<6, 6>() * arm.jacobian() + arm.CalcMass();
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> full(model_->nv,
                                                                              model_->nv);
  mj_fullM(model_.get(), full.data(), data_->qM);
  EXPECT_LT((full.topLeftCorner(n, n) - expected).cwiseAbs().maxCoeff(), 1e-5);
  for (int i = 0; i < n; ++i) {
    const ArmJoint& joint = setup_.arm->arm->joints[static_cast<size_t>(i)];
    EXPECT_EQ(std::string(mj_id2name(model_.get(), mjOBJ_JOINT, i)), "arm/" + joint.name);
    EXPECT_NEAR(model_->jnt_range[2 * i], joint.lower, 1e-12);
    EXPECT_NEAR(model_->jnt_range[2 * i + 1], joint.upper, 1e-12);
    EXPECT_NEAR(model_->actuator_gainprm[mjNGAIN * 2 * i], joint.stiffness, 1e-9);
  }
}

TEST_P(ArmScene, HoldsTheHandInPlace) {
  const Eigen::Vector3d before = FindRoot();
  while (data_->time < 0.2) mj_step(model_.get(), data_.get());
  EXPECT_LT((FindRoot() - before).norm(), 5e-5);
}

TEST_P(ArmScene, MotionHasItsJointsInPlaceOfTheRoot) {
  const std::string csv = FormatMotionCsv(*setup_.hand, motion_);
  const std::string header = csv.substr(0, csv.find('\n'));
  const std::string& name = setup_.arm->arm->joints[0].name;
  EXPECT_NE(header.find("arm/" + name + "_rad,"), std::string::npos) << header;
  EXPECT_EQ(header.find("arm_x_m"), std::string::npos) << header;
  const MotionStep& last = motion_.steps.back();
  const Pose X_WH =
      setup_.arm->X_WB * CalcFlangePose(*setup_.arm->arm, last.q_arm) * setup_.arm->X_FH;
  EXPECT_LT((X_WH.matrix() - last.command.X_WH.matrix()).cwiseAbs().maxCoeff(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Arms, ArmScene, testing::Values("puma560", "pa10"));

}  // namespace
}  // namespace graspbench
