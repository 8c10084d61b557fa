#include "core/vision/wrist_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

std::shared_ptr<const Hand> LoadShared(const char* id) {
  return std::make_shared<const Hand>(LoadHand(id));
}

Pose MakeRest(const GraspObject& object, const PlanarPose& pose) {
  return MakePose(MakeRotationRpy(0.0, 0.0, pose.yaw),
                  Vector3d(pose.x, pose.y, OutlineModel(object.mesh).middle()));
}

const PlanarPose kPoses[] = {{0.035, -0.02, 0.5}, {-0.03, 0.04, -1.1}};

/** Largest error of position [m] and direction, half-turns apart [rad], over kPoses. */
std::pair<double, double> FindWorstErrors(const std::shared_ptr<const Hand>& hand,
                                          const char* object_id, const CameraConfig& config) {
  const auto object = LoadObject(object_id);
  WristCamera camera(hand, object, config);
  const Eigen::VectorXd q = LoadStandardGrasps(*hand)[0].q_pre;
  double position = 0.0, direction = 0.0;
  for (const PlanarPose& pose : kPoses) {
    const Sighting found = camera.FindObject(MakeRest(*object, pose), q, "test");
    EXPECT_TRUE(found.is_found) << object_id << ": " << found.reason;
    position = std::max(position, std::hypot(found.pose.x - pose.x, found.pose.y - pose.y));
    direction = std::max(direction, std::abs(std::remainder(found.pose.yaw - pose.yaw, kPi)));
  }
  return {position, direction};
}

TEST(WristCameraTest, FindsTallFlatAndLongThings) {
  const auto hand = LoadShared("tum");
  for (const char* object : {"can", "cup", "pencil", "bunch_of_keys"}) {
    const auto [position, direction] = FindWorstErrors(hand, object, CameraConfig());
    EXPECT_LT(position, 0.001) << object;
    if (std::string(object) != "can") {
      EXPECT_LT(direction, RadFromDeg(1.0)) << object;
    }
  }
}

// A lens that bends straight lines by some twenty pixels, known to whoever calibrated it.
TEST(WristCameraTest, ABentLensIsUndone) {
  auto hand = std::make_shared<Hand>(LoadHand("tum"));
  hand->camera->k1 = -0.2;
  hand->camera->k2 = 0.03;
  const auto [position, direction] = FindWorstErrors(hand, "remote_control", CameraConfig());
  EXPECT_LT(position, 0.001);
  EXPECT_LT(direction, RadFromDeg(1.0));
}

// The mounts: in no pre-grasp does any part of the hand come between the camera and the table.
TEST(WristCameraTest, NoHandIsInItsOwnPicture) {
  const auto object = LoadObject("toy_cube");
  for (const char* id : {"tum", "shadow"}) {
    const auto hand = LoadShared(id);
    WristCamera camera(hand, object, CameraConfig());
    const Pose X_WK = camera.CalcLookPose({});
    Renderer renderer(camera.lens().width, camera.lens().height);
    for (const Grasp& grasp : LoadStandardGrasps(*hand)) {
      const Scene scene = camera.MakeScene(X_WK, grasp.q_pre, nullptr);
      ASSERT_GT(scene.drawables.size(), 5u);
      const GeometryPicture picture = renderer.RenderGeometry(scene, camera.MakePinhole(X_WK));
      for (const int shown : picture.id) ASSERT_EQ(shown, GeometryPicture::kTable) << id;
    }
  }
}

// What differs from the empty table is what the picture of ids says to be the object.
TEST(WristCameraTest, TheRegionFoundIsTheObject) {
  const auto hand = LoadShared("tum");
  const auto object = LoadObject("cup");
  const Eigen::VectorXd q = LoadStandardGrasps(*hand)[0].q_pre;
  WristCamera camera(hand, object, CameraConfig());
  const Pose X_WK = camera.CalcLookPose({}), X_WO = MakeRest(*object, kPoses[0]);
  const uint64_t seed = 3;
  const Scene scene = camera.MakeScene(X_WK, q, &X_WO);
  const auto regions = LoadPictureTools().find_regions(
      camera.TakePicture(scene, X_WK, &seed),
      camera.TakePicture(camera.MakeScene(X_WK, q, nullptr), X_WK, nullptr), DifferenceRule());
  ASSERT_FALSE(regions.empty());
  Renderer renderer(camera.lens().width, camera.lens().height);
  const GeometryPicture truth = renderer.RenderGeometry(scene, camera.MakePinhole(X_WK));
  const int cup = static_cast<int>(scene.drawables.size()) - 1;
  const double area = static_cast<double>(std::count(truth.id.begin(), truth.id.end(), cup));
  EXPECT_NEAR(regions[0].area, area, 1.0 * regions[0].contour.size());  // a pixel along the outline
}

// One picture of the empty table serves for all: what is found is, to the last bit, what both looks
// find with pictures of the whole scene, hand and all, each with its own empty table.
TEST(WristCameraTest, ThePictureOfTheEmptyTableServesEverywhere) {
  for (const char* id : {"tum", "shadow"}) {
    const auto hand = LoadShared(id);
    const auto object = LoadObject("board_marker");
    const Eigen::VectorXd q = LoadStandardGrasps(*hand)[0].q_pre;
    WristCamera camera(hand, object, CameraConfig());
    const OutlineModel outline(object->mesh);
    for (const PlanarPose& pose : kPoses) {
      const Pose X_WO = MakeRest(*object, pose);
      RandomStream noise("whole", "camera noise");
      PlanarPose supposed;
      for (int look = 0; look < 2; ++look) {
        const Pose X_WK = camera.CalcLookPose(supposed);
        const uint64_t seed = noise.NextBits();
        supposed =
            LocateObject(camera.TakePicture(camera.MakeScene(X_WK, q, &X_WO), X_WK, &seed),
                         camera.TakePicture(camera.MakeScene(X_WK, q, nullptr), X_WK, nullptr),
                         camera.lens(), X_WK, outline, supposed)
                .pose;
      }
      const Sighting found = camera.FindObject(X_WO, q, "whole");
      EXPECT_EQ(found.pose.x, supposed.x) << id;
      EXPECT_EQ(found.pose.y, supposed.y) << id;
      EXPECT_EQ(found.pose.yaw, supposed.yaw) << id;
    }
  }
}

TEST(WristCameraTest, ThePictureDependsOnItsNameAlone) {
  const auto hand = LoadShared("tum");
  const auto object = LoadObject("matchbox");
  const Eigen::VectorXd q = LoadStandardGrasps(*hand)[0].q_pre;
  WristCamera camera(hand, object, CameraConfig());
  const Pose X_WO = MakeRest(*object, kPoses[0]);
  const Sighting a = camera.FindObject(X_WO, q, "a"), b = camera.FindObject(X_WO, q, "b");
  const Sighting again = WristCamera(hand, object, CameraConfig()).FindObject(X_WO, q, "a");
  EXPECT_EQ(a.pose.x, again.pose.x);
  EXPECT_EQ(a.pose.yaw, again.pose.yaw);
  EXPECT_NE(a.pose.x, b.pose.x);
}

TEST(WristCameraTest, WhatTowersUpToTheCameraIsRefused) {
  const auto hand = LoadShared("tum");
  const auto object = LoadObject("can");
  CameraConfig config;
  config.look_height = 0.16;
  WristCamera camera(hand, object, config);
  const Sighting found =
      camera.FindObject(MakeRest(*object, {}), LoadStandardGrasps(*hand)[0].q_pre, "test");
  EXPECT_FALSE(found.is_found);
  EXPECT_EQ(found.reason,
            "the camera looks from 160 mm above the table; the object is 116 mm high");
}

TEST(WristCameraTest, AHandWithoutCameraIsAnError) {
  try {
    WristCamera camera(LoadShared("tum-original"), LoadObject("can"), CameraConfig());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUnsupported);
    EXPECT_NE(std::string(error.what()).find("\"tum-original\" has no camera"), std::string::npos);
  }
}

}  // namespace
}  // namespace graspbench
