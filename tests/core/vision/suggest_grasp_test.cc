#include "core/vision/suggest_grasp.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/vision/wrist_camera.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

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
