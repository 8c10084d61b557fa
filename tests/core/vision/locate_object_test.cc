#include "core/vision/locate_object.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/shape/primitives.h"
#include "core/vision/wrist_camera.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

const Vector3f kTable(0.7f, 0.3f, 0.6f);
const Vector3f kWhite(0.8f, 0.8f, 0.8f);

Lens MakeTestLens() {
  Lens lens;
  lens.width = 320;
  lens.height = 240;
  lens.focal_x = lens.focal_y = 290.0;
  lens.centre_x = 160.0;
  lens.centre_y = 120.0;
  return lens;
}

// Looks down from 0.4 m, its picture turned by half a radian.
Pose MakeTestView() { return MakePose(MakeRotationRpy(kPi, 0.0, 0.5), Vector3d(0.01, -0.02, 0.4)); }

Drawable MakeThing(const TriMesh& mesh, const PlanarPose& pose, const Vector3f& colour) {
  Drawable thing;
  thing.mesh = std::make_shared<const TriMesh>(mesh);
  thing.X_WM = MakePose(MakeRotationRpy(0.0, 0.0, pose.yaw),
                        Vector3d(pose.x, pose.y, OutlineModel(mesh).middle()));
  thing.colour = colour;
  return thing;
}

Image Draw(const std::vector<Drawable>& things) {
  Scene scene;
  scene.drawables = things;
  scene.has_grid = false;
  scene.table_srgb = kTable;
  PinholeCamera camera;
  camera.X_WK = MakeTestView();
  camera.focal_x = camera.focal_y = 290.0;
  camera.centre_x = 160.0;
  camera.centre_y = 120.0;
  static Renderer renderer(320, 240, RenderQuality::kFast);
  return renderer.Render(scene, camera);
}

Sighting Locate(const std::vector<Drawable>& things, const TriMesh& wanted) {
  return LocateObject(Draw(things), Draw({}), MakeTestLens(), MakeTestView(), OutlineModel(wanted),
                      PlanarPose());
}

const TriMesh& Box() {
  static const TriMesh box = MakeRoundedBox(Vector3d(0.1, 0.05, 0.08), 0.0);
  return box;
}

// Tall, beside the picture's middle: its top alone would be off by 6 mm.
TEST(LocateObjectTest, ATallBoxBesideTheMiddleIsFound) {
  for (const PlanarPose& pose :
       {PlanarPose{0.03, 0.02, 0.4}, PlanarPose{-0.04, -0.03, -1.0}, PlanarPose{0.0, 0.04, 1.5}}) {
    const Sighting found = Locate({MakeThing(Box(), pose, kWhite)}, Box());
    ASSERT_TRUE(found.is_found) << found.reason;
    EXPECT_NEAR(found.pose.x, pose.x, 5e-4);
    EXPECT_NEAR(found.pose.y, pose.y, 5e-4);
    EXPECT_NEAR(std::remainder(found.pose.yaw - pose.yaw, kPi), 0.0, RadFromDeg(0.7));
    EXPECT_EQ(found.direction, KnownDirection::kHalfTurns);
    EXPECT_GT(found.length, 0.1);  // its top is nearer than its middle
    EXPECT_LT(found.length, 0.125);
  }
}

TEST(LocateObjectTest, NothingIsGuessed) {
  const Vector3f cloth(0.448f, 0.073f, 0.319f);  // kTable, decoded
  const TriMesh cover = MakeRoundedBox(Vector3d(0.08, 0.08, 0.17), 0.0);
  const struct {
    std::vector<Drawable> things;
    std::string reason;  // a part of it
  } cases[] = {
      {{}, "no difference from the empty table is visible"},
      {{MakeThing(Box(), {0.2, 0.0, 0.0}, kWhite)}, "what is seen reaches over the picture's edge"},
      {{MakeThing(Box(), {0.05, 0.05, 0.0}, kWhite),
        MakeThing(MakeSphere(0.015), {-0.05, -0.05, 0.0}, kWhite)},
       "more than one thing is seen on the table"},
      {{MakeThing(MakeSphere(0.03), {0.02, 0.0, 0.0}, kWhite)},
       "has not the outline of the object"},
      // Half of it is under something of the table's colour; it has that colour itself.
      {{MakeThing(Box(), {}, kWhite), MakeThing(cover, {0.06, 0.0, 0.0}, cloth)}, " "},
      {{MakeThing(Box(), {0.02, 0.0, 0.3}, cloth)}, " "},
  };
  for (const auto& refused : cases) {
    const Sighting found = Locate(refused.things, Box());
    EXPECT_FALSE(found.is_found) << refused.reason;
    EXPECT_NE(found.reason.find(refused.reason), std::string::npos) << found.reason;
  }
}

Sighting MakeSighting(double length, double width, double fill) {
  Sighting seen;
  seen.is_found = true;
  seen.length = length;
  seen.width = width;
  seen.fill = fill;
  return seen;
}

TEST(SuggestGraspTest, LargeAndRoundSmallOrThinAndTheRest) {
  EXPECT_EQ(SuggestGraspType(MakeSighting(0.07, 0.07, 1.0)), GraspType::kPower);
  EXPECT_EQ(SuggestGraspType(MakeSighting(0.07, 0.07, 0.5)), GraspType::kAllFingerPrecision);
  EXPECT_EQ(SuggestGraspType(MakeSighting(0.16, 0.07, 1.0)), GraspType::kAllFingerPrecision);
  EXPECT_EQ(SuggestGraspType(MakeSighting(0.12, 0.01, 1.0)), GraspType::kTwoFingerPrecision);
  EXPECT_EQ(SuggestGraspType(MakeSighting(0.25, 0.01, 1.0)), GraspType::kAllFingerPrecision);
  EXPECT_EQ(SuggestGraspType(MakeSighting(0.03, 0.03, 1.0)), GraspType::kTwoFingerPrecision);
}

// What the table of objects chooses (grasp_order), seen in three places by the camera with its
// noise.
TEST(SuggestGraspTest, AgreesWithTheTableButForTheMatchbox) {
  const auto hand = std::make_shared<const Hand>(LoadHand("tum"));
  const Eigen::VectorXd q = LoadStandardGrasps(*hand)[0].q_pre;
  const PlanarPose poses[] = {{0.0, 0.0, 0.0}, {0.03, -0.02, 0.7}, {-0.035, 0.03, -1.2}};
  for (const std::string& id : ListObjects()) {
    const auto object = LoadObject(id);
    WristCamera camera(hand, object, CameraConfig());
    GraspType wanted = FindGraspTaxon(object->grasp_order.front()).type;
    if (id == "matchbox") wanted = GraspType::kAllFingerPrecision;  // as large as a bunch of keys
    for (const PlanarPose& pose : poses) {
      const Pose X_WO =
          MakePose(MakeRotationRpy(0.0, 0.0, pose.yaw),
                   Eigen::Vector3d(pose.x, pose.y, OutlineModel(object->mesh).middle()));
      const Sighting seen = camera.FindObject(X_WO, q, "type");
      ASSERT_TRUE(seen.is_found) << id << ": " << seen.reason;
      EXPECT_EQ(static_cast<int>(SuggestGraspType(seen)), static_cast<int>(wanted))
          << id << ": " << MmFromM(seen.length) << " x " << MmFromM(seen.width) << " mm, fill "
          << seen.fill;
    }
  }
}

}  // namespace
}  // namespace graspbench
