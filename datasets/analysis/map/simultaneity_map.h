#pragma once
/** @file
Where simultaneous contact matters: the effect of delaying one digit, in each region of grip and
object properties.

A pair is one hand, object, draw and region (one level of every factor), without delay and with the
first or last digit delayed by d seconds. With the measure y, the pair's effect is

    success, threshold, breaking force    0.1 s * sum_d d (y_d - y_0) / sum_d d^2
    push                                  mean over d of the sign of (y_d - y_0)

that is, per 100 ms, from a least-squares line through the trial without delay. For the push it is a
sign, because a digit that never touches counts as the farthest push without a size; its mean is the
share of pairs with a longer push minus the share with a shorter one. Grip thresholds enter as
binary logarithms; a draw that no grip held counts as one step above the largest grip. A lost object
has a breaking force of 0 N.

A cell of the map is a hand, a late digit and no, one or two levels; its estimate is the mean over
its pairs. 95 % intervals come from resampling objects (core/statistics/bootstrap.h). If the means
of all objects are equal, the interval allows for pairs that may yet differ: Wilson's interval of
their share, each by one unit, and for success and push within the possible range (-1 to 1 for a
sign). p tests the hypothesis that the effect of an object is symmetric about zero, by random signs
of all objects' sums (R. A. Fisher, The Design of Experiments (1935), 21),

    p = (1 + resamples with |sum| at least as large) / (1 + resamples),

adjusted for the false discovery rate (multiple_tests.h) in two families per measure: cells over all
regions, and cells of single regions, both over all hands and late digits. A cell's verdict:

    costs, gains   the interval excludes zero and the adjusted p is at most 0.05
    none           the interval lies within the smallest effect of interest (MapMeasure::bound)
    ceiling        as none, but at least 97.5 % succeed without delay: the grip's reserve may hide
                   an effect
    floor          not costs or gains, and at most 2.5 % succeed without delay: nothing left to lose
    undecided      otherwise, with the number of objects that would decide it, if larger than the
                   present one

The correlation in trials without delay is reported too but decides nothing: if a common cause, such
as the object's pose, affects both times and success, it is not an effect of the times
(common_cause.h). */

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/statistics/bootstrap.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** Quantities that are compared within a pair. */
enum class MapMeasure { kSuccess, kThreshold, kPush, kBreakingForce };
struct MapMeasureRow {
  MapMeasure value;
  const char* name;   ///< in files
  const char* label;  ///< with the unit of the effect
  double scale;       ///< displayed number = scale * effect
  int decimals;
  double harm;   ///< sign of an effect that costs
  double bound;  ///< smallest effect of interest, unscaled; infinite: never "none"
};
inline constexpr MapMeasureRow kMapMeasures[] = {
    {MapMeasure::kSuccess, "success", "success, points for 100 ms", 100.0, 1, -1.0, 0.02},
    {MapMeasure::kThreshold, "threshold", "grip threshold, doublings for 100 ms", 1.0, 3, 1.0,
     0.07},
    {MapMeasure::kPush, "push", "pushed farther until all touch, net share of pairs [%]", 100.0, 0,
     1.0, 0.1},
    {MapMeasure::kBreakingForce, "breaking_force", "breaking force, N for 100 ms", 1.0, 2, -1.0,
     0.05}};

struct MapFactor {
  std::string name;
  std::vector<std::string> levels;
  bool scales_draws = false;  ///< levels scale the object's offset in the draws
};

/** One trial; NaN for a measure that was not taken. */
struct MapTrial {
  std::string hand, object;
  int draw = 0;
  std::vector<size_t> levels;  ///< of each factor
  LateDigit late = LateDigit::kNone;
  double delay = 0.0;                                  ///< [s]
  std::array<double, std::size(kMapMeasures)> values;  ///< 0 or 1; log2; [m], infinite: never; [N]
  double first_to_last = kUnset;                       ///< GFT [s]; infinite: a digit never touched
  double offset = kUnset, turn = kUnset;  ///< sizes of the draw's placement error [m], [rad]
  std::string name;                       ///< as commands accept it
};

struct MapData {
  std::vector<MapFactor> factors;
  std::vector<MapTrial> trials;
};

enum class MapVerdict { kCosts, kGains, kNone, kCeiling, kFloor, kUndecided };
struct MapVerdictRow {
  MapVerdict value;
  const char* name;
};
inline constexpr MapVerdictRow kMapVerdicts[] = {
    {MapVerdict::kCosts, "costs"}, {MapVerdict::kGains, "gains"},
    {MapVerdict::kNone, "none"},   {MapVerdict::kCeiling, "ceiling"},
    {MapVerdict::kFloor, "floor"}, {MapVerdict::kUndecided, "undecided"}};

/** A level of a factor, by indices. */
struct MapLevel {
  size_t factor = 0, level = 0;
};

struct MapCell {
  std::string hand;
  LateDigit late = LateDigit::kNone;
  MapMeasure measure = MapMeasure::kSuccess;
  std::vector<MapLevel> where;  ///< none (everywhere), one or two
  int num_pairs = 0, num_objects = 0;
  double undelayed = kUnset;  ///< mean without delay; for success its rate
  double estimate = kUnset;
  Answer<Interval> interval = NoAnswer{"no pair"};
  double p = kUnset, adjusted_p = kUnset;
  MapVerdict verdict = MapVerdict::kUndecided;
  /** For an undecided cell, the number of objects at which the interval's half-width would equal
  the difference to be decided, if further objects were like these; 0: unknown, or not more than
  present. */
  int num_objects_to_decide = 0;
  /** For success, names of the first delayed trials whose result differs from that without
  delay. */
  std::vector<std::string> changed;
};

struct SimultaneityMap {
  std::vector<MapFactor> factors;
  std::vector<std::string> hands;
  std::vector<MapCell> cells;  ///< by measure, hand, late digit; everywhere, levels, two levels
};

/** Computes the map. @pre every trial has a level of each factor. */
SimultaneityMap MapSimultaneity(const MapData& data);

/** Returns "last" or "first". */
const char* NameLateDigit(LateDigit late);

/** Returns null if there is no such cell. */
const MapCell* FindCell(const SimultaneityMap& map, MapMeasure measure, const std::string& hand,
                        LateDigit late, const std::vector<MapLevel>& where);

/** Returns "grip margin 1.5, friction 0.6", or "everywhere". */
std::string NameWhere(const SimultaneityMap& map, const MapCell& cell);

/** Returns "-5.6 (-9.5 to -2.1)" in the measure's unit, or why there is no interval. */
std::string FormatEffect(const MapCell& cell);

/** Describes for a hand in how many regions a late last digit costs or gains in this measure, makes
no difference, or is not decided; empty if there are no such regions. */
std::string DescribeMap(const SimultaneityMap& map, const std::string& hand, MapMeasure measure);

Json ToJson(const SimultaneityMap& map);

/* How finely a map resolves success. For the regions (cells of one or two levels, first and last
digit) of a hand with at least 150 pairs of 20 objects, with [l, h] the cell's 95 % interval per 100
ms,

    half-width = (h - l) / 2, narrow: at most 0.05 (5 points of success)

The limit is graspbench's own: except in wide regions, the map detects a late digit that costs 5
points per 100 ms. */
inline constexpr int kPairsOfLargeRegion = 150, kObjectsOfLargeRegion = 20;
inline constexpr double kNarrowHalfWidth = 0.05;  ///< of a rate, per 100 ms

struct MapPrecision {
  int num_regions = 0;               ///< with pairs
  int num_large = 0;                 ///< with at least 150 pairs of 20 objects
  std::vector<const MapCell*> wide;  ///< large regions with wide intervals, the widest first
  int num_narrow() const { return num_large - static_cast<int>(wide.size()); }
};

/** Returns half of the interval's width; NaN without an interval. */
double CalcHalfWidth(const MapCell& cell);

/** Assesses the precision of a hand's regions. A large region without an interval counts as wide.
The result points into `map`. */
MapPrecision FindPrecision(const SimultaneityMap& map, const std::string& hand);

/** Returns "Of 158 regions with at least 150 pairs of 20 objects, 150 have a 95 % interval with a
half-width of at most 5 points of success for 100 ms.", or that no region is so large. */
std::string DescribePrecision(const MapPrecision& precision);

/* Effect of a late digit on each object over all regions of a map: success rates without and with
each delay, and the effect as above. The 95 % interval comes from resampling the object's pairs, so
it is valid for this object under the map's regions and draws only. It is not adjusted: of twenty
objects one excludes zero by chance. */
struct RateWithDelay {
  double delay = 0.0;  ///< [s]
  double rate = kUnset;
};

struct ObjectEffect {
  std::string hand, object;
  LateDigit late = LateDigit::kNone;
  int num_pairs = 0;
  std::vector<RateWithDelay> rates;  ///< success rates, without delay first
  double estimate = kUnset;          ///< effect on success per 100 ms
  Answer<Interval> interval = NoAnswer{"no pair"};
  /** Names of the first delayed trials whose result differs from that without delay. */
  std::vector<std::string> changed;
};

/** Returns "By object: with the last digit 0.3 s late success falls most for ..", for a hand;
  empty if it has no such pairs. */
std::string DescribeObjects(const std::vector<ObjectEffect>& effects, const std::string& hand);

/** Lists effects by hand and late digit, the largest loss first. */
std::vector<ObjectEffect> ListObjectEffects(const MapData& data);

}  // namespace graspbench
