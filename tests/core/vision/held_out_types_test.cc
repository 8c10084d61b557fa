// The rule of SuggestGraspType on things that it was not chosen on, as the camera sees them.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "core/base/files/files.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/shape/primitives.h"
#include "core/vision/locate_object.h"
#include "core/vision/wrist_camera.h"
#include "objects/catalogue.h"
#include "tests/core/vision/held_out_things.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

std::shared_ptr<const GraspObject> MakeThing(const HeldOutThing& thing) {
  auto object = std::make_shared<GraspObject>();
  object->id = object->name = thing.name;
  object->size = 0.001 * Vector3d(thing.length_mm, thing.width_mm, thing.height_mm);
  const Vector3d half = 0.5 * object->size;
  switch (thing.shape) {
    case HeldOutShape::kBox:
      object->mesh = MakeRoundedBox(object->size, std::min(0.001, 0.4 * object->size.minCoeff()));
      break;
    case HeldOutShape::kBall:
      object->mesh = MakeSphere(half.x());
      break;
    case HeldOutShape::kStanding:
      object->mesh = MakeRevolution(
          {{0.0, -half.z()}, {half.x(), -half.z()}, {half.x(), half.z()}, {0.0, half.z()}});
      break;
    case HeldOutShape::kLying:
      object->mesh = MakeRevolution(
          {{0.0, -half.x()}, {half.z(), -half.x()}, {half.z(), half.x()}, {0.0, half.x()}});
      for (Vector3d& vertex : object->mesh.vertices) {  // a turn about y
        vertex = Vector3d(vertex.z(), vertex.y(), -vertex.x());
      }
      break;
  }
  return object;
}

/** The number of the type suggested for the thing at a place off the picture's middle, as the
thesis counts them, and 0 for what is not found. */
int SeeType(const std::shared_ptr<const GraspObject>& object) {
  static const auto hand = std::make_shared<const Hand>(LoadHand("tum"));
  static const Eigen::VectorXd q = LoadStandardGrasps(*hand)[0].q_pre;
  WristCamera camera(hand, object, CameraConfig());
  const Pose X_WO = MakePose(MakeRotationRpy(0.0, 0.0, 0.7),
                             Vector3d(0.03, -0.02, OutlineModel(object->mesh).middle()));
  const Sighting seen = camera.FindObject(X_WO, q, "held out");
  if (!seen.is_found) return 0;
  switch (SuggestGraspType(seen)) {
    case GraspType::kAllFingerPrecision:
      return 1;
    case GraspType::kTwoFingerPrecision:
      return 2;
    case GraspType::kPower:
      return 3;
    case GraspType::kTwoFingerPinch:
      return 4;
  }
  return -1;
}

// What is missed stands here by name, so that the figure in the validation rows was measured.
TEST(HeldOutTypesTest, OfGeneratedThings) {
  std::set<std::string> missed;
  for (const HeldOutThing& thing : kHeldOutThings) {
    const int type = SeeType(MakeThing(thing));
    if (type != thing.type) {
      missed.insert(std::string(thing.name) + ": " + std::to_string(type) + " for " +
                    std::to_string(thing.type));
    }
  }
  const std::set<std::string> known = {
      // A box of this outline is taken for roundish, whatever its height.
      "audio cassette: 3 for 1", "bar of soap: 3 for 1", "deck of cards: 3 for 1",
      "pack of cigarettes: 3 for 1",
      // That it is thin is seen of its width only, and not of what is longer than 200 mm.
      "candle: 1 for 2", "chopstick: 1 for 2", "compact disc: 3 for 2", "domino: 1 for 2",
      "ruler: 1 for 2",
      // Beside a limit.
      "film canister: 2 for 1", "tea box: 1 for 3"};
  EXPECT_EQ(missed, known);
}

TEST(HeldOutTypesTest, OfScannedObjects) {
  const char* root = std::getenv("GRASPBENCH_DATA");
  const std::filesystem::path folder =
      (root != nullptr && *root != '\0' ? std::filesystem::path(root)
                                        : FindDataRoot().parent_path() / "shared" / "data") /
      "objects";
  if (!std::filesystem::exists(folder)) {
    GTEST_SKIP() << "no objects at " << folder << "; GRASPBENCH_DATA names the folder above";
  }
  std::set<std::string> missed;
  for (const HeldOutScan& scan : kHeldOutScans) {
    const int type = SeeType(LoadObject((folder / scan.folder).string(), FieldUse::kLater));
    if (type != scan.type) {
      missed.insert(std::string(scan.folder) + ": " + std::to_string(type) + " for " +
                    std::to_string(scan.type));
    }
  }
  const std::set<std::string> known = {
      "003_cracker_box: 0 for 3",  // 210 mm tall: reaches over the picture's edge
      "048_hammer: 1 for 3"};      // that it is heavy is not seen
  EXPECT_EQ(missed, known);
}

}  // namespace
}  // namespace graspbench
