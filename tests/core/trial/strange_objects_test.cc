// Objects that the catalogue does not hold, in every standard grasp of both hands: too tall, too
// heavy, too light, too small, too flat. Few are held; those that are must be held as a real hand
// would hold them, judged from what the trial reports and not by its own gate.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "core/base/units.h"
#include "core/trial/trial_runner.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

constexpr double kMu = 0.5;

std::shared_ptr<const GraspObject> MakeStrange(const std::string& id, const TriMesh& mesh,
                                               double mass) {
  GraspObject object = MakeSolid(mesh, mass, kMu, 0.9 * kMu);
  object.id = id;
  return std::make_shared<const GraspObject>(object);
}

std::shared_ptr<const GraspObject> MakeCylinder(double height, double mass) {
  const double r = 0.025, z = 0.5 * height;
  return MakeStrange("cylinder of " + std::to_string(std::lround(MmFromM(height))) + " mm",
                     MakeRevolution({{0.0, -z}, {r, -z}, {r, z}, {0.0, z}}, 48), mass);
}

std::shared_ptr<const GraspObject> MakeBox(const std::string& id, const Eigen::Vector3d& size,
                                           double mass) {
  return MakeStrange(id, MakeRoundedBox(size, 0.0), mass);
}

class StrangeObjects : public testing::Test {
 protected:
  /** Every standard grasp of both hands once. @returns how many hold. */
  int Try(const std::shared_ptr<const GraspObject>& object) {
    int num_held = 0;
    for (const char* id : {"tum", "shadow"}) {
      const auto hand = std::make_shared<const Hand>(LoadHand(id));
      TrialRunner runner(hand, object);
      for (const Grasp& grasp : LoadStandardGrasps(*hand)) {
        const TrialResult result = runner.Run(MakeSetup(hand, grasp.id, object));
        const std::string name = object->id + ", " + id + " " + grasp.id;
        EXPECT_NE(result.outcome, Outcome::kNumericalFailure) << name << ": " << result.reason;
        if (result.outcome != Outcome::kSuccess) continue;
        ++num_held;
        CheckHeld(name, *hand, *object, result);
      }
    }
    std::cout << object->id << ": " << num_held << " of 10 grasps hold\n";
    return num_held;
  }

  static void CheckHeld(const std::string& name, const Hand& hand, const GraspObject& object,
                        const TrialResult& result) {
    EXPECT_LT(result.worst_penetration, 0.001) << name;
    EXPECT_LT(std::abs(result.energy_residual), 0.001) << name;
    EXPECT_LT(result.hold_creep, 0.001) << name;
    // Coulomb: contacts carry at most their normal force times sqrt(1 + mu^2).
    const double weight = object.mass_properties.mass * kStandardGravity;
    const double normal_force = result.stability.hold.normal_force;
    EXPECT_GT(normal_force * std::sqrt(1.0 + kMu * kMu), weight) << name;
    // All drives at their limits with levers of 10 mm, and as much again for what reacts.
    double torque = 0.0;
    for (const HandJoint& joint : hand.joints) torque += joint.drive.torque_limit;
    EXPECT_LT(normal_force, 2.0 * torque / 0.01) << name;
    EXPECT_LT(normal_force, 150.0) << name;
  }
};

TEST_F(StrangeObjects, TallCylindersAreHeldWithHandsOutsideThem) {
  int num_held = 0;
  for (const double height : {0.12, 0.14, 0.16, 0.18, 0.2, 0.225, 0.25}) {
    num_held += Try(MakeCylinder(height, 0.3));
  }
  EXPECT_GT(num_held, 7);  // a can of 120 mm is no hard object
}

TEST_F(StrangeObjects, NoHandLiftsFiveKilograms) { EXPECT_EQ(Try(MakeCylinder(0.12, 5.0)), 0); }

TEST_F(StrangeObjects, AGramIsHeldOrBlownAsideButNeverPressedInto) {
  Try(MakeCylinder(0.12, 0.001));
}

TEST_F(StrangeObjects, APlateOnTheTableCannotBeHeldAround) {
  EXPECT_EQ(Try(MakeBox("plate", {0.3, 0.3, 0.002}, 0.2)), 0);
}

TEST_F(StrangeObjects, ThingsOfAFewMillimetres) {
  Try(MakeBox("cube of 3 mm", Eigen::Vector3d::Constant(0.003), 1e-4));
  Try(MakeBox("cube of 8 mm", Eigen::Vector3d::Constant(0.008), 1e-3));
}

TEST_F(StrangeObjects, ACubeWiderThanTheHandCannotBeHeld) {
  EXPECT_EQ(Try(MakeBox("cube of 300 mm", Eigen::Vector3d::Constant(0.3), 1.0)), 0);
}

}  // namespace
}  // namespace graspbench
