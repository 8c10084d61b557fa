#include "tests/human_study/protocol/hand_reach.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace graspbench::everyday {
namespace {

using Eigen::Vector3d;

constexpr double kPad = 7e-3;  // from the middle of a fingertip to its skin, and to its nail [m]
constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

double Ease(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

/** Frame of the hand: x from the wrist to the fingers, y to the thumb's side, z out of its back. */
struct Finger {
  Vector3d knuckle;
  std::array<double, 3> bones;

  double BendAt(int joint, double bend) const {
    return joint == 0 ? 0.75 * bend : joint == 1 ? 1.75 * bend : 2.35 * bend;
  }
  Vector3d TipAt(double bend) const {
    Vector3d p = knuckle;
    for (int i = 0; i < 3; ++i) {
      const double angle = BendAt(i, bend);
      p += bones[static_cast<size_t>(i)] * Vector3d(std::cos(angle), 0.0, -std::sin(angle));
    }
    return p;
  }
  Vector3d NailAt(double bend) const {
    const double angle = BendAt(2, bend);
    return TipAt(bend) + kPad * Vector3d(std::sin(angle), 0.0, std::cos(angle));
  }
};

struct Hand {
  std::array<Finger, 4> fingers;
  Vector3d saddle;
  double thumb = 0.0;  // from the saddle joint to the middle of the tip [m]
  Vector3d wrist;

  explicit Hand(RandomStream& person) {
    const double scale = person.NextUniform(0.9, 1.1);
    constexpr double kCarpus = 28e-3;
    constexpr std::array<double, 4> kMetacarpal{68.12e-3, 64.60e-3, 57.95e-3, 53.69e-3};
    constexpr std::array<std::array<double, 3>, 4> kPhalanges{{{39.78e-3, 22.38e-3, 15.82e-3},
                                                               {44.63e-3, 26.33e-3, 17.40e-3},
                                                               {41.37e-3, 25.65e-3, 17.30e-3},
                                                               {32.74e-3, 18.11e-3, 15.96e-3}}};
    constexpr std::array<double, 4> kAcross{22e-3, 2e-3, -17e-3, -34e-3};
    for (size_t k = 0; k < 4; ++k) {
      fingers[k].knuckle = scale * Vector3d(kCarpus + kMetacarpal[k], kAcross[k], 0.0);
      for (size_t i = 0; i < 3; ++i) fingers[k].bones[i] = scale * kPhalanges[k][i];
    }
    saddle = scale * Vector3d(18e-3, 20e-3, -12e-3);
    // Metacarpal, two phalanges; a thumb that opposes is a little bent.
    thumb = 0.95 * scale * person.NextUniform(0.88, 1.12) * (46.22e-3 + 31.57e-3 + 21.67e-3);
    wrist = scale * Vector3d(person.NextUniform(-12e-3, 6e-3), person.NextUniform(-28e-3, 28e-3),
                             person.NextUniform(4e-3, 16e-3));
  }
  /** On the thumb's arc about the saddle joint, towards `aim`. */
  Vector3d ThumbTowards(const Vector3d& aim) const {
    return saddle + thumb * (aim - saddle).normalized();
  }
};

/** A cylinder along y between thumb and index. */
struct Grip {
  Vector3d axis = Vector3d::Zero();       // a point of it
  Vector3d to_thumb = Vector3d::Zero();   // unit, from the axis
  Vector3d thumb_tip = Vector3d::Zero();  // its middle
  std::array<double, 4> bends{};          // of the fingers at touch
};

/** Bends the index until thumb and index are as far apart as the object is wide. */
Grip FindGrip(const Hand& hand, double radius, double side) {
  const double reach = radius + kPad;
  Grip grip;
  for (double bend = 0.3; bend < 1.2; bend += 0.005) {
    const Vector3d index = hand.fingers[0].TipAt(bend);
    // From the index the thumb is below or towards the wrist.
    double best = INFINITY;
    for (double angle = 0.2; angle < 1.6; angle += 0.01) {
      const Vector3d way(-std::sin(angle), 0.0, -std::cos(angle));
      Vector3d tip = index + 2.0 * reach * way;
      tip.y() = side;
      const double off = std::abs((tip - hand.saddle).norm() - hand.thumb);
      if (off >= best) continue;
      best = off;
      grip = {index + reach * way, way, tip, {}};
    }
    if (best < 1e-3) break;
  }
  for (size_t k = 0; k < 4; ++k) {
    double& bend = grip.bends[k];
    const auto gap = [&](double at) {
      Vector3d way = hand.fingers[k].TipAt(at) - grip.axis;
      way.y() = 0.0;
      return way.norm() - reach;
    };
    // One that does not get there stops where it is nearest.
    for (double at = bend = 0.1; at < 1.25 && gap(bend) > 0.0; at += 0.002) {
      if (gap(at) < gap(bend)) bend = at;
    }
  }
  return grip;
}

Reach MakeReachOfHand(const Conditions& conditions, const std::string& id, int trial,
                      bool is_pinch) {
  RandomStream person(id, "hand of bones");
  const Hand hand(person);
  const bool is_left = id.empty() || id.back() % 2 == 1;
  RandomStream random(id + "/" + std::to_string(trial), "reach of bones");
  constexpr std::array<double, 4> kDiameters{6e-3, 20e-3, 45e-3, 80e-3};
  const double radius = 0.5 * kDiameters[static_cast<size_t>(trial) % kDiameters.size()];
  const Grip grip = FindGrip(hand, radius, is_pinch ? 16e-3 : random.NextUniform(2e-3, 16e-3));

  Reach reach;
  reach.onset = random.NextUniform(0.4, 0.7);
  const double duration = random.NextUniform(0.7, 0.95);
  const double open_time = reach.onset + random.NextUniform(0.55, 0.65) * duration;
  reach.widest = open_time;
  std::array<double, 4> open{};
  for (size_t k = 0; k < 4; ++k) open[k] = grip.bends[k] - random.NextUniform(0.2, 0.35);
  const Vector3d thumb_open = hand.ThumbTowards(grip.thumb_tip + random.NextUniform(12e-3, 25e-3) *
                                                                     Vector3d(-0.3, 0.35, -1.0));
  // Half of all reaches begin with thumb and index together, the others with a loose hand.
  const bool starts_together = random.NextUnit() < 0.5;
  const Vector3d index_home = hand.fingers[0].TipAt(0.75);
  const Vector3d thumb_home =
      hand.ThumbTowards(starts_together ? Vector3d(index_home - Vector3d(0.0, 0.0, 2.0 * kPad))
                                        : Vector3d(index_home - Vector3d(0.02, -0.01, 0.05)));
  const double curled = random.NextUniform(1.05, 1.2);

  std::array<double, kNumDigits> touch{};
  double last = 0.0;
  for (size_t d = 0; d < kNumDigits; ++d) {
    touch[d] = reach.onset + duration + 0.02 * random.NextNormal();
    reach.touch_times[d] = reach.hold_times[d] = is_pinch && d > 1 ? kNever : touch[d];
    reach.release_times[d] = kNever;
    if (!std::isnan(reach.touch_times[d])) last = std::max(last, touch[d]);
  }
  reach.lift_off = last + random.NextUniform(0.15, 0.25);

  // From home to open to the touch, where it comes with speed and stays.
  const auto course = [&](double home, double wide, double touched, double touch_time, double t) {
    if (t < open_time) {
      return home + (wide - home) * Ease((t - reach.onset) / (open_time - reach.onset));
    }
    const double u = (t - open_time) / (touch_time - open_time);
    return u >= 1.0 ? touched : wide + (touched - wide) * (1.6 * u * u - 0.6 * u * u * u);
  };
  const double distance = conditions.distances[0];
  const auto palm_at = [&](double t) {
    const double way = Ease((t - reach.onset) / duration);
    const double lifted = Ease((t - reach.lift_off) / 0.9);
    Eigen::Isometry3d X_WH = Eigen::Isometry3d::Identity();
    X_WH.linear() = Eigen::AngleAxisd(0.5, Vector3d::UnitY()).matrix();
    X_WH.translation() = Vector3d(-distance * (1.0 - way), 0.05 * way, 0.15 + 0.15 * lifted);
    return X_WH;
  };
  const auto measured = [&](Vector3d p_H, const Eigen::Isometry3d& X_WH) -> Vector3d {
    if (is_left) p_H.y() *= -1.0;
    return X_WH * p_H + conditions.noise_sd *
                            Vector3d(random.NextNormal(), random.NextNormal(), random.NextNormal());
  };
  const Eigen::Isometry3d at_object = palm_at(reach.onset + duration);
  reach.object_markers.resize(static_cast<size_t>(conditions.num_object_markers));
  for (int i = 0; i / conditions.rate < reach.lift_off + 1.1; ++i) {
    const double t = i / conditions.rate;
    reach.times.push_back(t);
    const Eigen::Isometry3d X_WH = palm_at(t);
    const auto between = [&](const Vector3d& a, const Vector3d& b, double share) {
      return hand.ThumbTowards(a + share * (b - a));
    };
    const double opened = course(0.0, 1.0, 1.0, touch[0], t);
    const double closed = course(0.0, 0.0, 1.0, touch[0], t);
    const Vector3d thumb = t < open_time ? between(thumb_home, thumb_open, opened)
                                         : between(thumb_open, grip.thumb_tip, closed);
    reach.digits[0].push_back(measured(thumb + kPad * grip.to_thumb, X_WH));
    for (size_t k = 0; k < 4; ++k) {
      const double bend =
          is_pinch && k > 0 ? curled : course(0.75, open[k], grip.bends[k], touch[k + 1], t);
      reach.digits[k + 1].push_back(measured(hand.fingers[k].NailAt(bend), X_WH));
    }
    reach.wrist.push_back(measured(hand.wrist, X_WH));
    Eigen::Isometry3d X_WO = at_object;
    X_WO.translation().z() = X_WH.translation().z();
    for (size_t m = 0; m < reach.object_markers.size(); ++m) {
      constexpr std::array<double, 3> kAlong{0.07, -0.09, -0.07}, kOff{0.0, 0.0, 0.02};
      reach.object_markers[m].push_back(
          measured(grip.axis + Vector3d(kOff[m], kAlong[m], 0.0), X_WO));
    }
  }
  if (conditions.is_swapped) std::swap(reach.digits[0], reach.digits[1]);
  return reach;
}

}  // namespace

Reach MakeHandReach(const Conditions& conditions, const std::string& id, int trial) {
  return MakeReachOfHand(conditions, id, trial, false);
}

Reach MakePinchReach(const Conditions& conditions, const std::string& id, int trial) {
  return MakeReachOfHand(conditions, id, trial, true);
}

}  // namespace graspbench::everyday
