#pragma once

/** Worlds whose answer is known: trials drawn from a causal model, to test what the map finds.
 *
 *  A trial holds if  intercept + ability - cost * GFT + luck > 0,  with ability the sum of object,
 *  region and placement, and luck logistic. A paired trial shares all of it but the GFT, which the
 *  delay changes; then each trial's outcome flips on its own with a small probability. Cost is not
 *  0 only where lateness matters; the offset lengthens the GFT only where it is the common cause.
 *  Drive law and speed decide only the GFT, grip, friction and mass only the ability. */

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "datasets/analysis/map/common_cause.h"

namespace graspbench {

struct PlantedWorld {  ///< graspbench::World is the physics
  MapData data;
  MapFinding truth = MapFinding::kUndecided;
  std::string cause;    ///< of a common-cause world
  double effect = 0.0;  ///< of the last digit's delay on the success rate, per 100 ms
};

namespace planted {

constexpr int kNumObjects = 21;
constexpr int kNumDraws = 3;
constexpr size_t kNumRegions = 28;
constexpr int kDesignSwaps = 4000;
constexpr double kMainEffectWeight = 100.0;  ///< levels come equally often before pairs do
constexpr double kShortDelay = 0.1, kLongDelay = 0.3;  ///< [s]
constexpr double kEffectUnit = 0.1;                    ///< [s]
constexpr double kTurnHalfWidth = 0.2;                 ///< [rad]
constexpr double kOffsetUnit = 0.01;                   ///< of the slopes on the offset [m]
constexpr double kLongestGft = 0.8;                    ///< of natural ones: closing ends [s]
constexpr double kGftJitter = 0.04;    ///< relative, of the measured GFT between paired trials
constexpr double kRestingPush = 2e-4;  ///< [m]
constexpr double kMargins[] = {1.2, 1.5, 2.0, 3.0};
constexpr double kHalfWidths[] = {0.002, 0.01};                     ///< [m]
constexpr double kLowestThreshold = -3.0, kHighestThreshold = 4.0;  ///< searched [log2]
constexpr double kHighestCost = 10.0;  ///< latent per second; beyond, natural GFTs leave no success
                                       ///< to lose where it acts: the effect falls again
constexpr double kHighestIntercept = 30.0;
constexpr int kBisections = 40;
constexpr double kPi = 3.14159265358979323846;

enum Factor { kDrive, kSpeed, kGrip, kFriction, kOffset, kMass };

inline const std::vector<MapFactor>& Factors() {
  static const std::vector<MapFactor> factors = {
      {"drive law", {"position", "force"}}, {"speed after touch", {"full", "slow"}},
      {"grip", {"1.2", "1.5", "2", "3"}},   {"friction", {"0.4", "0.8"}},
      {"offset", {"2 mm", "10 mm"}},        {"mass", {"light", "heavy"}}};
  return factors;
}

inline double Logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

/** All by inverse transform: the standard library's distributions differ between vendors. */
class Source {
 public:
  Source(MapFinding kind, uint64_t seed)
      : bits_(seed * 0x9E3779B97F4A7C15ull + static_cast<uint64_t>(kind)) {}
  double Unit() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1p-53; }
  double Within(double low, double high) { return low + (high - low) * Unit(); }
  bool Chance(double probability) { return Unit() < probability; }
  size_t Index(size_t size) {
    return std::min(static_cast<size_t>(Unit() * static_cast<double>(size)), size - 1);
  }
  double Luck() {
    const double u = Unit();
    return std::log(u / (1.0 - u));
  }
  double Spread(double deviation) { return deviation * std::sqrt(3.0) / kPi * Luck(); }

 private:
  std::mt19937_64 bits_;
};

using Region = std::vector<size_t>;  ///< a level of each factor

/** How far the first `kNumRegions` are from having levels, and pairs of levels, equally often. */
inline double Imbalance(const std::vector<Region>& cells) {
  const std::vector<MapFactor>& factors = Factors();
  double sum = 0.0;
  for (size_t a = 0; a < factors.size(); ++a) {
    for (size_t b = a; b < factors.size(); ++b) {
      const size_t num_a = factors[a].levels.size();
      const size_t num_b = factors[b].levels.size();
      std::vector<double> counts(num_a * num_b, 0.0);
      for (size_t i = 0; i < kNumRegions; ++i) counts[cells[i][a] * num_b + cells[i][b]] += 1.0;
      for (size_t i = 0; i < counts.size(); ++i) {
        if (a == b && i / num_b != i % num_b) continue;
        const double cell_count = static_cast<double>(a == b ? num_a : counts.size());
        const double excess = counts[i] - static_cast<double>(kNumRegions) / cell_count;
        sum += (a == b ? kMainEffectWeight : 1.0) * excess * excess;
      }
    }
  }
  return sum;
}

inline std::vector<Region> BalancedRegions(Source& source) {
  std::vector<Region> cells = {{}};
  for (const MapFactor& factor : Factors()) {
    std::vector<Region> longer;
    for (const Region& cell : cells) {
      for (size_t level = 0; level < factor.levels.size(); ++level) {
        longer.push_back(cell);
        longer.back().push_back(level);
      }
    }
    cells = std::move(longer);
  }
  for (size_t i = 0; i < kNumRegions; ++i) {
    std::swap(cells[i], cells[i + source.Index(cells.size() - i)]);
  }
  double best = Imbalance(cells);
  for (int i = 0; i < kDesignSwaps; ++i) {
    const size_t in = source.Index(kNumRegions);
    const size_t out = kNumRegions + source.Index(cells.size() - kNumRegions);
    std::swap(cells[in], cells[out]);
    const double now = Imbalance(cells);
    if (now <= best) {
      best = now;
    } else {
      std::swap(cells[in], cells[out]);
    }
  }
  cells.resize(kNumRegions);
  std::sort(cells.begin(), cells.end());
  return cells;
}

/** What a world's seed decides once; slopes are on the latent (logistic) scale. */
struct Model {
  double success = 0.0;  ///< rate without delay, met by the intercept
  double effect = 0.0;   ///< met by the cost
  double intercept = 0.0, cost = 0.0;
  int exposed_factor = -1;  ///< lateness costs only at one level of it; -1: everywhere
  size_t exposed_level = 0;
  double flip = 0.0;
  // Ability:
  double object_spread = 0.0, object_friction_spread = 0.0, placement_spread = 0.0;
  double margin = 0.0;  ///< per doubling
  double friction = 0.0, mass = 0.0;
  double success_per_offset = 0.0, success_per_turn = 0.0;
  // Log of the GFT:
  double median_gft = 0.0;
  double gft_per_offset = 0.0, gft_per_turn = 0.0;
  double drive = 0.0, speed = 0.0;
  double gft_object_spread = 0.0, gft_placement_spread = 0.0, gft_unit_spread = 0.0;
  // Measures:
  double missed = 0.0, missed_in_failures = 1.0;  ///< share of trials; times as often
  double unknown_gft = 0.0;
  double push_speed = 0.0;  ///< [m/s]
  bool has_grip_measures = false;
  double breaking_force = 0.0;  ///< per latent unit [N]

  double MissedShare(bool holds) const {
    const double mean = success + missed_in_failures * (1.0 - success);
    return missed / mean * (holds ? 1.0 : missed_in_failures);
  }
};

inline Model DrawModel(MapFinding kind, Source& source) {
  Model m;
  const bool matters = kind == MapFinding::kMatters;
  const bool common_cause = kind == MapFinding::kCommonCause;
  m.success = source.Within(matters ? 0.58 : 0.45, 0.82);
  if (matters) {
    const bool half = source.Chance(0.5);
    // Twice as strong in half the regions: beyond this average those would have nothing left.
    m.effect = -source.Within(0.025, half ? 0.05 : 0.08);
    if (half) {
      constexpr int kTwoLevels[] = {kDrive, kSpeed, kFriction, kOffset, kMass};
      m.exposed_factor = kTwoLevels[source.Index(std::size(kTwoLevels))];
      m.exposed_level = source.Index(2);
    }
  }
  m.flip = source.Within(0.015, 0.04);
  m.object_spread = source.Within(0.9, 1.5);
  m.object_friction_spread = source.Within(0.1, 0.4);
  m.placement_spread = source.Within(0.2, 0.7);
  m.margin = source.Within(0.5, 1.2);
  m.friction = source.Within(0.1, 0.8);
  m.mass = -source.Within(0.0, 0.5);
  m.success_per_offset = common_cause ? -source.Within(2.5, 4.0) : -source.Within(0.0, 0.8);
  m.gft_per_offset = common_cause ? source.Within(1.2, 1.8) : 0.0;
  // At no offset: lower where offsets lengthen it, so that worlds' typical GFTs are alike.
  m.median_gft = common_cause ? source.Within(0.03, 0.07) : source.Within(0.06, 0.13);
  // The turn decides at most one of the two, so that the offset alone is the common cause.
  const double turn_share = source.Unit();
  const double turn_size = source.Within(1.0, 4.0);
  if (turn_share < 0.4) m.success_per_turn = -turn_size;
  if (turn_share > 0.7) m.gft_per_turn = turn_size;
  m.drive = source.Within(-0.2, 0.2);
  m.speed = source.Within(0.0, 0.4);
  m.gft_object_spread = source.Within(0.1, 0.25);
  m.gft_placement_spread = source.Within(0.1, 0.25);
  m.gft_unit_spread = source.Within(0.45, 0.75);
  m.missed = source.Within(0.012, 0.042);
  if (matters || common_cause) m.missed_in_failures = source.Within(2.0, 5.0);
  m.unknown_gft = source.Within(0.0, 0.006);
  m.push_speed = source.Within(0.01, 0.05);
  m.has_grip_measures = source.Chance(0.5);
  m.breaking_force = source.Within(1.0, 4.0);
  return m;
}

/** An object, region and draw: what its five trials share. */
struct Unit {
  int object = 0, draw = 0;
  const Region* region = nullptr;
  double offset = 0.0, turn = 0.0;
  double ability = 0.0, luck = 0.0;
  bool exposed = false;
  double gft = 0.0, middle = 0.0;  ///< contacts at 0, middle * gft and gft
  double touch_luck = 0.0;
  double mobility = 0.0;  ///< times the push

  double Gft(LateDigit late, double delay) const {
    if (late == LateDigit::kFirst) return std::max(delay, gft) - std::min(delay, middle * gft);
    return gft + (late == LateDigit::kLast ? delay : 0.0);
  }
  /** Before luck. */
  double Latent(const Model& m, double with_gft) const {
    return m.intercept + ability - (exposed ? m.cost * with_gft : 0.0);
  }
};

inline std::vector<Unit> DrawUnits(const Model& m, const std::vector<Region>& regions,
                                   Source& source) {
  std::vector<Unit> units;
  for (int object = 0; object < kNumObjects; ++object) {
    const double ability = source.Spread(m.object_spread);
    const double on_friction = source.Spread(m.object_friction_spread);
    const double object_gft = source.Spread(m.gft_object_spread);
    const double mobility = std::exp(source.Spread(0.3));
    for (int draw = 0; draw < kNumDraws; ++draw) {
      // A numbered draw is one placement in units of the half-width, the same in all regions.
      const double x = source.Within(-1.0, 1.0);
      const double y = source.Within(-1.0, 1.0);
      const double turn = kTurnHalfWidth * source.Unit();
      const double placement = source.Spread(m.placement_spread);
      const double placement_gft = source.Spread(m.gft_placement_spread);
      for (const Region& region : regions) {
        Unit u;
        u.object = object;
        u.draw = draw;
        u.region = &region;
        u.offset = kHalfWidths[region[kOffset]] * std::hypot(x, y);
        u.turn = turn;
        const double rough = static_cast<double>(region[kFriction]) - 0.5;
        u.ability = ability + placement + (m.friction + on_friction) * rough +
                    m.margin * std::log2(kMargins[region[kGrip]]) +
                    m.mass * static_cast<double>(region[kMass]) +
                    m.success_per_offset * u.offset / kOffsetUnit + m.success_per_turn * turn;
        u.luck = source.Luck();
        u.exposed = m.exposed_factor < 0 || region[m.exposed_factor] == m.exposed_level;
        const double log_gft = object_gft + placement_gft +
                               m.drive * static_cast<double>(region[kDrive]) +
                               m.speed * static_cast<double>(region[kSpeed]) +
                               m.gft_per_offset * u.offset / kOffsetUnit + m.gft_per_turn * turn +
                               source.Spread(m.gft_unit_spread);
        u.gft = std::min(m.median_gft * std::exp(log_gft), kLongestGft);
        u.middle = source.Unit();
        u.touch_luck = source.Unit();
        u.mobility = mobility * std::exp(source.Spread(0.2));
        units.push_back(u);
      }
    }
  }
  return units;
}

/** Mean success probability: over luck and flips, of these objects, regions and placements. */
inline double SuccessRate(const Model& m, const std::vector<Unit>& units, LateDigit late,
                          double delay) {
  double sum = 0.0;
  for (const Unit& u : units) sum += Logistic(u.Latent(m, u.Gft(late, delay)));
  return m.flip + (1.0 - 2.0 * m.flip) * sum / static_cast<double>(units.size());
}

/** Slope through the undelayed rate, by least squares over both delays. */
inline double LastDigitEffect(const Model& m, const std::vector<Unit>& units) {
  const double rate = SuccessRate(m, units, LateDigit::kNone, 0.0);
  double products = 0.0, squares = 0.0;
  for (double delay : {kShortDelay, kLongDelay}) {
    products += delay * (SuccessRate(m, units, LateDigit::kLast, delay) - rate);
    squares += delay * delay;
  }
  return products / squares * kEffectUnit;
}

template <typename IsTooLow>
double Bisect(double low, double high, const IsTooLow& is_too_low) {
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (is_too_low(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

inline void MeetSuccess(const std::vector<Unit>& units, Model& m) {
  m.intercept = Bisect(-kHighestIntercept, kHighestIntercept, [&](double intercept) {
    m.intercept = intercept;
    return SuccessRate(m, units, LateDigit::kNone, 0.0) < m.success;
  });
}

inline void MeetTargets(const std::vector<Unit>& units, Model& m) {
  if (m.effect < 0.0) {
    m.cost = Bisect(0.0, kHighestCost, [&](double cost) {
      m.cost = cost;
      MeetSuccess(units, m);
      return LastDigitEffect(m, units) > m.effect;
    });
  }
  MeetSuccess(units, m);
}

inline MapTrial MakeTrial(const Model& m, const Unit& u, LateDigit late, double delay,
                          Source& source) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double gft = u.Gft(late, delay);
  const double latent = u.Latent(m, gft) + u.luck;
  const bool holds = (latent > 0.0) != source.Chance(m.flip);
  const bool missed = u.touch_luck < m.MissedShare(holds);
  const double measured = gft * std::exp(source.Spread(kGftJitter));
  const bool unknown = source.Chance(m.unknown_gft);

  const Region& region = *u.region;
  MapTrial trial;
  trial.hand = "tum";
  char text[96];
  std::snprintf(text, sizeof(text), "object%02d", u.object);
  trial.object = text;
  trial.draw = u.draw;
  trial.levels = region;
  trial.late = late;
  trial.delay = delay;
  trial.first_to_last = unknown ? kNan : missed ? kNever : measured;
  trial.offset = u.offset;
  trial.turn = u.turn;
  const double push = kRestingPush + m.push_speed * u.mobility * measured;
  // The margin at which the latent would be 0; a flip does not change it.
  const double threshold = std::log2(kMargins[region[kGrip]]) - latent / m.margin;
  const double force = holds ? m.breaking_force * std::log1p(std::exp(latent)) : 0.0;
  trial.values = {holds ? 1.0 : 0.0,
                  m.has_grip_measures
                      ? std::min(std::max(threshold, kLowestThreshold), kHighestThreshold)
                      : kNan,
                  missed ? kNever : push, m.has_grip_measures ? force : kNan};
  std::string cell;
  for (size_t level : region) cell += std::to_string(level);
  const char* digit = "none";
  if (late != LateDigit::kNone) digit = late == LateDigit::kLast ? "last" : "first";
  std::snprintf(text, sizeof(text), "tum:%s:%s:%d:%s:%.1f", trial.object.c_str(), cell.c_str(),
                u.draw, digit, delay);
  trial.name = text;
  return trial;
}

}  // namespace planted

inline PlantedWorld MakeWorld(MapFinding kind, uint64_t seed) {
  if (kind == MapFinding::kUndecided) throw std::invalid_argument("no world is undecided");
  planted::Source source(kind, seed);
  planted::Model model = planted::DrawModel(kind, source);
  const std::vector<planted::Region> regions = planted::BalancedRegions(source);
  const std::vector<planted::Unit> units = planted::DrawUnits(model, regions, source);
  planted::MeetTargets(units, model);

  PlantedWorld world;
  world.truth = kind;
  if (kind == MapFinding::kCommonCause) world.cause = "the object's offset";
  world.effect = planted::LastDigitEffect(model, units);
  world.data.factors = planted::Factors();
  constexpr std::pair<LateDigit, double> kArms[] = {{LateDigit::kNone, 0.0},
                                                    {LateDigit::kLast, planted::kShortDelay},
                                                    {LateDigit::kLast, planted::kLongDelay},
                                                    {LateDigit::kFirst, planted::kShortDelay},
                                                    {LateDigit::kFirst, planted::kLongDelay}};
  world.data.trials.reserve(units.size() * std::size(kArms));
  for (const planted::Unit& unit : units) {
    for (const auto& [late, delay] : kArms) {
      world.data.trials.push_back(planted::MakeTrial(model, unit, late, delay, source));
    }
  }
  return world;
}

/** What the map says of a world. */
struct MapJudgement {
  MapFinding finding;
  std::string cause;
  double estimate;
  Interval interval;
};
MapJudgement JudgeWorld(PlantedWorld world);

}  // namespace graspbench
