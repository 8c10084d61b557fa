// Imported models against MuJoCo itself: where joints, shapes and vertices are in random postures.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <memory>
#include <random>

#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/hand/import/read_foreign_urdf.h"
#include "core/hand/import/select_hand.h"
#include "core/hand/import/weld_links.h"
#include "tests/core/hand/import/import_file.h"
#include "tests/core/hand/import/small_claw.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

struct FreeMujoco {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, FreeMujoco>;
using Data = std::unique_ptr<mjData, FreeMujoco>;

Vector3d VectorAt(const mjtNum* numbers, int index) {
  return {numbers[3 * index], numbers[3 * index + 1], numbers[3 * index + 2]};
}

Pose PoseAt(const mjtNum* places, const mjtNum* matrices, int index) {
  Matrix3d R;
  for (int k = 0; k < 9; ++k) R(k / 3, k % 3) = matrices[9 * index + k];
  return MakePose(R, VectorAt(places, index));
}

class MujocoPeerTest : public testing::Test {
 protected:
  MujocoPeerTest()
      : folder_(fs::path(testing::TempDir()) / ("mujoco_peer_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    MakeFolder(folder_);
  }
  ~MujocoPeerTest() override { fs::remove_all(folder_); }

  void Load(const std::string& text) {
    WriteFile(folder_ / "model.xml", text);
    char fault[1000] = "";
    model_.reset(mj_loadXML((folder_ / "model.xml").c_str(), nullptr, fault, sizeof(fault)));
    ASSERT_NE(model_, nullptr) << fault;
    data_.reset(mj_makeData(model_.get()));
    const HandSource source = MakeFileSource(folder_ / "model.xml");
    Diagnostics problems;
    ForeignHand foreign = ReadForeignMjcf(text, source.file, folder_, problems);
    const int palm_link = SelectHand("", {}, source.file, problems, foreign);
    ShapeLoader loader(source, problems);
    std::vector<LoadedShapes> shapes;
    for (ForeignLink& link : foreign.links) {
      shapes.push_back(loader.Load(link));
      loader.Weigh(link);
    }
    imported_ = WeldLinks(foreign, palm_link, shapes, source.file, problems);
    ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  }

  /** Joints of the hand at random within their limits, the rest of the model where it starts. */
  Eigen::VectorXd SetRandomPosture(std::mt19937& random) {
    const Hand& hand = imported_.hand;
    Eigen::VectorXd q(hand.num_joints());
    for (int j = 0; j < hand.num_joints(); ++j) {
      q[j] = std::uniform_real_distribution<double>(hand.joints[j].lower,
                                                    hand.joints[j].upper)(random);
      const int id = mj_name2id(model_.get(), mjOBJ_JOINT, hand.joints[j].name.c_str());
      EXPECT_GE(id, 0);
      const int at = model_->jnt_qposadr[id];
      data_->qpos[at] = model_->qpos0[at] + q[j];
    }
    mj_kinematics(model_.get(), data_.get());
    return q;
  }

  int BodyOf(const std::string& name) const {
    return mj_name2id(model_.get(), mjOBJ_BODY, name.c_str());
  }

  fs::path folder_;
  Model model_;
  Data data_;
  ImportedHand imported_;
};

TEST_F(MujocoPeerTest, JointsAndShapesAreWhereMujocoHasThem) {
  Load(kSmallClaw);
  const Hand& hand = imported_.hand;
  ASSERT_EQ(hand.num_joints(), 10);
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::VectorXd q = SetRandomPosture(random);
    const std::vector<Pose> X_RL =
        CalcLinkPoses(hand, q);  // in the root, whose frame is the palm's
    const Pose X_WR = PoseAt(data_->xpos, data_->xmat, BodyOf("palm"));
    for (int j = 0; j < hand.num_joints(); ++j) {
      const int id = mj_name2id(model_.get(), mjOBJ_JOINT, hand.joints[j].name.c_str());
      const Pose X_WL = X_WR * X_RL[static_cast<size_t>(hand.joints[j].link)];
      const Vector3d axis_W = X_WL.linear() * hand.links[hand.joints[j].link].axis;
      EXPECT_LT((axis_W - VectorAt(data_->xaxis, id)).norm(), 1e-12) << hand.joints[j].name;
      if (hand.joints[j].is_prismatic) continue;  // has no place in MuJoCo
      EXPECT_LT((X_WL.translation() - VectorAt(data_->xanchor, id)).norm(), 1e-12)
          << hand.joints[j].name;
    }
    // Each shape is one of MuJoCo's, by place and axis.
    for (const CollisionShape& shape : imported_.shapes) {
      const Pose X_WS = X_WR * X_RL[static_cast<size_t>(shape.link)] * shape.X_LS;
      double nearest = 1.0;
      for (int id = 0; id < model_->ngeom; ++id) {
        const Pose X_WG = PoseAt(data_->geom_xpos, data_->geom_xmat, id);
        const double apart = (X_WG.translation() - X_WS.translation()).norm();
        const double turned = 1.0 - std::abs(X_WG.linear().col(2).dot(X_WS.linear().col(2)));
        nearest = std::min(nearest, apart + turned);
      }
      EXPECT_LT(nearest, 1e-9);
    }
  }
  EXPECT_EQ(imported_.shapes.size(), 10u);
}

// Of the palm those of its <inertial>, of all others those of their geoms.
TEST_F(MujocoPeerTest, MassesAreMujocos) {
  std::string text = ReplaceOnce(kSmallClaw, "<geom type=\"capsule\" size=\"0.01\"/>",
                                 "<geom type=\"capsule\" size=\"0.01\" density=\"2700\"/>");
  text = ReplaceOnce(text, "<geom name=\"mf_middle\" ", "<geom name=\"mf_middle\" mass=\"0.02\" ");
  text = ReplaceOnce(text, "<geom name=\"ff_middle\" ",
                     "<geom type=\"ellipsoid\" size=\"0.01 0.012 0.02\" pos=\"0.003 0.002 0.01\" "
                     "euler=\"10 20 30\"/><geom name=\"ff_middle\" ");
  Load(text);
  int num_compared = 0;
  for (const HandLink& link : imported_.hand.links) {
    const int body = BodyOf(link.name);
    if (body < 0) continue;  // between two joints of a body
    ++num_compared;
    EXPECT_NEAR(link.mass, model_->body_mass[body], 1e-12) << link.name;
    Vector3d p_BL = Vector3d::Zero();  // a link's frame is that of its hinge
    if (link.joint >= 0 && !imported_.hand.joints[link.joint].is_prismatic) {
      const std::string& joint = imported_.hand.joints[link.joint].name;
      p_BL = VectorAt(model_->jnt_pos, mj_name2id(model_.get(), mjOBJ_JOINT, joint.c_str()));
    }
    EXPECT_LT((p_BL + link.p_LLcm - VectorAt(model_->body_ipos, body)).norm(), 1e-12) << link.name;
    Matrix3d R;
    mjtNum matrix[9];
    mju_quat2Mat(matrix, model_->body_iquat + 4 * body);
    for (int k = 0; k < 9; ++k) R(k / 3, k % 3) = matrix[k];
    const Matrix3d I = R * VectorAt(model_->body_inertia, body).asDiagonal() * R.transpose();
    EXPECT_LT((link.I_LLcm - I).norm(), 1e-12) << link.name;
  }
  EXPECT_EQ(num_compared, 10);
}

// A mesh's place: refpos, refquat and scale of the asset, pos and quat of the geom.
TEST_F(MujocoPeerTest, VerticesAreWhereMujocoHasThem) {
  WriteFile(folder_ / "wedge.obj",
            "v 0 0 0\nv 30 0 0\nv 0 20 0\nv 0 0 50\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  std::string text = ReplaceOnce(
      kSmallClaw, "<worldbody>",
      "<asset><mesh name=\"wedge\" file=\"wedge.obj\" scale=\"0.001 0.001 0.001\" refpos=\"3 4 5\" "
      "refquat=\"1 0.2 0.3 0.1\"/></asset><worldbody>");
  text = ReplaceOnce(text, "<geom name=\"palm\" ",
                     "<geom name=\"wedge\" type=\"mesh\" mesh=\"wedge\" pos=\"0.01 0.02 0.03\" "
                     "euler=\"10 20 30\" group=\"1\"/><geom name=\"palm\" ");
  Load(text);
  std::mt19937 random(2);
  SetRandomPosture(random);
  const int id = mj_name2id(model_.get(), mjOBJ_GEOM, "wedge");
  ASSERT_GE(id, 0);
  const Pose X_WG = PoseAt(data_->geom_xpos, data_->geom_xmat, id);
  const Pose X_WR = PoseAt(data_->xpos, data_->xmat, BodyOf("palm"));
  ASSERT_EQ(imported_.visuals.size(), 1u);
  const TriMesh& mesh = imported_.visuals[0].visual.mesh;
  const int mesh_id = model_->geom_dataid[id];
  ASSERT_EQ(mesh.vertices.size(), 4u);
  for (const Vector3d& p : mesh.vertices) {
    double nearest = 1.0;
    for (int v = 0; v < model_->mesh_vertnum[mesh_id]; ++v) {
      const float* at = model_->mesh_vert + 3 * (model_->mesh_vertadr[mesh_id] + v);
      const Vector3d p_G(at[0], at[1], at[2]);
      nearest = std::min(nearest, (X_WG * p_G - X_WR * p).norm());
    }
    EXPECT_LT(nearest, 1e-7);
  }
}

// What ties joints is what MuJoCo's own equality is at rest with.
TEST_F(MujocoPeerTest, FollowersFulfilMujocosEquality) {
  Load(kSmallClaw);
  const Hand& hand = imported_.hand;
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd q = SetRandomPosture(random);
    ApplyCoupling(hand, q);
    for (int j = 0; j < hand.num_joints(); ++j) {
      const int id = mj_name2id(model_.get(), mjOBJ_JOINT, hand.joints[j].name.c_str());
      const int at = model_->jnt_qposadr[id];
      data_->qpos[at] = model_->qpos0[at] + q[j];
    }
    mj_forward(model_.get(), data_.get());
    ASSERT_GE(data_->ne, 1);
    EXPECT_NEAR(data_->efc_pos[0], 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace graspbench
