#include "core/trial/touch_sensors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/base/random.h"
#include "core/trial/protocols/protocol.h"
#include "core/trial/taxel_forces.h"
#include "objects/catalogue.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** A level square of 20 mm with points 0.5 mm apart, cut into four cells of 10 mm. */
SensedSurface MakeSquare() {
  SensedSurface surface;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      SurfacePoint point;
      point.p_L = Vector3d(5e-4 * (i - 19.5), 5e-4 * (j - 19.5), 0.0);
      point.area = 2.5e-7;
      point.element = (i < 20 ? 0 : 1) + (j < 20 ? 0 : 2);
      surface.points.push_back(point);
    }
  }
  return surface;
}

std::vector<double> Spread(const Vector3d& p, double force) {
  std::vector<double> forces(4, 0.0);
  SpreadForce(MakeSquare(), p, force, 0.004, forces);
  return forces;
}

double Sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// In the middle of four cells each has a quarter; at 5 N a patch of 4 mm radius that lies 4 mm from
// the border stays in one cell; what is clipped, or smaller than the points' spacing, keeps its sum.
TEST(TouchSensorsTest, APatchIsSharedByItsCells) {
  for (const double force : Spread(Vector3d::Zero(), 5.0)) EXPECT_NEAR(force, 1.25, 1e-12);
  EXPECT_NEAR(Spread(Vector3d(0.0045, 0.0045, 0.0), 5.0)[3], 5.0, 1e-12);
  EXPECT_NEAR(Sum(Spread(Vector3d(0.0098, -0.0098, 0.0), 5.0)), 5.0, 1e-12);
  EXPECT_NEAR(Spread(Vector3d(-0.003, 0.003, 0.0), 1e-6)[2], 1e-6, 1e-18);
}

// The share of Hertz's pressure beyond a line at distance d from the middle, in closed form:
// integral over x from d to a of (pi / 2)(a^2 - x^2) / a dx over (2 / 3) pi a^2
//   = (2 - 3 s + s^3) / 4,   s = d / a.
TEST(TouchSensorsTest, APatchHasHertzsPressure) {
  for (const double s : {0.0, 0.25, 0.5, 0.8}) {
    const std::vector<double> forces = Spread(Vector3d(-0.004 * s, 0.0, 0.0), 5.0);
    EXPECT_NEAR((forces[1] + forces[3]) / 5.0, (2.0 - 3.0 * s + s * s * s) / 4.0, 0.01) << s;
  }
  // A force eight times as small has half the radius.
  const std::vector<double> small = Spread(Vector3d(-0.001, 0.0, 0.0), 5.0 / 8.0);
  EXPECT_NEAR((small[1] + small[3]) / (5.0 / 8.0), (2.0 - 1.5 + 0.125) / 4.0, 0.02);
}

// On the hand itself: what the cells have sums to the force, wherever it presses and however much.
TEST(TouchSensorsTest, TheCellsOfTheHandSumToTheForce) {
  const auto skin = LoadHand("shadow").skin;
  RandomStream random("touch", "places");
  for (int i = 0; i < 300; ++i) {
    const SensedSurface& surface = skin->surfaces[static_cast<size_t>(
        random.NextIndex(static_cast<int>(skin->surfaces.size())))];
    const SurfacePoint& point =
        surface
            .points[static_cast<size_t>(random.NextIndex(static_cast<int>(surface.points.size())))];
    const double force = std::pow(10.0, random.NextUniform(-4.0, 2.0));
    std::vector<double> forces(skin->elements.size(), 0.0);
    SpreadForce(surface, point.p_L + Vector3d(2e-4, 0.0, 1e-4), force, 0.004, forces);
    EXPECT_NEAR(Sum(forces) / force, 1.0, 1e-12);
    for (size_t e = 0; e < forces.size(); ++e) {
      EXPECT_TRUE(forces[e] == 0.0 || skin->elements[e].link == surface.part.link);
    }
  }
}

// By hand: 1 - exp(-2 / 2) over 1 - exp(-10 / 2), and 2 over 10.
TEST(TouchSensorsTest, ElementsAnswerAsTheEquationsSay) {
  const SensorConfig config;
  const auto exponential = TactileResponse::kExponential, linear = TactileResponse::kLinear;
  EXPECT_NEAR(CalcReading(exponential, config, 2.0), 0.6321205588 / 0.9932620530, 1e-9);
  EXPECT_NEAR(CalcReading(linear, config, 2.0), 0.2, 1e-15);
  for (const TactileResponse response : {exponential, linear}) {
    EXPECT_EQ(CalcReading(response, config, 0.0), 0.0);
    EXPECT_NEAR(CalcReading(response, config, 10.0), 1.0, 1e-12);
    EXPECT_EQ(CalcReading(response, config, 25.0), CalcReading(response, config, 10.0));
    for (const double force : {0.01, 0.5, 3.0, 9.0}) {
      EXPECT_NEAR(CalcForce(response, config, CalcReading(response, config, force)), force, 1e-9);
    }
  }
}

TrialSetup MakeSensed(const char* hand) {
  TrialSetup setup = MakeSetup(hand, "g1", LoadObject("tea_light"));
  setup.touch = TouchSense::kSensed;
  return setup;
}

TEST(SensedTouchTest, AGraspIsFeltAndRecorded) {
  for (const char* hand : {"shadow", "tum"}) {
    const TrialSetup setup = MakeSensed(hand);
    const TrialResult result = RunSetup(setup);
    EXPECT_EQ(result.outcome, Outcome::kSuccess) << result.reason;
    ASSERT_TRUE(result.touch) << hand;
    EXPECT_GE(result.touch->num_touches, 2);
    EXPECT_GT(result.touch->num_felt_in_time, 0);
    EXPECT_LE(result.touch->num_felt_in_time + result.touch->num_felt_late,
              result.touch->num_touches);
    EXPECT_EQ(result.touch->peak.size(), setup.hand->skin->elements.size());
    EXPECT_GT(*std::max_element(result.touch->peak.begin(), result.touch->peak.end()), 0.1);
    ExpectSurvivesItsRecord(result);
    EXPECT_EQ(ToJson(RunSetup(setup)), ToJson(result));
  }
}

// The other way to the same forces: sensors that follow the trial with the hand's dynamics.
TEST(SensedTouchTest, ForcesOfAnInstantAreThoseThatTheSensorsHave) {
  for (const char* hand : {"shadow", "tum"}) {
    const TrialSetup setup = MakeSensed(hand);
    TouchSensors sensors(*setup.hand, setup.sensors, "any");
    double sum = 0.0;
    TrialRunner(setup.hand, setup.object).Run(setup, [&](TrialCourse& course) {
      std::vector<HandContact> contacts;
      course.world().FindHandContacts(contacts);
      course.world().dynamics().UpdatePositions(course.world().state().X_WH,
                                                course.world().state().q);
      sensors.Observe(course.time(), contacts, course.world().dynamics());
      const std::vector<double> forces =
          CalcTaxelForces(*setup.hand, setup.sensors, course.world().state().X_WH,
                          course.world().state().q, contacts);
      ASSERT_EQ(forces.size(), sensors.forces().size());
      for (size_t i = 0; i < forces.size(); ++i) {
        ASSERT_NEAR(forces[i], sensors.forces()[i], 1e-6) << i << " at " << course.time();
      }
      sum = std::max(sum, Sum(forces));
    });
    EXPECT_GT(sum, 0.5) << hand;
  }
}

// Elements that feel everything at once and without fault give what the contacts themselves give.
TEST(SensedTouchTest, PerfectElementsEndTheClosureWhenTheContactsDo) {
  TrialSetup setup = MakeSensed("tum");
  setup.sensors.noise = setup.sensors.threshold = setup.sensors.hysteresis = 0.0;
  setup.sensors.rate = 1.0 / setup.sim.step;
  setup.sensors.saturation = 1000.0;
  const TrialResult sensed = RunSetup(setup);
  setup.touch = TouchSense::kExact;
  const TrialResult exact = RunSetup(setup);
  EXPECT_FALSE(exact.touch);
  EXPECT_FALSE(ToJson(exact).contains("touch"));
  ASSERT_EQ(sensed.phases.size(), exact.phases.size());
  for (size_t i = 0; i < exact.phases.size(); ++i) {
    EXPECT_NEAR(sensed.phases[i].time, exact.phases[i].time, setup.sim.step * 1.001) << i;
  }
}

// The TUM Hand holds these beside its fingertips. By what its elements feel alone it pressed four
// to ten times as hard as it was asked to.
TEST(SensedTouchTest, PressesBesideItsElementsAsHardAsItIsAsked) {
  for (const char* object : {"cup", "tennis_ball"}) {
    TrialSetup setup = MakeSetup("tum", "g6", LoadObject(object));
    setup.touch = TouchSense::kSensed;
    setup.strategy.grip = "margin";
    setup.strategy.grip_margin = 2.0;
    setup.strategy.grip_force = 0.7;
    setup.strategy.touch_speed = 0.25;
    const TrialResult result = RunSetup(setup);
    ASSERT_TRUE(result.grip) << object;
    ASSERT_EQ(result.outcome, Outcome::kSuccess) << object << ": " << result.reason;
    EXPECT_GT(result.touch->num_elsewhere, 0) << object;
    const double asked = result.grip->asked, truth = result.stability.hold.normal_force;
    EXPECT_LE(truth, 1.5 * asked) << object;
    EXPECT_GE(truth, asked / 1.5) << object;
    EXPECT_NEAR(result.grip->held, truth, kGripTolerance * truth) << object;
  }
}

// Elements that feel nothing: closure and stabilisation end by their time-outs.
TEST(SensedTouchTest, WhoFeelsNothingWaitsForTheTimeOuts) {
  TrialSetup setup = MakeSensed("tum");
  setup.sensors.threshold = 1.0;
  const TrialResult result = RunSetup(setup);
  ASSERT_TRUE(result.touch);
  EXPECT_EQ(result.touch->num_felt_in_time, 0);
  ASSERT_GT(result.phases.size(), 2u);
  EXPECT_EQ(result.phases[1].name, "stabilisation");
  EXPECT_NEAR(result.phases[1].time, setup.strategy.closure_time + setup.strategy.closure_patience,
              2.0 * setup.sim.step);
}

TEST(SensedTouchTest, AHandThatFeelsNothingIsRefused) {
  const TrialResult result = RunSetup(MakeSensed("tum-original"));
  EXPECT_EQ(result.outcome, Outcome::kNumericalFailure);
  EXPECT_NE(result.reason.find("has no tactile.yaml"), std::string::npos) << result.reason;
}

}  // namespace
}  // namespace graspbench
