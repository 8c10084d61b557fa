#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "tests/human_study/protocol/reaches.h"

namespace graspbench::protocol {
namespace {

using Eigen::Vector3d;

constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
constexpr double kStep = 1e-4;          // of the clock on which surfaces meet [s]
constexpr double kFastest = 3.0;        // no gap closes faster [m/s]
constexpr double kYield = 0.25e-3;      // of the skin [m]
constexpr double kPushDuration = 0.12;  // [s]
constexpr double kAwayDuration = 0.09;  // of leaving, and of returning [s]
constexpr double kStayDuration = 0.05;  // of the first touch, and of the stay away [s]

// Where a table of positions rises most.
double FindPeak(const SpeedProfile& profile) {
  constexpr int kNum = 400;
  double best = 0.0, fastest = 0.0, before = 0.0;
  for (int i = 1; i <= kNum; ++i) {
    const double position = profile.PositionAt(i / double(kNum));
    if (position - before > fastest) {
      fastest = position - before;
      best = (i - 0.5) / kNum;
    }
    before = position;
  }
  return best;
}

class Tremor {
 public:
  Tremor(double rms, RandomStream& random) : rms_(rms) {
    for (auto& axis : waves_) {
      for (auto& wave : axis) {
        wave = {kTwoPi * random.NextUniform(8.0, 11.0), random.NextUniform(0.0, kTwoPi)};
      }
    }
  }
  Vector3d At(double t) const {
    Vector3d p = Vector3d::Zero();
    if (rms_ == 0.0) return p;
    for (int i = 0; i < 3; ++i) {
      for (const auto& wave : waves_[i]) p[i] += rms_ * std::sin(wave[0] * t + wave[1]);
    }
    return p;
  }

 private:
  double rms_;
  std::array<std::array<std::array<double, 2>, 2>, 3> waves_;
};

struct Digit {
  Vector3d normal = Vector3d::Zero();  // outward, at the planned touch
  double height = 0.0;
  Vector3d home = Vector3d::Zero();  // offset of the start along the surface
  double home_gap = 0.0, open_gap = 0.0;
  double open_time = 0.0, plan = 0.0, speed = 0.0, end_gap = 0.0;
  Vector3d marker = Vector3d::Zero();
  double touch = kNever;
  Vector3d touch_O = Vector3d::Zero();
  Eigen::Matrix3d R_OW = Eigen::Matrix3d::Identity();  // at the touch: the digit turns on with it

  double GapAt(double t, double onset) const {
    if (t < open_time) {
      return home_gap + (open_gap - home_gap) * MinimumJerk((t - onset) / (open_time - onset));
    }
    if (t >= plan) return end_gap - speed * (t - plan);
    // Cubic from rest at the opening to the planned speed at the planned touch.
    const double time = plan - open_time, u = (t - open_time) / time;
    const double way = open_gap - end_gap;
    return open_gap - way * u * u * (3.0 - 2.0 * u) - speed * time * u * u * (u - 1.0);
  }
};

struct Object {
  double start = std::numeric_limits<double>::infinity();
  Vector3d push = Vector3d::Zero();
  double speed = 0.0;  // of a push at once; 0: minimum jerk [m/s]
  double turn = 0.0;
  double lift_off = std::numeric_limits<double>::infinity();

  Eigen::Isometry3d PoseAt(double t) const {
    const double moved = MinimumJerk((t - start) / kPushDuration);
    const double lifted = MinimumJerk((t - lift_off) / 0.8);
    // A light thing goes on with the finger, which slows down.
    const double pushed =
        speed > 0.0 ? 1.0 - std::exp(-std::max(0.0, t - start) * speed / push.norm()) : moved;
    Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
    X_WO.linear() = Eigen::AngleAxisd(turn * moved, Vector3d::UnitZ()).matrix();
    X_WO.translation() = pushed * push + lifted * Vector3d(0.0, 0.01, 0.13);
    return X_WO;
  }
};

// Leaving and returning along the normal, in seconds since the first touch.
double LeavingAt(double since, double gap) {
  const double leave = since - kStayDuration;
  const double back = leave - kAwayDuration - kStayDuration;
  return gap * (MinimumJerk(leave / kAwayDuration) - MinimumJerk(back / kAwayDuration));
}

double DrawWalk(const std::string& id, int trial) {
  RandomStream steps(id, "wander");
  double walk = 0.0;
  for (int i = 0; i < trial; ++i) walk += steps.NextNormal();
  return walk;
}

void LowPass(double cutoff, double rate, std::vector<Vector3d>& path) {
  const double c = 1.0 / std::tan(0.5 * kTwoPi * cutoff / rate), s = std::sqrt(2.0);
  const double b = 1.0 / (1.0 + s * c + c * c);
  const double a1 = 2.0 * (1.0 - c * c) * b, a2 = (1.0 - s * c + c * c) * b;
  Vector3d x1 = path[0], x2 = path[0], y1 = path[0], y2 = path[0];
  for (Vector3d& p : path) {
    const Vector3d x = p;
    p = b * (x + 2.0 * x1 + x2) - a1 * y1 - a2 * y2;
    x2 = x1, x1 = x, y2 = y1, y1 = p;
  }
}

void Measure(const Conditions& conditions, RandomStream& random, std::vector<Vector3d>& path) {
  for (Vector3d& p : path) {
    for (int i = 0; i < 3; ++i) p[i] += conditions.noise_sd * random.NextNormal();
    if (conditions.spike_share > 0.0 && random.NextUnit() < conditions.spike_share) {
      const Vector3d way(random.NextNormal(), random.NextNormal(), random.NextNormal());
      p += conditions.spike_size * way.normalized();
    }
  }
  if (conditions.low_pass_hz > 0.0) LowPass(conditions.low_pass_hz, conditions.rate, path);
}

}  // namespace

SpeedProfile::SpeedProfile(Family family, double peak) : family_(family), peak_(peak) {
  if (family_ == Family::kBeta) {
    table_.assign(1, 0.0);
    for (int i = 0; i < 2000; ++i) {
      const double u = (i + 0.5) / 2000.0;
      table_.push_back(table_.back() +
                       std::pow(u, 4.0 * peak) * std::pow(1.0 - u, 4.0 - 4.0 * peak));
    }
    for (double& value : table_) value /= table_.back();
  }
  if (family_ == Family::kWarped && peak != 0.5) {
    double low = 0.5, high = 2.0;
    for (int i = 0; i < 30; ++i) {
      exponent_ = 0.5 * (low + high);
      (FindPeak(*this) < peak ? low : high) = exponent_;
    }
  }
}

double SpeedProfile::PositionAt(double u) const {
  if (u <= 0.0) return 0.0;
  if (u >= 1.0) return 1.0;
  return RawPositionAt(u);
}

double SpeedProfile::RawPositionAt(double u) const {
  if (family_ == Family::kWarped) return MinimumJerk(std::pow(u, exponent_));
  if (family_ == Family::kBeta) {
    const double at = u * 2000.0;
    const size_t i = static_cast<size_t>(at);
    return table_[i] + (at - i) * (table_[i + 1] - table_[i]);
  }
  // Both halves meet at the same speed: their ways are as their durations.
  if (u < peak_) return 2.0 * peak_ * MinimumJerk(0.5 * u / peak_);
  const double rest = 1.0 - peak_;
  return 1.0 - 2.0 * rest * MinimumJerk(0.5 * (1.0 - u) / rest);
}

Reach MakeEverydayReach(const Conditions& conditions, const std::string& id, int trial) {
  RandomStream random(id + "/" + std::to_string(trial), "everyday reach");
  Reach reach;
  reach.onset = random.NextUniform(0.5, 0.8);
  const double distance = conditions.distances[static_cast<size_t>(
      random.NextIndex(static_cast<int>(conditions.distances.size())))];
  // Farther takes longer: 0.35 m in 0.8 s, 1 s for each further metre.
  const double duration = 0.45 + distance;
  const SpeedProfile profile(conditions.family,
                             random.NextUniform(conditions.min_peak, conditions.max_peak));
  const double shared = conditions.shared_sd * random.NextNormal() + conditions.drift * trial +
                        conditions.wander * DrawWalk(id, trial);

  std::array<Digit, kNumDigits> digits;
  std::vector<Tremor> tremors;
  for (int d = 0; d < kNumDigits; ++d) {
    Digit& digit = digits[d];
    constexpr std::array<double, kNumDigits> kAzimuth_deg{-92.0, 70.0, 82.0, 94.0, 106.0};
    constexpr std::array<double, kNumDigits> kHeight{0.070, 0.092, 0.074, 0.056, 0.038};
    const double azimuth = (kAzimuth_deg[d] + 2.0 * random.NextNormal()) * kTwoPi / 360.0;
    digit.normal = {std::cos(azimuth), std::sin(azimuth), 0.0};
    digit.height = kHeight[d] + 2e-3 * random.NextNormal();
    const Vector3d start(-distance, 0.0, -0.02);
    digit.home = start - start.dot(digit.normal) * digit.normal;
    digit.home_gap = random.NextUniform(-24e-3, -18e-3);
    digit.open_gap = random.NextUniform(20e-3, 32e-3);
    digit.plan = reach.onset + duration + 0.02 + shared + conditions.lag * d +
                 conditions.digit_sd * random.NextNormal();
    digit.open_time = reach.onset + random.NextUniform(0.58, 0.64) * duration;
    digit.speed = random.NextUniform(conditions.min_touch_speed, conditions.max_touch_speed);
    if (d == conditions.hovering_digit) digit.end_gap = conditions.hover_gap, digit.speed = 0.0;
    RandomStream person(id, "marker of digit " + std::to_string(d));
    digit.marker = (7e-3 + 0.8e-3 * person.NextNormal()) * digit.normal +
                   Vector3d(-3e-3 + 1e-3 * person.NextNormal(), 0.0, 0.0);
    tremors.emplace_back(conditions.tremor, random);
  }
  reach.widest = digits[0].open_time;
  Object object;
  double wait = 0.0;
  for (double t = reach.onset + 0.2; t < reach.onset + duration + 1.5; t += std::max(kStep, wait)) {
    wait = INFINITY;
    const Vector3d axis = object.PoseAt(t).translation();
    for (int d = 0; d < kNumDigits; ++d) {
      Digit& digit = digits[d];
      if (!std::isnan(digit.touch) || d == conditions.hovering_digit) continue;
      if (t < digit.open_time) {
        wait = std::min(wait, digit.open_time - t);
        continue;
      }
      const double gap = digit.GapAt(t, reach.onset) + (tremors[d].At(t) - axis).dot(digit.normal);
      wait = std::min(wait, std::floor(gap / kFastest / kStep) * kStep);
      if (gap > 0.0) continue;
      digit.touch = t;
      const double far = 1.0 - profile.PositionAt((t - reach.onset) / (digit.plan - reach.onset));
      const Vector3d skin = (kObjectRadius + digit.GapAt(t, reach.onset)) * digit.normal +
                            digit.height * Vector3d::UnitZ() + far * digit.home + tremors[d].At(t);
      digit.touch_O = object.PoseAt(t).inverse() * skin;
      digit.R_OW = object.PoseAt(t).linear().transpose();
      if (std::isinf(object.start)) {
        object.start = t;
        object.push = -conditions.push * digit.normal;
        if (conditions.is_push_at_once) object.speed = digit.speed;
        object.turn = conditions.turn;
      }
    }
  }
  double last = 0.0;
  for (int d = 0; d < kNumDigits; ++d) {
    reach.touch_times[d] = reach.hold_times[d] = digits[d].touch;
    reach.release_times[d] = kNever;
    if (d == conditions.regrasping_digit) {
      reach.release_times[d] = digits[d].touch + kStayDuration;
      reach.hold_times[d] = reach.release_times[d] + 2.0 * kAwayDuration + kStayDuration;
    }
    if (!std::isnan(digits[d].touch)) last = std::max(last, reach.hold_times[d]);
  }
  object.lift_off = reach.lift_off = last + random.NextUniform(0.16, 0.27);

  for (int i = 0; i / conditions.rate < reach.lift_off + 1.2; ++i) {
    reach.times.push_back(i / conditions.rate);
  }
  for (int d = 0; d < kNumDigits; ++d) {
    const Digit& digit = digits[d];
    for (const double t : reach.times) {
      const double since = t - digit.touch;
      if (since >= 0.0) {
        Vector3d way =
            digit.marker - kYield * (1.0 - std::exp(-digit.speed * since / kYield)) * digit.normal;
        if (d == conditions.regrasping_digit) {
          way += LeavingAt(since, conditions.leave_gap) * digit.normal;
        }
        const double still = 0.15 + 0.85 * std::exp(-since / 0.03);
        const Vector3d shake =
            still * tremors[d].At(t) - tremors[d].At(digit.touch) * std::exp(-since / 0.03);
        reach.digits[d].push_back(object.PoseAt(t) * (digit.touch_O + digit.R_OW * (way + shake)));
      } else {
        const double far = 1.0 - profile.PositionAt((t - reach.onset) / (digit.plan - reach.onset));
        const Vector3d lifted = (object.PoseAt(t).translation().z()) * Vector3d::UnitZ();
        // One that never touches stays beside the object.
        const Vector3d beside = std::isnan(digit.touch) ? lifted : Vector3d::Zero();
        const double gap = std::isnan(digit.touch) ? std::max(digit.GapAt(t, reach.onset),
                                                              t < digit.plan ? -1.0 : digit.end_gap)
                                                   : digit.GapAt(t, reach.onset);
        reach.digits[d].push_back((kObjectRadius + gap) * digit.normal +
                                  digit.height * Vector3d::UnitZ() + far * digit.home +
                                  digit.marker + tremors[d].At(t) + beside);
      }
    }
  }
  const double wrist_duration = duration + conditions.end_sd * random.NextNormal();
  const Tremor wrist_tremor(0.5 * conditions.tremor, random);
  for (const double t : reach.times) {
    const double way = profile.PositionAt((t - reach.onset) / wrist_duration);
    const double lifted = object.PoseAt(t).translation().z();
    reach.wrist.push_back(
        Vector3d(-0.13 - distance * (1.0 - way), -0.01, 0.08 + 0.04 * way + lifted) +
        wrist_tremor.At(t));
  }
  const int num_markers = conditions.num_object_markers;
  for (int m = 0; m < num_markers; ++m) {
    const double angle = (35.0 + 120.0 * m) * kTwoPi / 360.0, off = num_markers == 1 ? 0.0 : 18e-3;
    const Vector3d p_OM(off * std::cos(angle), off * std::sin(angle), kObjectHeight);
    std::vector<Vector3d>& path = reach.object_markers.emplace_back();
    for (const double t : reach.times) {
      path.push_back(conditions.is_object_left_behind ? p_OM : object.PoseAt(t) * p_OM);
    }
  }
  for (auto& path : reach.digits) Measure(conditions, random, path);
  Measure(conditions, random, reach.wrist);
  for (auto& path : reach.object_markers) Measure(conditions, random, path);
  if (conditions.is_swapped) std::swap(reach.digits[0], reach.digits[1]);
  return reach;
}

}  // namespace graspbench::protocol
