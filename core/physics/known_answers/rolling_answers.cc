// Known answers of rolling and resting: the support of an object on the table.

#include <cmath>
#include <string>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/physics/known_answers/known_answer.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kRollingSteps[] = {0.002, 0.0005};  // [s]
constexpr double kRadius = 0.03;                     // [m]
constexpr double kDensity = 1000.0;                  // [kg/m^3]

std::string NameStep(double step) { return FormatFixed(MsFromS(step), 1) + " ms"; }

SimConfig MakeRollingConfig(double step, double resistance = 0.0) {
  SimConfig config = MakeStepConfig(step);
  config.table_rolling_resistance = resistance;
  return config;
}

/** Makes a cylinder about z whose vertices lie on the circle. */
GraspObject MakeCylinder(int num_segments, double height) {
  return MakeSolid(MakeRevolution({{0.0, -0.5 * height},
                                   {kRadius, -0.5 * height},
                                   {kRadius, 0.5 * height},
                                   {0.0, 0.5 * height}},
                                  num_segments),
                   kDensity * kPi * kRadius * kRadius * height, 0.5, 0.5);
}

/** Lays the body along y and lets it roll along x. */
void LayRolling(double speed, SmallWorld& body) {
  body.start().R_WO = MakeRotationRpy(0.5 * kPi, 0.0, 0.0);
  body.start().p_WOcm = Vector3d(0.0, 0.0, kRadius);
  body.start().v_WOcm = Vector3d(speed, 0.0, 0.0);
  body.start().w_WO = Vector3d(0.0, speed / kRadius, 0.0);
  body.Reset();
}

}  // namespace

std::vector<KnownAnswer> CheckRollingCylinders() {
  std::vector<KnownAnswer> answers;
  for (int segments : {24, 48, 96, 192, 384}) {
    const GraspObject cylinder = MakeCylinder(segments, 0.06);
    for (double step : kRollingSteps) {
      const std::string what = std::to_string(segments) + " segments, " + NameStep(step);
      SmallWorld level(cylinder, MakeRollingConfig(step));
      LayRolling(0.3, level);
      level.Run(3.0);
      answers.push_back({what + ": speed after 3 s", "m/s", 0.3, level.state().v_WOcm.x(), 0.003});
      SmallWorld slope(cylinder, MakeRollingConfig(step));
      const double angle = RadFromDeg(5.0);
      slope.start().gravity_W = kStandardGravity * Vector3d(std::sin(angle), 0.0, -std::cos(angle));
      LayRolling(0.0, slope);
      slope.Run(1.0);
      const double expected = 0.5 * kStandardGravity * std::sin(angle) / 1.5;
      answers.push_back({what + ": way down 5 degrees in 1 s", "m", expected,
                         slope.state().p_WOcm.x(), 0.01 * expected});
    }
  }
  return answers;
}

std::vector<KnownAnswer> CheckRollingResistance() {
  std::vector<KnownAnswer> answers;
  constexpr double kResistance = 1e-3, kSpeed = 0.3, kTime = 1.0;
  const GraspObject cylinder = MakeCylinder(48, 0.06);
  const double braking = kResistance * kStandardGravity / (1.5 * kRadius);
  for (double step : kRollingSteps) {
    SmallWorld body(cylinder, MakeRollingConfig(step, kResistance));
    LayRolling(kSpeed, body);
    body.Run(kTime);
    const double expected = kSpeed - braking * kTime;
    answers.push_back({"c = 1 mm, " + NameStep(step) + ": speed after 1 s", "m/s", expected,
                       body.state().v_WOcm.x(), 0.01 * kSpeed});
    body.Run(1.0);
    const double way = 0.5 * kSpeed * kSpeed / braking;
    answers.push_back({"c = 1 mm, " + NameStep(step) + ": way until it stands", "m", way,
                       body.state().p_WOcm.x(), 0.01 * way});
  }
  return answers;
}

std::vector<KnownAnswer> CheckRollingCone() {
  std::vector<KnownAnswer> answers;
  constexpr double kHeight = 0.06, kTurning = 4.0;  // [m], about the vertical [rad/s]
  const GraspObject cone = MakeSolid(
      MakeRevolution({{0.0, 0.0}, {kRadius, kHeight}, {0.0, kHeight}}, 64), 0.05, 0.5, 0.5);
  const double alpha = std::atan2(kRadius, kHeight), distance = 0.75 * kHeight;
  for (double step : kRollingSteps) {
    SmallWorld body(cone, MakeRollingConfig(step));
    // The apex is at the origin, the contact line along x, the axis above it.
    const Eigen::Matrix3d R = MakeRotationRpy(0.0, 0.5 * kPi - alpha, 0.0);
    body.start().R_WO = R;
    body.start().p_WOcm = distance * Vector3d(std::cos(alpha), 0.0, std::sin(alpha));
    body.start().w_WO = Vector3d(-kTurning / std::tan(alpha), 0.0, 0.0);
    body.start().v_WOcm = body.start().w_WO.cross(body.start().p_WOcm);
    body.Reset();
    body.Run(3.0);
    const double speed = distance * std::cos(alpha) * kTurning;
    answers.push_back({"64 segments, " + NameStep(step) + ": speed after 3 s", "m/s", speed,
                       body.state().v_WOcm.norm(), 0.01 * speed});
    answers.push_back(
        {"64 segments, " + NameStep(step) + ": its apex has moved", "m", 0.0,
         (body.state().p_WOcm - body.state().R_WO * Vector3d(0.0, 0.0, distance)).head<2>().norm(),
         0.01 * distance});
  }
  return answers;
}

std::vector<KnownAnswer> CheckRollingDisc() {
  std::vector<KnownAnswer> answers;
  constexpr double kThickness = 0.0005, kTurning = 3.0;
  const double mass = kDensity * kPi * kRadius * kRadius * kThickness;
  const GraspObject disc = MakeCylinder(96, kThickness);
  const double a = kRadius, b = 0.5 * kThickness, g = kStandardGravity;
  const double I_axis = 0.5 * mass * a * a, I_across = mass * (a * a / 4.0 + b * b / 3.0);
  for (double inclination : {90.0, 70.0}) {  // of the disc's plane to the table [deg]
    const double s = std::sin(RadFromDeg(inclination)), c = std::cos(RadFromDeg(inclination));
    // The lower edge touches at a across and b along the axis from the middle. The middle moves at
    // V = a w - b T s, with spin w about the axis and T about the vertical. Steady rolling requires
    // T s (I_axis w - I_across T c) = -m V T (a s + b c) - m g (a c - b s).
    const double T = inclination == 90.0 ? 0.0 : kTurning;
    const double spin = inclination == 90.0
                            ? -15.0
                            : (T * T * s * c * I_across - mass * g * (a * c - b * s) +
                               mass * T * T * b * s * (a * s + b * c)) /
                                  (T * s * I_axis + mass * T * a * (a * s + b * c));
    const double speed = std::abs(a * spin - b * T * s);
    for (double step : kRollingSteps) {
      SmallWorld body(disc, MakeRollingConfig(step));
      // The disc rolls along x; the direction up to its middle lies in the y-z plane.
      const Vector3d up(0.0, c, s), axis(0.0, -s, c);
      Eigen::Matrix3d R;
      R << Vector3d::UnitX(), up, Vector3d::UnitX().cross(up);
      body.start().R_WO = R;  // z of O is the disc's axis
      body.start().p_WOcm = a * up + (inclination == 90.0 ? 0.0 : b) * axis;
      body.start().w_WO = T * s * up + spin * axis;
      body.start().v_WOcm = body.start().w_WO.cross(body.start().p_WOcm);
      body.Reset();
      body.Run(2.0);
      const std::string what =
          "leaning to " + FormatFixed(inclination, 0) + " deg, " + NameStep(step);
      answers.push_back(
          {what + ": speed after 2 s", "m/s", speed, body.state().v_WOcm.norm(), 0.01 * speed});
      answers.push_back({what + ": lean then", "rad", RadFromDeg(inclination),
                         std::acos(std::abs(body.state().R_WO(2, 2))),
                         0.01 * RadFromDeg(inclination)});
    }
  }
  return answers;
}

std::vector<KnownAnswer> CheckRestingDepth() {
  std::vector<KnownAnswer> answers;
  // Bottom of a can: a narrow ring carries the can, and the fillet around it extends farther out.
  const TriMesh can = MakeRevolution({{0.0, -0.045},
                                      {0.026, -0.045},
                                      {0.027, -0.05},
                                      {0.028, -0.04997},
                                      {0.030, -0.0498},
                                      {0.033, -0.045},
                                      {0.033, 0.05},
                                      {0.0, 0.05}},
                                     64);
  struct Resting {
    std::string name;
    TriMesh mesh;
    double mass;
  };
  const std::vector<Resting> things = {
      {"can on its ring", can, 0.35},
      {"rounded box", MakeRoundedBox(Vector3d(0.05, 0.035, 0.015), 0.001), 0.01},
      {"cylinder of 192 sides",
       MakeRevolution({{0.0, -0.03}, {0.03, -0.03}, {0.03, 0.03}, {0.0, 0.03}}, 192), 0.1},
  };
  for (const Resting& thing : things) {
    for (const bool lies : {false, true}) {
      const GraspObject object = MakeSolid(thing.mesh, thing.mass, 0.5, 0.5);
      SmallWorld body(object, SimConfig());
      body.start().R_WO = lies ? MakeRotationRpy(0.5 * kPi, 0.0, 0.0) : Eigen::Matrix3d::Identity();
      body.start().p_WOcm = Vector3d(0.0, 0.0, 0.05);
      body.Reset();
      const double lowest = body.world().collider().CalcLowestPoint(body.world().CalcObjectPose());
      body.start().p_WOcm.z() -= lowest;
      body.Reset();
      body.Run(1.0);
      double depth = 0.0;
      for (const Vector3d& p : object.mesh.vertices) {
        depth = std::max(depth, -(body.world().CalcObjectPose() * p).z());
      }
      const double most = 2.0 * thing.mass * kStandardGravity / SimConfig().contact_stiffness;
      answers.push_back({thing.name + (lies ? ", lying" : "") + ": depth of its lowest vertex", "m",
                         0.5 * most, depth, 0.5 * most});
    }
  }
  return answers;
}

}  // namespace graspbench
