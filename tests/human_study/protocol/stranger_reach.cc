#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "tests/human_study/protocol/reaches.h"

namespace graspbench::protocol {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kYield = 0.3e-3;  // of the skin [m]

// From 0 to 1 as a raised cosine; its speed is a half sine squared.
double Bell(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u - std::sin(2.0 * kPi * u) / (2.0 * kPi);
}

// Way of a hand that is fastest at `peak` of its time.
class Transport {
 public:
  Transport(bool corrects, double peak, double correction)
      : corrects_(corrects), peak_(peak), correction_(correction) {}

  double At(double u) const {
    u = std::clamp(u, 0.0, 1.0);
    if (corrects_) return peak_ > 0.5 ? 1.0 - Corrected(1.0 - u, 1.0 - peak_) : Corrected(u, peak_);
    // Speed (1 - cos) / 2 up to the peak, (1 + cos) / 2 after it: each half covers half its time.
    if (u < peak_) return u - peak_ / kPi * std::sin(kPi * u / peak_);
    const double rest = 1.0 - peak_, back = 1.0 - u;
    return 1.0 - (back - rest / kPi * std::sin(kPi * back / rest));
  }

 private:
  // The large bell ends at twice the peak; the small one ends the movement.
  double Corrected(double u, double peak) const {
    const double end = 2.0 * peak, start = 1.15 * peak;
    if (end > 0.995) return Bell(u);
    return (1.0 - correction_) * Bell(u / end) + correction_ * Bell((u - start) / (1.0 - start));
  }
  bool corrects_;
  double peak_;
  double correction_;
};

// Distance of skin and surface: out, then back on a cosine that is stopped at zero.
struct Closing {
  double home = 0.0, open = 0.0;      // [m]
  double start = 0.0, turn = 0.0;     // of the movement, and where it is widest [s]
  double touch = 0.0, beneath = 0.0;  // [s], [m]
  double duration = 1.0;              // of the whole cosine, if nothing stopped it [s]

  void Aim(double speed) {
    double low = 0.0, high = 4.0 * open;
    for (int i = 0; i < 60; ++i) {
      beneath = 0.5 * (low + high);
      const double way = open + beneath;
      const double phase = std::acos(2.0 * beneath / way - 1.0);
      duration = (touch - turn) * kPi / phase;
      (0.5 * way * kPi / duration * std::sin(phase) < speed ? low : high) = beneath;
    }
  }
  double At(double t) const {
    if (t < turn) {
      const double u = std::clamp((t - start) / (turn - start), 0.0, 1.0);
      return home + (open - home) * 0.5 * (1.0 - std::cos(kPi * u));
    }
    const double way = open + beneath;
    return 0.5 * way * (1.0 + std::cos(kPi * (t - turn) / duration)) - beneath;
  }
};

double WalkTo(const std::string& id, int trial) {
  RandomStream steps(id, "stranger's walk");
  double walk = 0.0;
  for (int i = 0; i < trial; ++i) walk += steps.NextNormal();
  return walk;
}

}  // namespace

Reach MakeStrangerReach(const Conditions& conditions, const std::string& id, int trial) {
  RandomStream person(id, "stranger"), random(id + "/" + std::to_string(trial), "stranger's reach");
  const bool corrects = person.NextUnit() < 0.5;
  const double pace = person.NextUniform(0.9, 1.15);
  const Transport transport(corrects, random.NextUniform(conditions.min_peak, conditions.max_peak),
                            random.NextUniform(0.04, 0.1));
  const double distance = conditions.distances[static_cast<size_t>(
      random.NextIndex(static_cast<int>(conditions.distances.size())))];
  const double duration =
      pace * (0.42 + 0.16 * std::log2(2.0 * distance / 0.1)) * 0.75 + conditions.drift * trial;
  const double shared =
      conditions.shared_sd * random.NextNormal() + conditions.wander * WalkTo(id, trial);
  const Vector3d place(random.NextUniform(-6e-3, 6e-3), random.NextUniform(-6e-3, 6e-3), 0.0);

  Reach reach;
  reach.onset = random.NextUniform(0.4, 0.9);
  const double reach_end = reach.onset + duration;
  struct Digit {
    Vector3d normal, tangent, skin_to_marker;
    double height = 0.0, bow = 0.0, speed = 0.0;
    Closing closing;
  };
  std::array<Digit, kNumDigits> digits;
  double last = 0.0;
  for (int d = 0; d < kNumDigits; ++d) {
    Digit& digit = digits[d];
    constexpr std::array<double, kNumDigits> kAround{-1.62, 1.15, 1.42, 1.65, 1.93};  // [rad]
    constexpr std::array<double, kNumDigits> kHeight{0.066, 0.088, 0.070, 0.052, 0.034};
    const double around = kAround[d] + random.NextUniform(-0.06, 0.06);
    digit.normal = {std::cos(around), std::sin(around), 0.0};
    digit.tangent = {-digit.normal.y(), digit.normal.x(), 0.0};
    if (digit.tangent.x() > 0.0) digit.tangent *= -1.0;  // towards the start
    digit.height = kHeight[d] + random.NextUniform(-3e-3, 3e-3);
    digit.bow = random.NextUniform(-8e-3, 8e-3);
    digit.skin_to_marker = person.NextUniform(6e-3, 9e-3) * digit.normal +
                           person.NextUniform(1e-3, 4e-3) * digit.tangent;
    const double own = person.NextUniform(-0.02, 0.03);
    const double scatter = conditions.digit_sd * std::sqrt(3.0) * random.NextUniform(-1.0, 1.0);
    digit.closing.start = reach.onset;
    digit.closing.turn = reach.onset + random.NextUniform(0.55, 0.65) * duration;
    digit.closing.touch = reach_end + own + scatter + shared + conditions.lag * d;
    digit.closing.touch = std::max(digit.closing.touch, digit.closing.turn + 0.08);
    digit.closing.home = random.NextUniform(-22e-3, -15e-3);
    digit.closing.open = random.NextUniform(18e-3, 34e-3);
    digit.speed = random.NextUniform(conditions.min_touch_speed, conditions.max_touch_speed);
    digit.closing.Aim(digit.speed);
    reach.touch_times[d] = reach.hold_times[d] = digit.closing.touch;
    reach.release_times[d] = std::numeric_limits<double>::quiet_NaN();
    last = std::max(last, digit.closing.touch);
  }
  reach.widest = digits[0].closing.turn;
  reach.lift_off = last + random.NextUniform(0.12, 0.3);

  const double tilt = random.NextUniform(-0.1, 0.1);
  const auto object_at = [&](double t) {
    const double lifted = Bell((t - reach.lift_off) / 0.9);
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.linear() = Eigen::AngleAxisd(tilt * lifted, Vector3d::UnitY()).matrix();
    X_WO.translation() = place + lifted * Vector3d(-0.015, 0.005, 0.15);
    return X_WO;
  };
  const double wrist_duration = duration + conditions.end_sd * random.NextNormal();
  const auto measured = [&](const Vector3d& p) -> Vector3d {
    return p + conditions.noise_sd *
                   Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal());
  };
  const int num_markers = conditions.num_object_markers;
  reach.object_markers.resize(static_cast<size_t>(num_markers));
  for (int i = 0; i / conditions.rate < reach.lift_off + 1.1; ++i) {
    const double t = i / conditions.rate;
    reach.times.push_back(t);
    const Eigen::Isometry3d X_WO = object_at(t);
    for (int d = 0; d < kNumDigits; ++d) {
      const Digit& digit = digits[d];
      const double touch = digit.closing.touch, since = t - touch;
      double gap = digit.closing.At(t), left = 0.0, side = 0.0;
      if (since >= 0.0) {
        gap = -kYield * (1.0 - std::exp(-digit.speed * since / kYield));
      } else {
        const double way = transport.At((t - reach.onset) / (touch - reach.onset));
        left = distance * (1.0 - way);
        side = digit.bow * std::sin(kPi * way);
      }
      const Vector3d p_O = (kObjectRadius + gap) * digit.normal + left * digit.tangent +
                           (digit.height + side) * Vector3d::UnitZ() + digit.skin_to_marker;
      reach.digits[d].push_back(measured(X_WO * p_O));
    }
    const double way = transport.At((t - reach.onset) / wrist_duration);
    const Vector3d wrist(-0.12 - distance * (1.0 - way), 0.01 * std::sin(kPi * way),
                         0.07 + 0.03 * std::sin(0.5 * kPi * way));
    reach.wrist.push_back(measured(wrist + X_WO.translation()));
    for (int m = 0; m < num_markers; ++m) {
      const double angle = 0.4 + 2.0 * kPi * m / 3.0, off = num_markers == 1 ? 0.0 : 20e-3;
      const Vector3d p_O(off * std::cos(angle), off * std::sin(angle), kObjectHeight);
      reach.object_markers[static_cast<size_t>(m)].push_back(measured(X_WO * p_O));
    }
  }
  return reach;
}

}  // namespace graspbench::protocol
