// The engine outside its comfortable range: light and heavy, slippery and sticky, soft and stiff,
// fine and coarse steps, all objects of the catalogue and shapes nobody should grasp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/base/units.h"
#include "core/trial/trial_runner.h"
#include "objects/catalogue.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMasses[] = {0.001, 0.02, 0.3, 2.0};
constexpr double kFrictions[] = {0.05, 0.3, 0.8, 1.5};
constexpr double kStiffnesses[] = {2.5e4, 1e5, 3e5, 1e6};
constexpr double kSteps[] = {0.0005, 0.001, 0.002, 0.004};
/** In a steady hold with at least the default stiffness [m]. */
constexpr double kMostPenetration = 3e-4;
constexpr double kDefaultStiffness = 1e5;
/** Share of steps whose friction limits may stay unsettled; every one is counted. Nearly all are of
a cube of 0.3 m, on which the arm sets a hand that cannot span it. */
constexpr double kMostUnconverged = 2e-3;

struct Tally {
  int num_trials = 0, num_held = 0, num_unconverged = 0;
  int64_t num_steps = 0;
  double deepest_hold = 0.0, largest_creep = 0.0, largest_residual = 0.0;
  std::string least_explained;  // the trial with the largest residual
};

/** A trial that must end in an outcome, with finite figures. */
void Check(const std::string& name, const TrialSetup& setup, TrialRunner& runner, Tally& tally) {
  SCOPED_TRACE(name);
  const TrialResult result = runner.Run(setup);
  EXPECT_NE(result.outcome, Outcome::kNumericalFailure) << result.reason;
  EXPECT_TRUE(std::isfinite(result.energy_residual));
  EXPECT_TRUE(std::isfinite(result.worst_penetration));
  for (const SceneSnapshot& snapshot : result.snapshots) {
    EXPECT_TRUE(snapshot.q.allFinite() && snapshot.X_WO.matrix().allFinite());
  }
  ++tally.num_trials;
  tally.num_steps += result.num_steps;
  tally.num_unconverged += result.num_unconverged;
  if (std::abs(result.energy_residual) > tally.largest_residual) {
    tally.largest_residual = std::abs(result.energy_residual);
    tally.least_explained = name;
  }
  if (result.outcome != Outcome::kSuccess) return;
  ++tally.num_held;
  tally.largest_creep = std::max(tally.largest_creep, result.hold_creep);
  if (setup.sim.contact_stiffness < kDefaultStiffness) return;
  EXPECT_LT(result.steady_penetration, kMostPenetration);
  tally.deepest_hold = std::max(tally.deepest_hold, result.steady_penetration);
}

void PrintAndCheck(const std::string& what, const Tally& tally) {
  std::cout << what << ": " << tally.num_trials << " trials, " << tally.num_held << " held, "
            << tally.num_steps << " steps, " << tally.num_unconverged
            << " unconverged; deepest steady penetration " << MmFromM(tally.deepest_hold)
            << " mm, largest creep " << MmFromM(tally.largest_creep)
            << " mm, largest energy residual " << tally.largest_residual << " J ("
            << tally.least_explained << ")\n";
  EXPECT_LT(tally.num_unconverged, kMostUnconverged * static_cast<double>(tally.num_steps));
}

/** The object with another mass and friction. */
std::shared_ptr<const GraspObject> Change(GraspObject object, double mass, double mu) {
  object.mass_properties.I_OOcm *= mass / object.mass_properties.mass;
  object.mass_properties.mass = mass;
  object.surface.friction_static = mu;
  object.surface.friction_dynamic = 0.9 * mu;
  return std::make_shared<const GraspObject>(object);
}

std::string FindGrasp(const Hand& hand, const GraspObject& object) {
  const auto best = object.best_grasp.find(hand.id);
  return best == object.best_grasp.end() ? object.grasp_order.front() : best->second;
}

class RobustnessTest : public testing::TestWithParam<const char*> {
 protected:
  std::shared_ptr<const Hand> hand_ = std::make_shared<const Hand>(LoadHand(GetParam()));
};

// Every value of every range meets every object; which values meet each other changes from object
// to object.
TEST_P(RobustnessTest, AllObjectsOverTheRangesOfMassFrictionStiffnessAndStep) {
  Tally tally;
  int shift = 0;
  for (const std::string& id : ListObjects()) {
    const std::shared_ptr<const GraspObject> object = LoadObject(id);
    for (int i = 0; i < 4; ++i) {
      const double mass = kMasses[i], mu = kFrictions[(i + shift) % 4];
      const double stiffness = kStiffnesses[(i + shift / 4) % 4];
      const double step = kSteps[(i + shift / 2) % 4];
      const std::string name = id + ", " + std::to_string(mass) + " kg, mu " + std::to_string(mu) +
                               ", k " + std::to_string(stiffness) + ", step " +
                               std::to_string(step);
      TrialSetup setup = MakeSetup(hand_, FindGrasp(*hand_, *object), Change(*object, mass, mu));
      setup.sim.contact_stiffness = setup.sim.tangential_stiffness = stiffness;
      setup.sim.step = step;
      TrialRunner runner(setup.hand, setup.object);
      Check(name, setup, runner, tally);
    }
    ++shift;
  }
  PrintAndCheck(std::string("catalogue, ") + GetParam(), tally);
}

struct NamedMesh {
  std::string name;
  TriMesh mesh;
};

TriMesh MakeTorus(double radius, double tube) {
  std::vector<Ring> rings;
  for (int i = 0; i < 48; ++i) {
    const double a = 2.0 * kPi * i / 48;
    Ring ring;
    for (int k = 0; k < 16; ++k) {
      const double b = 2.0 * kPi * k / 16, r = radius + tube * std::cos(b);
      ring.emplace_back(r * std::cos(a), r * std::sin(a), tube * std::sin(b));
    }
    std::reverse(ring.begin(), ring.end());
    rings.push_back(ring);
  }
  return MakeLoft(rings, LoftEnds::kJoined);
}

/** Five points, 30 mm and 12 mm from the axis. */
TriMesh MakeStar(double height) {
  std::vector<Ring> rings(2);
  for (int i = 0; i < 10; ++i) {
    const double radius = i % 2 == 0 ? 0.03 : 0.012, angle = kPi * i / 5;
    const Vector2d p(radius * std::cos(angle), radius * std::sin(angle));
    rings[0].emplace_back(p.x(), p.y(), -0.5 * height);
    rings[1].emplace_back(p.x(), p.y(), 0.5 * height);
  }
  return MakeLoft(rings);
}

/** A ball with bumps. */
TriMesh MakeBumpyBall() {
  TriMesh mesh = MakeSphere(0.03, 64);
  for (Vector3d& p : mesh.vertices) {
    p *= 1.0 + 0.1 * std::sin(400.0 * p.x()) * std::sin(400.0 * p.y()) * std::sin(400.0 * p.z());
  }
  return mesh;
}

std::vector<NamedMesh> MakeUglyMeshes() {
  const auto box = [](double x, double y, double z) {
    return MakeRoundedBox(Vector3d(x, y, z), 0.0);
  };
  return {
      {"thin plate", box(0.1, 0.1, 0.001)},
      {"plate on edge", box(0.08, 0.0015, 0.06)},
      {"needle", box(0.15, 0.001, 0.001)},
      {"cube of 1 mm", box(0.001, 0.001, 0.001)},
      {"beam of 0.5 m", box(0.5, 0.03, 0.03)},
      {"cube of 0.3 m", box(0.3, 0.3, 0.3)},
      {"torus", MakeTorus(0.03, 0.01)},
      {"star", MakeStar(0.04)},
      {"cone", MakeRevolution({Vector2d(0, -0.03), Vector2d(0.03, -0.03), Vector2d(0, 0.03)})},
      {"hourglass", MakeRevolution({Vector2d(0, -0.03), Vector2d(0.03, -0.03), Vector2d(0.004, 0),
                                    Vector2d(0.03, 0.03), Vector2d(0, 0.03)})},
      {"bumpy ball", MakeBumpyBall()},
      {"ball of 200,000 triangles", MakeSphere(0.03, 450)},
  };
}

TEST_P(RobustnessTest, UglyMeshes) {
  Tally tally;
  for (const NamedMesh& ugly : MakeUglyMeshes()) {
    const auto object = std::make_shared<const GraspObject>(MakeSolid(ugly.mesh, 0.02, 0.6, 0.5));
    TrialRunner runner(hand_, object);
    for (const char* grasp : {"g1", "g2", "g3"}) {
      for (double step : {0.0005, 0.002, 0.004}) {
        const std::string name = ugly.name + ", " + grasp + ", step " + std::to_string(step);
        TrialSetup setup = MakeSetup(hand_, grasp, object);
        setup.sim.step = step;
        Check(name, setup, runner, tally);
      }
    }
  }
  PrintAndCheck(std::string("ugly meshes, ") + GetParam(), tally);
}

/** A trial that holds must hold as a real hand would, judged from what it reports and not by its own
gate. */
void CheckHeld(const Hand& hand, const GraspObject& object, const TrialResult& result) {
  EXPECT_LT(result.worst_penetration, 0.001);
  EXPECT_LT(std::abs(result.energy_residual), 0.001);
  EXPECT_LT(result.hold_creep, 0.001);
  // Coulomb: contacts carry at most their normal force times sqrt(1 + mu^2).
  const double weight = object.mass_properties.mass * kStandardGravity;
  const double normal_force = result.stability.hold.normal_force;
  EXPECT_GT(normal_force * std::hypot(1.0, object.surface.friction_static), weight);
  // All drives at their limits with levers of 10 mm, and as much again for what reacts.
  double torque = 0.0;
  for (const HandJoint& joint : hand.joints) torque += joint.drive.torque_limit;
  EXPECT_LT(normal_force, std::min(150.0, 2.0 * torque / 0.01));
}

/** How many of all standard grasps of both hands hold. */
int TryAllGrasps(const TriMesh& mesh, double mass) {
  const auto object = std::make_shared<const GraspObject>(MakeSolid(mesh, mass, 0.5, 0.45));
  int num_held = 0;
  for (const char* id : {"tum", "shadow"}) {
    const auto hand = std::make_shared<const Hand>(LoadHand(id));
    TrialRunner runner(hand, object);
    for (const Grasp& grasp : LoadStandardGrasps(*hand)) {
      SCOPED_TRACE(std::string(id) + " " + grasp.id);
      const TrialResult result = runner.Run(MakeSetup(hand, grasp.id, object));
      EXPECT_NE(result.outcome, Outcome::kNumericalFailure) << result.reason;
      if (result.outcome != Outcome::kSuccess) continue;
      ++num_held;
      CheckHeld(*hand, *object, result);
    }
  }
  return num_held;
}

TriMesh MakeCylinder(double height) {
  const double r = 0.025, z = 0.5 * height;
  return MakeRevolution({{0.0, -z}, {r, -z}, {r, z}, {0.0, z}}, 48);
}

// Too tall, too heavy, too light, too small, too flat: few are held.
TEST(StrangeObjects, AreHeldAsARealHandWouldOrNotAtAll) {
  const auto cube = [](double side) { return MakeRoundedBox(Vector3d::Constant(side), 0.0); };
  int num_tall = 0;
  for (const double height : {0.12, 0.14, 0.16, 0.18, 0.2, 0.225, 0.25}) {
    SCOPED_TRACE(height);
    num_tall += TryAllGrasps(MakeCylinder(height), 0.3);
  }
  EXPECT_GT(num_tall, 7);  // a can of 120 mm is no hard object
  struct Strange {
    const char* name;
    TriMesh mesh;
    double mass;
    bool may_be_held;
  };
  const Strange things[] = {
      {"5 kg", MakeCylinder(0.12), 5.0, false},
      {"a gram", MakeCylinder(0.12), 0.001, true},
      {"plate on the table", MakeRoundedBox({0.3, 0.3, 0.002}, 0.0), 0.2, false},
      {"cube of 3 mm", cube(0.003), 1e-4, true},
      {"cube of 8 mm", cube(0.008), 1e-3, true},
      {"cube of 300 mm", cube(0.3), 1.0, false}};
  for (const Strange& thing : things) {
    SCOPED_TRACE(thing.name);
    const int num_held = TryAllGrasps(thing.mesh, thing.mass);
    std::cout << thing.name << ": " << num_held << " of 10 grasps hold\n";
    EXPECT_TRUE(num_held == 0 || thing.may_be_held);
  }
}

INSTANTIATE_TEST_SUITE_P(Hands, RobustnessTest, testing::Values("tum", "shadow"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace graspbench
