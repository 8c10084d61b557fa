#include "core/render/hand_scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// A forearm, a palm behind a wrist, one finger and a thumb; each digit is one link of 60 mm.
std::shared_ptr<const Hand> MakePincer() {
  auto hand = std::make_shared<Hand>();
  const auto add_link = [&](int parent, const Pose& X_PJ, double length) {
    HandLink link;
    link.parent = parent;
    link.X_PJ = X_PJ;
    const int index = static_cast<int>(hand->links.size());
    if (parent >= 0) {
      link.joint = hand->num_joints();
      HandJoint joint;
      joint.link = index;
      hand->joints.push_back(joint);
    }
    hand->links.push_back(link);
    LinkVisual visual;
    visual.link = index;
    visual.mesh = MakeTaperedCapsule(Vector3d::Zero(), 0.01, Vector3d(0.0, 0.0, length), 0.008, 12);
    hand->visuals.push_back(visual);
  };
  add_link(-1, MakePose(Vector3d(0.0, 0.0, -0.3)), 0.3);
  add_link(0, MakePose(Vector3d(0.0, 0.0, 0.3)), 0.05);
  hand->palm_link = 1;
  for (const bool is_thumb : {false, true}) {
    add_link(1, MakePose(Vector3d(0.0, is_thumb ? -0.04 : 0.04, 0.05)), 0.06);
    Digit digit;
    digit.is_thumb = is_thumb;
    digit.distal_link = static_cast<int>(hand->links.size()) - 1;
    digit.links = {digit.distal_link};
    digit.p_LTip = Vector3d(0.0, 0.0, 0.06);
    hand->digits.push_back(digit);
  }
  return hand;
}

std::shared_ptr<const GraspObject> MakeBlock() {
  auto object = std::make_shared<GraspObject>();
  object->mesh = MakeRoundedBox(Vector3d(0.1, 0.06, 0.04), 0.0);
  object->colour = Eigen::Vector3f(0.1f, 0.2f, 0.3f);
  return object;
}

// Fingers downwards, 0.2 m above the table.
Pose MakeDownwards(double yaw) {
  return MakePose(MakeRotationRpy(M_PI, 0.0, yaw), Vector3d(0.1, -0.2, 0.2));
}

TEST(HandSceneTest, PutsEveryPartWhereItsLinkIs) {
  const auto hand = MakePincer();
  const auto object = MakeBlock();
  const VectorXd q = VectorXd::Constant(3, 0.4);
  const Pose X_WH = MakeDownwards(0.7);
  const Pose X_WO = MakePose(Vector3d(0.1, -0.2, 0.02));
  const Scene scene = MakeGraspScene(hand, q, X_WH, object, X_WO);
  ASSERT_EQ(scene.drawables.size(), hand->visuals.size() + 1);
  const std::vector<Pose> X_HL = CalcLinkPoses(*hand, q);
  for (size_t i = 0; i < hand->visuals.size(); ++i) {
    EXPECT_TRUE(scene.drawables[i].X_WM.isApprox(X_WH * X_HL[hand->visuals[i].link]));
    EXPECT_EQ(scene.drawables[i].mesh.get(), &hand->visuals[i].mesh);  // shared, not copied
  }
  EXPECT_TRUE(scene.drawables.back().X_WM.isApprox(X_WO));
  EXPECT_EQ(scene.drawables.back().colour, object->colour);
  // A forearm would make everything else small.
  for (size_t i = 0; i < hand->visuals.size(); ++i) {
    EXPECT_EQ(scene.drawables[i].must_be_seen, hand->FindDigitOfLink(hand->visuals[i].link) >= 0);
  }
  EXPECT_TRUE(scene.drawables.back().must_be_seen);
}

// Where a point appears, as shares of half the picture's size; within +-1 it is in the picture.
Vector2d FindInPicture(const Camera& camera, double aspect, const Vector3d& p_W) {
  const Vector3d forward = (camera.p_WTarget - camera.p_WEye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  const Vector3d up = right.cross(forward);
  const Vector3d p = p_W - camera.p_WEye;
  const double half = std::tan(0.5 * camera.field_of_view) * p.dot(forward);
  return Vector2d(p.dot(right) / (aspect * half), p.dot(up) / half);
}

TEST(FrameScenesTest, HoldsWhatMustBeSeenAndTouchesTheMargin) {
  const auto hand = MakePincer();
  const auto object = MakeBlock();
  const VectorXd q = VectorXd::Constant(3, 0.2);
  const std::vector<Scene> scenes = {
      MakeGraspScene(hand, q, MakeDownwards(0.7), object, Pose::Identity()),
      MakeGraspScene(hand, -q, MakeDownwards(0.7), object, MakePose(Vector3d(0.0, 0.0, 0.1)))};
  for (const double aspect : {0.5, 1.2, 3.0}) {
    for (const Vector3d& to_eye_W : {Vector3d(1.0, -2.0, 1.0), Vector3d(-3.0, 0.5, 0.0)}) {
      const Camera camera = FrameScenes(scenes, to_eye_W, aspect);
      EXPECT_TRUE((camera.p_WEye - camera.p_WTarget).normalized().isApprox(to_eye_W.normalized()));
      Vector2d lower = Vector2d::Constant(9.0);
      Vector2d upper = -lower;
      for (const Scene& scene : scenes) {
        for (const Drawable& drawable : scene.drawables) {
          if (!drawable.must_be_seen) continue;
          for (const Vector3d& p_M : drawable.mesh->vertices) {
            const Vector2d p = FindInPicture(camera, aspect, drawable.X_WM * p_M);
            lower = lower.cwiseMin(p);
            upper = upper.cwiseMax(p);
          }
        }
      }
      const Vector2d filled = 0.5 * (upper - lower);
      EXPECT_LT(upper.maxCoeff(), 0.95);
      EXPECT_GT(lower.minCoeff(), -0.95);
      EXPECT_NEAR(filled.maxCoeff(), 0.94, 1e-3);  // no farther away than needed
    }
  }
}

// Two links of 0.4 m along x of the base, in line.
MountedArm MakeReach(const Pose& X_WB) {
  Arm arm;
  arm.joints.resize(2);
  for (ArmJoint& joint : arm.joints) joint.a = 0.4;
  for (int link = 0; link < 3; ++link) {
    arm.capsules.push_back({link, Vector3d(link > 0 ? -0.4 : 0.0, 0.0, 0.0), {0, 0, 0}, 0.05});
  }
  MountedArm mounted;
  mounted.arm = std::make_shared<const Arm>(arm);
  mounted.X_WB = X_WB;
  return mounted;
}

TEST(AddArmTest, AWholeArmIsInThePictureWithItsHandAndIsSeenFromTheSide) {
  const auto hand = MakePincer();
  for (const double yaw : {0.0, 0.8, 2.5}) {
    const Pose X_WB = MakePose(MakeRotationRpy(0.0, 0.0, yaw), Vector3d(-0.3, 0.2, 0.5));
    const MountedArm arm = MakeReach(X_WB);
    const Vector3d ahead_W = X_WB.linear() * Vector3d::UnitX();
    Pose X_WH = MakeDownwards(yaw);
    X_WH.translation() = X_WB * Vector3d(0.8, 0.0, 0.0);
    Scene scene = MakeGraspScene(hand, VectorXd::Zero(3), X_WH, MakeBlock(), Pose::Identity());
    AddArm(&arm, VectorXd::Zero(2), true, &scene);
    const Vector3d to_eye_W = FindArmView(arm, X_WH);
    EXPECT_NEAR(to_eye_W.norm(), 1.0, 1e-12);
    EXPECT_LT(std::abs(to_eye_W.dot(ahead_W)), 0.4);
    const Camera camera = FrameScenes({scene}, to_eye_W, 4.0 / 3.0);
    for (const Drawable& drawable : scene.drawables) {
      for (const Vector3d& p_M : drawable.mesh->vertices) {
        const Vector2d p = FindInPicture(camera, 4.0 / 3.0, drawable.X_WM * p_M);
        ASSERT_LT(p.cwiseAbs().maxCoeff(), 0.95) << yaw;
      }
    }
  }
  // A hand straight above the base has no side.
  const MountedArm upright = MakeReach(Pose::Identity());
  EXPECT_NEAR(FindArmView(upright, MakePose(Vector3d(0.0, 0.0, 0.8))).norm(), 1.0, 1e-12);
}

TEST(FindGraspViewTest, LooksAcrossTheGripFromAboveAndTurnsWithTheHand) {
  const auto hand = MakePincer();
  const VectorXd q = VectorXd::Zero(3);
  for (const double yaw : {0.0, 0.8, 2.5}) {
    const Pose X_WH = MakeDownwards(yaw);
    const Vector3d to_eye_W = FindGraspView(*hand, q, X_WH);
    EXPECT_NEAR(to_eye_W.norm(), 1.0, 1e-12);
    EXPECT_GT(to_eye_W.z(), 0.2);
    const Vector3d grip_W = X_WH.linear() * Vector3d::UnitY();
    EXPECT_LT(std::abs(to_eye_W.dot(grip_W)), 0.5);
    EXPECT_TRUE((MakeRotationRpy(0.0, 0.0, -yaw) * to_eye_W)
                    .isApprox(FindGraspView(*hand, q, MakeDownwards(0.0)), 1e-9));
  }
}

}  // namespace
}  // namespace graspbench
