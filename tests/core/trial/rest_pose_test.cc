#include "core/trial/rest_pose.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "core/base/files/files.h"
#include "core/base/random.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/physics/table_support.h"
#include "core/shape/primitives.h"
#include "core/shape/resting_pose.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

struct Motion {
  double shift = 0.0;  // [m]
  double turn = 0.0;   // [rad]
};

Pose SetDown(const GraspObject& object) {
  Pose X_WO = Pose::Identity();
  X_WO.translation().z() = -TableSupport(object.mesh).CalcLowestPoint(X_WO);
  return X_WO;
}

/** The farthest that the object goes from there in two seconds. */
Motion MoveOnTable(const GraspObject& object, const Pose& X_WO) {
  SmallWorld scene(object, SimConfig());
  scene.start().R_WO = X_WO.linear();
  scene.start().p_WOcm = X_WO * object.mass_properties.p_OOcm;
  scene.Reset();
  Motion farthest;
  for (double time = 0.0; time < 2.0; time += SimConfig().step) {
    scene.Step();
    const Pose moved = scene.world().CalcObjectPose();
    farthest.shift = std::max(farthest.shift, (moved.translation() - X_WO.translation()).norm());
    farthest.turn = std::max(farthest.turn,
                             Eigen::AngleAxisd(X_WO.linear().transpose() * moved.linear()).angle());
  }
  return farthest;
}

void ExpectRests(const GraspObject& object, const std::string& name) {
  const Motion motion =
      MoveOnTable(object, FindRestPose(object, SimConfig()).value_or(SetDown(object)));
  EXPECT_LT(motion.shift, 5e-5) << name;
  EXPECT_LT(motion.turn, 1e-3) << name;
}

GraspObject MakeAtRest(TriMesh mesh, double mass) {
  GraspObject object;
  object.mesh = std::move(mesh);
  object.mass_properties = CalcSolidMassProperties(object.mesh, mass);
  LayDown(object);
  return MakeSolid(object.mesh, mass, 0.5, 0.4);
}

TEST(RestPoseTest, MadeUpShapesStayWhereTheyAreSetDown) {
  RandomStream stream("resting object", "shapes");
  for (int k = 0; k < 12; ++k) {
    TriMesh lump = MakeSphere(stream.NextUniform(0.015, 0.04), 16);
    for (Vector3d& p : lump.vertices) {
      p *= stream.NextUniform(0.93, 1.07);
      p.z() *= 0.6;
    }
    ExpectRests(MakeAtRest(lump, stream.NextUniform(0.02, 0.4)), "lump " + std::to_string(k));
  }
  for (const double tilt : {0.02, 0.5, 1.4}) {
    TriMesh brick = MakeRoundedBox(Vector3d(0.08, 0.05, 0.03), 0.002, 2);
    for (Vector3d& p : brick.vertices) {
      p = Eigen::AngleAxisd(tilt, Vector3d(1.0, 0.4, 0.0).normalized()) * p;
    }
    ExpectRests(MakeAtRest(brick, 0.1), "brick");
  }
}

// Without being laid down the same shapes move: the test can fail.
TEST(RestPoseTest, AShapeThatIsNotLaidDownRocks) {
  TriMesh brick = MakeRoundedBox(Vector3d(0.08, 0.05, 0.03), 0.002, 2);
  for (Vector3d& p : brick.vertices) p = Eigen::AngleAxisd(0.02, Vector3d::UnitX()) * p;
  const GraspObject object = MakeSolid(brick, 0.1, 0.5, 0.4);
  EXPECT_GT(MoveOnTable(object, SetDown(object)).turn, 0.015);
  // Let go alone it finds the same as by geometry: flat, 20 mrad from how it lies.
  const Pose rest = FindRestPose(object, SimConfig()).value();
  EXPECT_NEAR(Eigen::AngleAxisd(rest.linear()).angle(), 0.02, 5e-4);
}

TEST(RestPoseTest, ScansStayWhereTheyAreSetDown) {
  const char* root = std::getenv("GRASPBENCH_DATA");
  const fs::path folder =
      (root != nullptr && *root != '\0' ? fs::path(root)
                                        : FindDataRoot().parent_path() / "shared" / "data") /
      "objects";
  if (!fs::exists(folder)) {
    GTEST_SKIP() << "no objects at " << folder << "; GRASPBENCH_DATA names the folder above";
  }
  int num_turned = 0;
  for (const char* id :
       {"002_master_chef_can", "003_cracker_box", "005_tomato_soup_can", "011_banana", "016_pear",
        "021_bleach_cleanser", "048_hammer", "065-d_cups"}) {
    const auto scan = LoadObject((folder / id).string());
    num_turned += scan->turned_to_rest > 0.0;
    ExpectRests(*scan, id);
  }
  EXPECT_EQ(num_turned, 8);
}

// The middle of each of two balls lies beside that of the spot it stands on: it rolls, and is then
// at rest.
TEST(RestPoseTest, TheCatalogueLiesAsItRestsButForTwoBalls) {
  for (const std::string& id : ListObjects()) {
    const auto object = LoadObject(id);
    EXPECT_EQ(object->turned_to_rest, 0.0) << id;
    const bool rolls = id == "tennis_ball" || id == "paper_ball";
    EXPECT_EQ(FindRestPose(*object, SimConfig()).has_value(), rolls) << id;
    if (rolls) ExpectRests(*object, id);
  }
}

}  // namespace
}  // namespace graspbench
