// Known answers of a body alone: flight, spin, rest, impact.

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/physics/contact.h"
#include "core/physics/known_answers/known_answer.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Configuration of a table without rolling resistance. */
SimConfig MakeBodyConfig(double step) {
  SimConfig config = MakeStepConfig(step);
  config.table_rolling_resistance = 0.0;
  return config;
}

/** Coefficient of restitution of a mass on a spring and damper in parallel that can only push. The
damping is `damping_ratio` times critical, above 1 (Schwager and Poeschel 2007). */
double CalcRestitution(double damping_ratio) {
  const double root = std::sqrt(damping_ratio * damping_ratio - 1.0);
  return std::exp(-damping_ratio / root *
                  std::log((damping_ratio + root) / (damping_ratio - root)));
}

/** Coefficient of restitution of a body that hits the table at `speed` without gravity. */
double MeasureRestitution(const GraspObject& object, double speed, double step) {
  SmallWorld body(object, MakeBodyConfig(step));
  body.start().gravity_W.setZero();
  body.start().p_WOcm = Vector3d(0.0, 0.0, 0.5 * object.size.z() + 1.7 * speed * step);
  body.start().v_WOcm = Vector3d(0.0, 0.0, -speed);
  body.Reset();
  body.Run(0.05);
  return body.state().v_WOcm.z() / speed;
}

}  // namespace

std::vector<KnownAnswer> CheckFreeFall() {
  std::vector<KnownAnswer> answers;
  for (double step : kAnswerSteps) {
    SmallWorld body(MakeBlock(0.5), MakeBodyConfig(step));
    body.start().p_WOcm = Vector3d(0.0, 0.0, 2.0);
    body.start().v_WOcm = Vector3d(0.3, 0.0, 1.0);
    body.Reset();
    const double t = 0.4;
    body.Run(t);
    const std::string with_step = " after 0.4 s, " + FormatStep(step);
    answers.push_back({"x" + with_step, "m", 0.3 * t, body.state().p_WOcm.x(), 1e-9});
    answers.push_back({"z" + with_step, "m", 2.0 + t - 0.5 * kStandardGravity * t * t,
                       body.state().p_WOcm.z(), 1e-7});
  }
  return answers;
}

std::vector<KnownAnswer> CheckTorqueFreeSpin() {
  const Eigen::Matrix3d I = MakeBlock(0.5).mass_properties.I_OOcm;
  SmallWorld body(MakeBlock(0.5), MakeBodyConfig(0.001));
  body.start().gravity_W.setZero();
  body.start().p_WOcm = Vector3d(0.0, 0.0, 1.0);
  body.start().w_WO = Vector3d(0.01, 10.0, 0.02);
  body.Reset();
  const auto momentum = [&] {
    const Eigen::Matrix3d& R = body.state().R_WO;
    return Vector3d(R * I * R.transpose() * body.state().w_WO);
  };
  const Vector3d momentum_at_start = momentum();
  const double energy_at_start = body.world().CalcKineticEnergy();
  double most_turned = 1.0;
  for (int i = 0; i < 5000; ++i) {
    body.Step();
    most_turned = std::min(most_turned, body.state().R_WO(1, 1));
  }
  return {{"middle axis after its flip (Dzhanibekov)", "", -1.0, most_turned, 0.05},
          {"change of angular momentum in 5 s", "", 0.0,
           (momentum() - momentum_at_start).norm() / momentum_at_start.norm(), 1e-3},
          {"energy after 5 s over that at the start", "", 1.0,
           body.world().CalcKineticEnergy() / energy_at_start, 1e-3}};
}

std::vector<KnownAnswer> CheckStaticDepth() {
  std::vector<KnownAnswer> answers;
  const double mass = 0.5;
  for (double stiffness : {5e3, 2e4, 2e5}) {
    for (double step : {0.0005, 0.004}) {
      SimConfig config = MakeBodyConfig(step);
      config.contact_stiffness = stiffness;
      SmallWorld body(MakeBlock(mass), config);
      body.start().p_WOcm = Vector3d(0.0, 0.0, 0.01);
      body.Reset();
      body.Run(2.0);
      answers.push_back({"0.5 kg on 4 corners, k = " + std::to_string(std::lround(stiffness)) +
                             " N/m, " + FormatStep(step),
                         "m", mass * kStandardGravity / (4.0 * stiffness),
                         0.01 - body.state().p_WOcm.z(), 1e-9});
    }
  }
  return answers;
}

std::vector<KnownAnswer> CheckForceDepthLaw() {
  std::vector<KnownAnswer> answers;
  for (double force : {0.5, 2.0, 8.0, 32.0}) {
    SimConfig config = MakeBodyConfig(0.002);
    SmallWorld world(MakeSqueezeHand(2, 0.02, force, 0.0),
                     MakeSolid(MakePrism(4, 0.02, 0.04), 0.1, 0.5, 0.5), config);
    world.start().X_WH = MakePose(Vector3d(0.0, 0.0, 1.0 + kSqueezeLever));
    world.start().p_WOcm = Vector3d(0.0, 0.0, 1.0);
    world.start().gravity_W.setZero();
    world.Reset(Eigen::VectorXd::Ones(2));
    const StepReport report = world.Run(1.0);
    const std::string what = "two fingers of " + std::to_string(force).substr(0, 4) + " N: ";
    const double depth = force / config.contact_stiffness;
    answers.push_back({what + "normal forces", "N", 2.0 * force, report.grip_force, 1e-3 * force});
    answers.push_back({what + "depth", "m", depth, report.worst_penetration, 1e-3 * depth});
  }
  return answers;
}

std::vector<KnownAnswer> CheckRestitution() {
  std::vector<KnownAnswer> answers;
  const GraspObject ball = MakeSolid(MakeSphere(0.02), 0.05, 0.5, 0.5), block = MakeBlock(0.5);
  for (double speed : {0.05, 0.2, 1.0}) {
    const std::string with_speed = ", " + std::to_string(speed).substr(0, 4) + " m/s, ";
    for (double step : kAnswerSteps) {
      const std::string how = with_speed + FormatStep(step) + ": returns";
      answers.push_back(
          {"ball of 50 g" + how, "", 0.0, MeasureRestitution(ball, speed, step), 0.05});
      answers.push_back(
          {"block of 0.5 kg" + how, "", 0.0, MeasureRestitution(block, speed, step), 0.05});
    }
    // A fine step reveals the law itself.
    constexpr double kFineStep = 1e-5;
    const auto expect = [](int num_points, double mass) {
      const double k = num_points * SimConfig().contact_stiffness;
      return CalcRestitution(0.5 * kContactRelaxationTime * std::sqrt(k / mass));
    };
    const std::string how = with_speed + FormatStep(kFineStep) + ": returns";
    answers.push_back({"ball of 50 g" + how, "", expect(1, 0.05),
                       MeasureRestitution(ball, speed, kFineStep), 0.002});
    answers.push_back({"block of 0.5 kg" + how, "", expect(4, 0.5),
                       MeasureRestitution(block, speed, kFineStep), 0.002});
  }
  return answers;
}

std::vector<KnownAnswer> CheckRolling() {
  std::vector<KnownAnswer> answers;
  constexpr double kSpeed = 0.5, kTime = 1.5;
  for (int segments : {32, 64, 128}) {
    const GraspObject ball = MakeSolid(MakeSphere(0.03, segments), 0.1, 0.5, 0.5);
    for (double step : {0.0005, 0.001, 0.002}) {
      SmallWorld body(ball, MakeBodyConfig(step));
      body.start().p_WOcm = Vector3d(0.0, 0.0, 0.03);
      body.start().v_WOcm = Vector3d(kSpeed * std::cos(0.3), kSpeed * std::sin(0.3), 0.0);
      body.Reset();
      body.Run(kTime);
      const double expected = 5.0 / 7.0 * kSpeed;
      answers.push_back(
          {std::to_string(segments) + " segments, " + FormatStep(step) + ": speed after 1.5 s",
           "m/s", expected, body.state().v_WOcm.head<2>().norm(), 0.02 * expected});
    }
  }
  return answers;
}

std::vector<KnownAnswer> CheckSpinningDisc() {
  std::vector<KnownAnswer> answers;
  constexpr double kRadius = 0.03, kMu = 0.3, kSpin = 20.0;
  const GraspObject disc =
      MakeSolid(MakeRevolution({{0.0, -0.01}, {kRadius, -0.01}, {kRadius, 0.01}, {0.0, 0.01}}, 64),
                0.2, 0.5, 0.5);
  // Uniform pressure has the moment 2/3 mu m g a; the moment of inertia is m a^2 / 2.
  const double expected = 0.75 * kRadius * kSpin / (kMu * kStandardGravity);
  for (double step : kAnswerSteps) {
    SimConfig config = MakeBodyConfig(step);
    config.table_friction_static = config.table_friction_dynamic = kMu;
    SmallWorld body(disc, config);
    const double depth = 0.2 * kStandardGravity / (8.0 * config.contact_stiffness);
    body.start().p_WOcm = Vector3d(0.0, 0.0, 0.01 - depth);
    body.start().w_WO = Vector3d(0.0, 0.0, kSpin);
    body.Reset();
    double time = 0.0;
    while (time < 1.0 && body.state().w_WO.z() > 0.001 * kSpin) {
      body.Step();
      time += step;
    }
    answers.push_back({"disc of 60 mm, " + FormatStep(step) + ": stops after", "s", expected, time,
                       0.01 * expected + step});
  }
  return answers;
}

std::vector<KnownAnswer> CheckBounces() {
  std::vector<KnownAnswer> answers;
  const GraspObject ball = MakeSolid(MakeSphere(0.02), 0.05, 0.5, 0.5);
  for (double step : {0.0001, 0.0005, 0.001, 0.002, 0.004}) {
    SimConfig config = MakeBodyConfig(step);
    SmallWorld body(ball, config);
    body.start().p_WOcm = Vector3d(0.0, 0.0, 0.1);
    body.Reset();
    double top_before = 0.1, top = 0.0, largest_gain = 0.0;
    int num_touches = 0;
    bool touched_before = false;
    for (double t = 0.0; t < 2.0; t += step) {
      const bool touches = body.Step().table_force > 0.0;
      if (touches && !touched_before) {
        if (num_touches++ > 0) top_before = top;
        top = 0.0;
      }
      touched_before = touches;
      top = std::max(top, body.state().p_WOcm.z());
      if (num_touches > 0) largest_gain = std::max(largest_gain, top - top_before);
    }
    const std::string what = FormatStep(step) + ": ";
    answers.push_back({what + "largest gain of height", "m", 0.0, largest_gain, 1e-9});
    answers.push_back(
        {what + "touches the table (1 = yes)", "", 1.0, num_touches > 0 ? 1.0 : 0.0, 0.0});
  }
  return answers;
}

}  // namespace graspbench
