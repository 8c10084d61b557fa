// Known answers of a body alone: flight, spin, rest, impact.

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/physics/known_answers/known_answer.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

SimConfig MakeConfig(double step) {
  SimConfig config;
  config.step = step;
  return config;
}

std::string FormatStep(double step) {
  return "step " + std::to_string(std::lround(step * 1e6)) + " us";
}

constexpr double kSteps[] = {0.0005, 0.001, 0.002, 0.004};

/** Speed of rebound over speed of impact of a mass that meets k x (1 + d x'). With
F(v) = (d v - ln(1 + d v)) / d^2, F(v) + k x^2 / (2 m) stays: F(impact) = F(-rebound). */
double CalcRestitution(double speed, double d) {
  const auto F = [d](double v) { return (d * v - std::log1p(d * v)) / (d * d); };
  double low = 0.0, high = speed;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (F(-middle) < F(speed) ? low : high) = middle;
  }
  return low / speed;
}

}  // namespace

std::vector<KnownAnswer> CheckFreeFall() {
  std::vector<KnownAnswer> answers;
  for (double step : kSteps) {
    SmallWorld body(MakeBlock(0.5), MakeConfig(step));
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
  SmallWorld body(MakeBlock(0.5), MakeConfig(0.001));
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
      SimConfig config = MakeConfig(step);
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
    SimConfig config = MakeConfig(0.002);
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
  const double speed = 0.2;
  for (double dissipation : {0.5, 1.0, 2.0}) {
    // The implicit step damps a little by itself; at this step by far less than the tolerance.
    SimConfig config = MakeConfig(1e-6);
    config.contact_dissipation = dissipation;
    SmallWorld body(MakeBlock(0.5), config);
    body.start().gravity_W.setZero();
    body.start().p_WOcm = Vector3d(0.0, 0.0, 0.01 + 1e-5);
    body.start().v_WOcm = Vector3d(0.0, 0.0, -speed);
    body.Reset();
    body.Run(0.006);
    answers.push_back({"d = " + std::to_string(dissipation).substr(0, 3) + " s/m, 0.2 m/s", "",
                       CalcRestitution(speed, dissipation), body.state().v_WOcm.z() / speed,
                       0.003});
  }
  return answers;
}

std::vector<KnownAnswer> CheckBounces() {
  std::vector<KnownAnswer> answers;
  const GraspObject ball = MakeSolid(MakeSphere(0.02), 0.05, 0.5, 0.5);
  for (double step : {0.0001, 0.0005, 0.001, 0.002, 0.004}) {
    SimConfig config = MakeConfig(step);
    config.contact_dissipation = 0.0;
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
    const std::string what = "d = 0, " + FormatStep(step) + ": ";
    answers.push_back({what + "largest gain of height", "m", 0.0, largest_gain, 1e-9});
    answers.push_back(
        {what + "touches the table (1 = yes)", "", 1.0, num_touches > 0 ? 1.0 : 0.0, 0.0});
  }
  return answers;
}

}  // namespace graspbench
