#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "tests/human_study/protocol/reaches.h"

namespace graspbench::protocol {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStep = 1e-4;     // of the integration [s]
constexpr double kGravity = 9.81;  // [m/s^2]
constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

// The tip of a digit, and its skin against a rigid surface.
constexpr double kTipMass = 0.015;         // [kg]
constexpr double kTipStiffness = 200.0;    // of what moves it [N/m]
constexpr double kTipDamping = 2.5;        // [N s/m]
constexpr double kSkinStiffness = 2500.0;  // [N/m]
constexpr double kPadForce = 0.1;          // of a soft pad: F = 0.1 N (exp(depth / pad_depth) - 1)
constexpr double kDissipation = 2.0;       // of the force, at 1 m/s [s/m]
constexpr double kSkinFriction = 0.8;
constexpr double kFeltWay = 3e-3;   // that a digit goes on once it feels the object [m]
constexpr double kSearch = 60e-3;   // speed of a digit that did not meet what it aimed at [m/s]
constexpr double kGripRamp = 0.15;  // [s]

double MinimumJerkRate(double u) {
  return u <= 0.0 || u >= 1.0 ? 0.0 : 30.0 * u * u * (1.0 - u) * (1.0 - u);
}

struct Digit {
  // The plan.
  Vector2d home, beside, aim, inward;
  double transport = 0.0, start = 0.0;  // duration of the first stroke, start of the second [s]
  double stroke = 0.0;                  // duration of the second [s]
  double height = 0.0, home_height = 0.0;
  double going_on = kFeltWay;  // once it feels the object [m]
  double grip = 0.0;           // [N]

  // The state.
  Vector2d p, v;
  double touch = kNever;
  Vector2d touch_p, touch_v;           // of the plan at the touch
  Vector2d held, held_inward;          // when the grip begins
  Vector2d anchor = Vector2d::Zero();  // where skin sticks to the surface, from the axis
  Vector3d marker = Vector3d::Zero();  // from the skin
  std::vector<Vector2d> recorded = {};

  // Place and speed of the plan before the touch, on the way from `onset`.
  std::pair<Vector2d, Vector2d> PlanAt(double t, double onset) const {
    const double u = (t - onset) / transport, w = (t - start) / stroke;
    const double searched = std::max(0.0, t - start - stroke);
    return {home + (beside - home) * MinimumJerk(u) + (aim - beside) * MinimumJerk(w) +
                kSearch * searched * inward,
            (beside - home) / transport * MinimumJerkRate(u) +
                (aim - beside) / stroke * MinimumJerkRate(w) +
                (searched > 0.0 ? kSearch : 0.0) * inward};
  }
  // The same once it feels the object: the plan runs out within `going_on`.
  std::pair<Vector2d, Vector2d> PlanAfterTouch(double t) const {
    const double speed = std::max(1e-3, touch_v.norm());
    const double tau = going_on / speed, left = std::exp(-(t - touch) / tau);
    return {touch_p + touch_v * tau * (1.0 - left), touch_v * left};
  }
};

// Skin of a digit against the cylinder: the force on the digit.
Vector2d CalcSkinForce(Digit& digit, const Vector2d& axis, const Vector2d& speed,
                       double pad_depth) {
  const Vector2d off = digit.p - axis;
  const double depth = kObjectRadius - off.norm();
  if (depth <= 0.0) {
    digit.anchor = off;
    return Vector2d::Zero();
  }
  const Vector2d normal = off.normalized(), tangent(-normal.y(), normal.x());
  const Vector2d v = digit.v - speed;
  const double still = pad_depth > 0.0
                           ? kPadForce * (std::exp(std::min(12.0, depth / pad_depth)) - 1.0)
                           : kSkinStiffness * depth;
  const double pressed = std::max(0.0, still * (1.0 - kDissipation * v.dot(normal)));
  double sheared = -kSkinStiffness * (off - digit.anchor).dot(tangent) - v.dot(tangent);
  const double most = kSkinFriction * pressed;
  if (std::abs(sheared) > most) {
    sheared = std::copysign(most, sheared);
    digit.anchor = off + tangent * sheared / kSkinStiffness;
  }
  return pressed * normal + sheared * tangent;
}

}  // namespace

Reach MakePushedReach(const Conditions& conditions, const std::string& id, int trial) {
  RandomStream person(id, "pushes"), random(id + "/" + std::to_string(trial), "pushed reach");
  const double distance = conditions.distances[static_cast<size_t>(
      random.NextIndex(static_cast<int>(conditions.distances.size())))];
  const bool is_light = conditions.push > 0.0;
  const double mass = is_light ? random.NextUniform(0.06, 0.25) : 2.0;
  const double friction = (is_light ? random.NextUniform(0.2, 0.45) : 0.6) * mass * kGravity;
  const double duration = person.NextUniform(0.65, 0.85) + 0.3 * distance;

  Reach reach;
  reach.onset = random.NextUniform(0.45, 0.8);
  const int first = random.NextUnit() < 0.4 ? 0 : 1;
  const double lead = is_light ? random.NextUniform(0.05, 0.15) : 0.0;
  std::array<Digit, kNumDigits> digits;
  for (int d = 0; d < kNumDigits; ++d) {
    Digit& digit = digits[d];
    constexpr std::array<double, kNumDigits> kAround{-1.57, 1.2, 1.47, 1.73, 2.0};  // [rad]
    constexpr std::array<double, kNumDigits> kHeight{0.068, 0.09, 0.072, 0.054, 0.036};
    const double around = kAround[d] + 0.04 * random.NextNormal();
    const Vector2d normal(std::cos(around), std::sin(around));
    digit.inward = -normal;
    digit.height = kHeight[d] + 2e-3 * random.NextNormal();
    digit.home_height = 0.02 + 0.005 * d;
    // The second stroke crosses the surface of the resting object at this speed and time.
    const double speed = random.NextUniform(conditions.min_touch_speed, conditions.max_touch_speed);
    const double touch = reach.onset + duration + conditions.digit_sd * random.NextNormal() -
                         (d == first ? lead : 0.0);
    const double open = random.NextUniform(0.018, 0.03), beneath = random.NextUniform(0.01, 0.02);
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 40; ++i) {
      const double u = 0.5 * (low + high);
      (MinimumJerk(u) * (open + beneath) < open ? low : high) = u;
    }
    digit.stroke = (open + beneath) * MinimumJerkRate(low) / speed;
    digit.start = touch - low * digit.stroke;
    digit.transport = touch - reach.onset - random.NextUniform(0.0, 0.05);
    digit.beside = (kObjectRadius + open) * normal;
    digit.aim = (kObjectRadius - beneath) * normal;
    digit.home = Vector2d(-distance, 0.012 * (d == 0 ? -1.0 : 0.3 * d));
    digit.p = digit.home;
    digit.v = Vector2d::Zero();
    digit.grip = random.NextUniform(0.5, 1.0);
    if (d == first && is_light) digit.going_on = conditions.push + friction / kTipStiffness;
    digit.marker = Vector3d(-1e-3 * person.NextUniform(1.0, 4.0), 0.0, 1e-3 * person.NextNormal());
    digit.marker.head<2>() += person.NextUniform(6.5e-3, 8e-3) * normal;
    reach.touch_times[d] = reach.release_times[d] = kNever;
  }
  digits[0].grip = 0.0;
  for (int d = 1; d < kNumDigits; ++d) digits[0].grip -= digits[d].grip * digits[d].inward.y();
  reach.widest = digits[0].start;

  const double hold = random.NextUniform(0.15, 0.3);
  double grip_start = std::numeric_limits<double>::infinity();
  reach.lift_off = kNever;
  Vector2d axis = Vector2d::Zero(), axis_v = Vector2d::Zero();
  std::vector<Vector2d> ways;
  const long every = std::lround(1.0 / conditions.rate / kStep);
  for (long i = 0; std::isnan(reach.lift_off) || i * kStep < reach.lift_off + 1.2; ++i) {
    const double t = i * kStep;
    if (i % every == 0) {
      reach.times.push_back(t);
      ways.push_back(axis);
      for (Digit& digit : digits) digit.recorded.push_back(digit.p);
    }
    Vector2d pushed = Vector2d::Zero();
    bool have_all = true;
    for (size_t d = 0; d < kNumDigits; ++d) {
      Digit& digit = digits[d];
      auto [plan, plan_v] =
          std::isnan(digit.touch) ? digit.PlanAt(t, reach.onset) : digit.PlanAfterTouch(t);
      if (t > grip_start) {  // each comes to press with its share, where it is
        const double share = MinimumJerk((t - grip_start) / kGripRamp);
        const Vector2d pressed = digit.held + digit.grip / kTipStiffness * digit.held_inward;
        plan = (1.0 - share) * plan + share * pressed;
        plan_v *= 1.0 - share;
      } else {
        digit.held = digit.p;
        digit.held_inward = (axis - digit.p).normalized();
      }
      const Vector2d force = CalcSkinForce(digit, axis, axis_v, conditions.pad_depth);
      if (std::isnan(digit.touch) && !force.isZero(0.0)) {
        digit.touch = reach.touch_times[d] = reach.hold_times[d] = t;
        digit.touch_p = plan, digit.touch_v = plan_v;
      }
      have_all = have_all && !std::isnan(digit.touch);
      // What moves the tip knows its mass: in the air it follows the plan.
      const Vector2d plan_a = std::isnan(digit.touch)
                                  ? Vector2d((digit.PlanAt(t + kStep, reach.onset).second -
                                              digit.PlanAt(t, reach.onset).second) /
                                             kStep)
                                  : Vector2d(Vector2d::Zero());
      const Vector2d moved = kTipMass * plan_a + kTipStiffness * (plan - digit.p) +
                             kTipDamping * (plan_v - digit.v) + force;
      digit.v += kStep / kTipMass * moved;
      digit.p += kStep * digit.v;
      pushed -= force;
    }
    if (have_all && std::isnan(reach.lift_off)) {
      grip_start = t + 0.05;
      reach.lift_off = grip_start + kGripRamp + hold;
    }
    // Friction of the table stops the object within a step, or takes what it can.
    axis_v += kStep / mass * pushed;
    const double most = kStep / mass * friction;
    axis_v = axis_v.norm() <= most ? Vector2d(Vector2d::Zero())
                                   : Vector2d(axis_v * (1.0 - most / axis_v.norm()));
    axis += kStep * axis_v;
  }

  const auto measured = [&](const Vector2d& p, double z) -> Vector3d {
    return Vector3d(p.x(), p.y(), z) + conditions.noise_sd * Vector3d(random.NextNormal(),
                                                                      random.NextNormal(),
                                                                      random.NextNormal());
  };
  const int num_markers = conditions.num_object_markers;
  reach.object_markers.resize(static_cast<size_t>(num_markers));
  for (size_t i = 0; i < reach.times.size(); ++i) {
    const double t = reach.times[i];
    const double lift = 0.14 * MinimumJerk((t - reach.lift_off) / 0.85);
    for (size_t d = 0; d < kNumDigits; ++d) {
      const Digit& digit = digits[d];
      const double u = MinimumJerk((t - reach.onset) / digit.transport);
      const double z = digit.home_height + (digit.height - digit.home_height) * u + lift;
      const Vector2d p = digit.recorded[i] + digit.marker.head<2>();
      reach.digits[d].push_back(measured(p, z + digit.marker.z()));
    }
    const double way = MinimumJerk((t - reach.onset) / duration);
    reach.wrist.push_back(
        measured(Vector2d(-0.12 - distance * (1.0 - way), 0.01), 0.05 + 0.05 * way + lift));
    for (int m = 0; m < num_markers; ++m) {
      const double angle = 0.9 + 2.1 * m, off = num_markers == 1 ? 0.0 : 19e-3;
      const Vector2d way_O = conditions.is_object_left_behind ? Vector2d(0.0, 0.0) : ways[i];
      const Vector2d p = way_O + off * Vector2d(std::cos(angle), std::sin(angle));
      reach.object_markers[static_cast<size_t>(m)].push_back(
          measured(p, kObjectHeight + (conditions.is_object_left_behind ? 0.0 : lift)));
    }
  }
  return reach;
}

}  // namespace graspbench::protocol
