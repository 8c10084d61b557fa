#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "tests/human_study/protocol/reaches.h"

namespace graspbench::protocol {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kCylinderRadius = 35e-3;  // [m]
constexpr double kCylinderHeight = 0.12;   // [m]
constexpr double kClockStep = 1e-4;        // of the search for the touch [s]
constexpr double kPushTime = 0.15;         // of a push along the table [s]
constexpr double kRollTime = 0.15;         // of a phalanx that turns on its pad [s]
constexpr double kSearchSpeed = 0.02;      // of a digit that did not find the object [m/s]
constexpr double kLiftHeight = 0.15;       // [m]
constexpr double kLiftTime = 0.7;          // [s]
constexpr double kHoldTime = 0.3;          // after the lift [s]

// Minimum jerk from 0 at u = 0 to 1 at u = 1, at rest outside.
double Quintic(double u) {
  if (u <= 0.0) return 0.0;
  if (u >= 1.0) return 1.0;
  return u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}
double QuinticSlope(double u) { return 30.0 * u * u * (1.0 - u) * (1.0 - u); }

// Slow, small, different on each axis: three waves of 0.5 to 4 Hz.
class Wobble {
 public:
  Wobble(RandomStream& random, double sd) {
    for (auto& axis : waves_) {
      for (auto& wave : axis) {
        wave = {sd * std::sqrt(2.0 / 3.0), 2.0 * kPi * random.NextUniform(0.5, 4.0),
                random.NextUniform(0.0, 2.0 * kPi)};
      }
    }
  }
  Vector3d At(double t) const {
    Vector3d p = Vector3d::Zero();
    for (int i = 0; i < 3; ++i) {
      for (const auto& wave : waves_[i]) p[i] += wave[0] * std::sin(wave[1] * t + wave[2]);
    }
    return p;
  }

 private:
  std::array<std::array<std::array<double, 3>, 3>, 3> waves_;
};

struct Object {
  double push_start = std::numeric_limits<double>::infinity();
  Vector3d push = Vector3d::Zero();
  double lift_off = std::numeric_limits<double>::infinity();
  Vector3d tilt = Vector3d::Zero();  // rotation vector at the end of the lift

  Vector3d PushAt(double t) const { return Quintic((t - push_start) / kPushTime) * push; }
  Vector3d LiftAt(double t) const {
    return Quintic((t - lift_off) / kLiftTime) * Vector3d(0.02, 0.0, kLiftHeight);
  }
  Eigen::Isometry3d PoseAt(double t) const {
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    const double angle = tilt.norm() * Quintic((t - lift_off) / kLiftTime);
    if (angle > 0.0) X_WO.linear() = Eigen::AngleAxisd(angle, tilt.normalized()).matrix();
    X_WO.translation() = PushAt(t) + LiftAt(t);
    return X_WO;
  }
};

// The plan of one digit's skin, in W, and what became of it.
struct Digit {
  Vector3d contact = Vector3d::Zero();  // planned, on the surface
  Vector3d normal = Vector3d::Zero();   // outward
  Vector3d home = Vector3d::Zero();     // offset of the start, along the surface
  double home_gap = 0.0;                // along the normal
  double open_gap = 0.0;
  double open_time = 0.0;
  double planned_touch = 0.0;
  double crossing = 1.0;       // share of the closing's path in time at which it meets the surface
  double closing_depth = 0.0;  // aimed at beneath the surface
  double touch_speed = 0.0;
  bool hovers = false;
  Vector3d marker = Vector3d::Zero();  // from skin to marker
  double touch = std::numeric_limits<double>::quiet_NaN();
  Vector3d touch_O = Vector3d::Zero();  // skin at touch, in the object's frame

  double GapAt(double t, double onset) const {
    if (t < open_time) {
      return home_gap + (open_gap - home_gap) * Quintic((t - onset) / (open_time - onset));
    }
    const double duration = (planned_touch - open_time) / crossing;
    // Where the object was pushed away, the digit closes on until it meets it.
    const double late = hovers ? 0.0 : std::max(0.0, t - open_time - duration);
    return open_gap - (open_gap + closing_depth) * Quintic((t - open_time) / duration) -
           kSearchSpeed * late;
  }
  Vector3d SkinAt(double t, double onset) const {
    const double far = 1.0 - Quintic((t - onset) / (planned_touch - onset));
    return contact + far * home + GapAt(t, onset) * normal;
  }
};

// Where on its closing path a digit must meet the surface to do so at `speed`: the speed falls
// monotonically from half of the path on.
double FindCrossing(double gap, double time, double speed) {
  double low = 0.5, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double u = 0.5 * (low + high);
    const double found = gap * QuinticSlope(u) * u / (Quintic(u) * time);
    (found > speed ? low : high) = u;
  }
  return 0.5 * (low + high);
}

std::array<double, kNumDigits> DrawAsynchronies(const Conditions& conditions,
                                                RandomStream& random) {
  const double gft = random.NextUniform(conditions.min_gft, conditions.max_gft);
  std::array<double, kNumDigits> delays{};
  for (double& delay : delays) delay = gft * random.NextUnit();
  // Thumb or index first most often; another digit is last.
  const int first = random.NextUnit() < 0.8 ? random.NextIndex(2) : random.NextIndex(kNumDigits);
  int last = (first + 1 + random.NextIndex(kNumDigits - 1)) % kNumDigits;
  if (last == conditions.hovering_digit) last = (last + 1) % kNumDigits;
  if (last == first) last = (last + 1) % kNumDigits;
  delays[first] = 0.0;
  delays[last] = gft;
  return delays;
}

Digit PlanDigit(const Conditions& conditions, int d, double touch_time, double open_time,
                RandomStream& random) {
  // Thumb against four fingers, one above the other.
  constexpr std::array<double, kNumDigits> kAzimuth_deg = {-90.0, 75.0, 85.0, 95.0, 105.0};
  constexpr std::array<double, kNumDigits> kHeight = {0.075, 0.098, 0.080, 0.062, 0.044};
  Digit digit;
  const double azimuth = (kAzimuth_deg[d] + 3.0 * random.NextNormal()) * kPi / 180.0;
  digit.normal = {std::cos(azimuth), std::sin(azimuth), 0.0};
  digit.contact = kCylinderRadius * digit.normal;
  digit.contact.z() = kHeight[d] + 2e-3 * random.NextNormal();
  const Vector3d start(-0.35, 0.0, -0.03);
  digit.home = start - start.dot(digit.normal) * digit.normal;
  digit.home_gap = -25e-3 + 3e-3 * random.NextNormal();
  digit.open_gap = random.NextUniform(22e-3, 36e-3);
  digit.open_time = open_time;
  digit.planned_touch = touch_time;
  digit.touch_speed = random.NextUniform(conditions.min_touch_speed, conditions.max_touch_speed);
  const double closing = touch_time - open_time;
  digit.crossing = FindCrossing(digit.open_gap, closing, digit.touch_speed);
  digit.closing_depth = digit.open_gap * (1.0 / Quintic(digit.crossing) - 1.0);
  if (d == conditions.hovering_digit) {
    // Comes to rest off the surface.
    digit.hovers = true;
    digit.crossing = 1.0;
    digit.closing_depth = -conditions.hover_gap;
  }
  return digit;
}

// Where the markers sit is a matter of the person, not of the trial.
Vector3d PlaceMarker(const Conditions& conditions, const std::string& id, int d,
                     const Vector3d& normal) {
  RandomStream person(id, "marker of digit " + std::to_string(d));
  const double off = (conditions.nail_markers ? 13e-3 : 8e-3) + 0.7e-3 * person.NextNormal();
  const Vector3d back(-1.0, 0.0, 0.0);
  return off * normal + (4e-3 + 1e-3 * person.NextNormal()) * back;
}

std::vector<Vector3d> PlaceObjectMarkers(const Conditions& conditions) {
  std::vector<Vector3d> p_OM;
  if (conditions.num_object_markers == 1) p_OM.emplace_back(0.0, 0.0, kCylinderHeight);
  if (conditions.num_object_markers == 3) {
    const double radius = conditions.triangle_edge / std::sqrt(3.0);
    for (int i = 0; i < 3; ++i) {
      const double angle = (20.0 + 120.0 * i) * kPi / 180.0;
      p_OM.emplace_back(radius * std::cos(angle), radius * std::sin(angle), kCylinderHeight);
    }
  }
  return p_OM;
}

// Runs the digits against the object on the fine clock until all that will touch have touched.
void FindTouches(const Conditions& conditions, double onset, double end,
                 std::array<Digit, kNumDigits>& digits, Object& object) {
  for (double t = onset + 0.2; t < end; t += kClockStep) {
    for (int d = 0; d < kNumDigits; ++d) {
      Digit& digit = digits[d];
      if (!std::isnan(digit.touch) || d == conditions.hovering_digit) continue;
      if (t < digit.open_time) continue;
      const Vector3d skin_O = digit.SkinAt(t, onset) - object.PushAt(t);
      const double gap = (skin_O - digit.contact).dot(digit.normal);
      if (gap > 0.0) continue;
      digit.touch = t;
      digit.touch_O = skin_O;
      if (std::isinf(object.push_start)) {
        object.push_start = t;
        object.push = -conditions.push * digit.normal;
      }
    }
  }
}

// Skin to marker and sinking after touch, in the object's frame.
Vector3d TouchingMarker_O(const Conditions& conditions, const Digit& digit, double roll, double t) {
  const double since = t - digit.touch;
  const double depth =
      conditions.yield * (1.0 - std::exp(-digit.touch_speed * since / conditions.yield));
  Vector3d marker = digit.marker;
  if (conditions.nail_markers) {
    const double angle = roll * Quintic(since / kRollTime);
    marker = Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * marker;
  }
  return digit.touch_O - depth * digit.normal + marker;
}

void AddNoise(double sd, RandomStream& random, std::vector<Vector3d>& path) {
  for (Vector3d& p : path) {
    for (int i = 0; i < 3; ++i) p[i] += sd * random.NextNormal();
  }
}

void HideAroundTouch(const Conditions& conditions, const std::vector<double>& times,
                     const Digit& digit, RandomStream& random, std::vector<Vector3d>& path) {
  const bool hidden = random.NextUnit() < conditions.hidden_share;
  const double from = digit.touch - random.NextUniform(0.02, 0.08);
  const double to = digit.touch + random.NextUniform(0.05, 0.2);
  if (!hidden || std::isnan(digit.touch)) return;
  for (size_t i = 0; i < times.size(); ++i) {
    if (times[i] >= from && times[i] <= to) {
      path[i].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
}

}  // namespace

Reach MakeProtocolReach(const Conditions& conditions, const std::string& id, int trial) {
  RandomStream random(id + "/" + std::to_string(trial + 1), "reach of the protocol");
  Reach reach;
  reach.object_radius = kCylinderRadius;
  reach.object_height = kCylinderHeight;
  reach.onset = 0.5 + random.NextUniform(0.0, 0.2);
  const double transport = random.NextUniform(0.7, 0.9);
  const double transport_end = reach.onset + transport;
  const double open_time = reach.onset + 0.6 * transport;
  const double first_touch = transport_end - random.NextUniform(0.0, 0.05);
  const std::array<double, kNumDigits> delays = DrawAsynchronies(conditions, random);
  std::array<Digit, kNumDigits> digits;
  for (int d = 0; d < kNumDigits; ++d) {
    digits[d] = PlanDigit(conditions, d, first_touch + delays[d], open_time, random);
    digits[d].marker = PlaceMarker(conditions, id, d, digits[d].normal);
  }
  Object object;
  FindTouches(conditions, reach.onset, first_touch + 0.5, digits, object);
  double last_touch = 0.0;
  for (int d = 0; d < kNumDigits; ++d) {
    reach.touch_times[d] = digits[d].touch;
    if (!std::isnan(digits[d].touch)) last_touch = std::max(last_touch, digits[d].touch);
  }
  object.lift_off = reach.lift_off = last_touch + random.NextUniform(0.15, 0.28);
  object.tilt = random.NextUniform(1.0, 6.0) * kPi / 180.0 *
                Vector3d(random.NextNormal(), random.NextNormal(), 0.2).normalized();

  const double end = reach.lift_off + kLiftTime + kHoldTime;
  for (int frame = 0; frame / conditions.rate < end; ++frame) {
    reach.times.push_back(frame / conditions.rate);
  }
  for (int d = 0; d < kNumDigits; ++d) {
    const Digit& digit = digits[d];
    const bool hovers = d == conditions.hovering_digit;
    const Wobble wobble(random, hovers ? 0.5e-3 : 0.05e-3);
    const double roll = random.NextUniform(10.0, 14.0) * kPi / 180.0 * (d == 0 ? 1.0 : -1.0);
    for (const double t : reach.times) {
      if (!hovers && t >= digit.touch) {
        const double settled = Quintic((t - digit.touch) / 0.1);
        reach.digits[d].push_back(object.PoseAt(t) * (TouchingMarker_O(conditions, digit, roll, t) +
                                                      settled * wobble.At(t)));
      } else {
        // A digit that does not touch goes where the hand goes.
        reach.digits[d].push_back(digit.SkinAt(t, reach.onset) + digit.marker + wobble.At(t) +
                                  object.LiftAt(t));
      }
    }
    AddNoise(conditions.noise_sd, random, reach.digits[d]);
    HideAroundTouch(conditions, reach.times, digit, random, reach.digits[d]);
  }
  for (const double t : reach.times) {
    const double progress = Quintic((t - reach.onset) / transport);
    reach.wrist.push_back(Vector3d(-0.48 + 0.35 * progress, 0.0, 0.06 + 0.05 * progress) +
                          object.LiftAt(t));
  }
  AddNoise(conditions.noise_sd, random, reach.wrist);
  for (const Vector3d& p_OM : PlaceObjectMarkers(conditions)) {
    std::vector<Vector3d>& path = reach.object_markers.emplace_back();
    for (const double t : reach.times) path.push_back(object.PoseAt(t) * p_OM);
    AddNoise(conditions.noise_sd, random, path);
  }
  return reach;
}

}  // namespace graspbench::protocol
