#pragma once
/** @file
Where it matters that the digits touch at once: what a digit that is made late changes, region by
region of how the hand grips and of what it grips.

A pair is one hand, object, draw and region (one level of every factor), without delay and with the
first or last digit d seconds late. Of the measure y the pair's effect is

    success, threshold, breaking force    0.1 s * sum_d d (y_d - y_0) / sum_d d^2
    push                                  mean over d of the sign of (y_d - y_0)

so for 100 ms, of a least squares line through the trial without delay; of the push the share of
pairs in which the late digit pushes farther less that in which it pushes less far, because a
digit that never touches counts as the farthest push and has no size. A grip threshold enters as
its binary logarithm; a draw that no grip held counts as one step above the largest. An object
that was lost breaks at 0 N.

A cell of the map is a hand, a late digit and one or two levels; its estimate is the mean over its
pairs. 95 % intervals come from drawing objects with replacement (core/statistics/bootstrap.h); of
objects whose means are all the same they say how many pairs may yet differ, by Wilson's interval of
those that do: by one, and of success and push within what is possible (-1 to 1 of a sign). p is of
the hypothesis that the effect of an object is as often above as below zero: the signs of all
objects' sums are drawn (R. A. Fisher, The Design of Experiments (1935), 21),

    p = (1 + draws with a sum at least as large) / (1 + draws),

adjusted for the false discovery rate (multiple_tests.h) in two families of each measure: what
holds everywhere, over hands and late digits, and what holds in a region, over all regions. A cell's
verdict:

    costs, gains   the interval excludes zero and the adjusted p is at most 0.05
    none           the interval lies within the smallest effect of interest (MapMeasure::bound)
    ceiling        none, but without delay at least 97.5 % succeed: the grip's reserve may hide it
    floor          without delay at most 2.5 % succeed: nothing is left to lose
    undecided      else, with the number of objects that would decide it where it is more
                   than there are

A correlation among trials without delay stands beside this and decides nothing: where both times
and success follow from a common cause, as where the object lay, it is no effect of the times
(common_cause.h). */

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/statistics/bootstrap.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** What is asked of every pair. */
enum class MapMeasure { kSuccess, kThreshold, kPush, kBreakingForce };
struct MapMeasureRow {
  MapMeasure value;
  const char* name;   ///< in files
  const char* label;  ///< with the unit of the effect
  double scale;       ///< times the effect
  int decimals;
  double harm;   ///< sign of an effect that costs
  double bound;  ///< the smallest effect of interest, unscaled; infinite: none is called none
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
  bool scales_draws = false;  ///< its levels scale how far draws put the object off
};

/** One trial; NaN where a measure was not asked for. */
struct MapTrial {
  std::string hand, object;
  int draw = 0;
  std::vector<size_t> levels;  ///< of each factor
  LateDigit late = LateDigit::kNone;
  double delay = 0.0;                                  ///< [s]
  std::array<double, std::size(kMapMeasures)> values;  ///< 0 or 1; log2; [m], infinite: never; [N]
  double first_to_last = kUnset;                       ///< GFT [s]; infinite: a digit never touched
  double offset = kUnset, turn = kUnset;  ///< sizes of the draw's placement error [m], [rad]
  std::string name;                       ///< as commands take it
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

/** A level of a factor, by their places. */
struct MapLevel {
  size_t factor = 0, level = 0;
};

struct MapCell {
  std::string hand;
  LateDigit late = LateDigit::kNone;
  MapMeasure measure = MapMeasure::kSuccess;
  std::vector<MapLevel> where;  ///< none: everywhere; one; or two
  int num_pairs = 0, num_objects = 0;
  double undelayed = kUnset;  ///< mean without delay: rate of success
  double estimate = kUnset;
  Answer<Interval> interval = NoAnswer{"no pair"};
  double p = kUnset, adjusted_p = kUnset;
  MapVerdict verdict = MapVerdict::kUndecided;
  /** Of an undecided cell: objects with which the interval would be half as wide as what is to be
  decided, were they like these; 0: not known. */
  int num_objects_to_decide = 0;
  /** Of success: late trials that ended otherwise than without delay, the first ones. */
  std::vector<std::string> changed;
};

struct SimultaneityMap {
  std::vector<MapFactor> factors;
  std::vector<std::string> hands;
  std::vector<MapCell> cells;  ///< by measure, hand, late digit; everywhere, levels, two levels
};

/** @pre every trial has a level of each factor. */
SimultaneityMap MapSimultaneity(const MapData& data);

/** "last", "first". */
const char* NameLateDigit(LateDigit late);

/** Null: no such cell. */
const MapCell* FindCell(const SimultaneityMap& map, MapMeasure measure, const std::string& hand,
                        LateDigit late, const std::vector<MapLevel>& where);

/** "grip margin 1.5, friction 0.6"; "everywhere". */
std::string NameWhere(const SimultaneityMap& map, const MapCell& cell);

/** "-5.6 (-9.5 to -2.1)" in the measure's unit; why there is no interval. */
std::string FormatEffect(const MapCell& cell);

/** Two sentences for a hand: where a late last digit costs of this measure, where it does not, and
where that is not known; empty: it was not asked. */
std::string DescribeMap(const SimultaneityMap& map, const std::string& hand, MapMeasure measure);

Json ToJson(const SimultaneityMap& map);

/* How finely a map of simultaneity resolves success. Of the regions (cells of one or two levels,
first and last digit) of a hand that have at least 150 pairs of 20 objects, with [l, h] the cell's
95 % interval for 100 ms,

    half-width = (h - l) / 2, narrow: at most 0.05 (5 points of success)

The bar is graspbench's own: a late digit that costs 5 points for 100 ms is seen in a region, unless
the region is wide. */
inline constexpr int kPairsOfLargeRegion = 150, kObjectsOfLargeRegion = 20;
inline constexpr double kNarrowHalfWidth = 0.05;  ///< of a rate, for 100 ms

struct MapPrecision {
  int num_regions = 0;               ///< with pairs
  int num_large = 0;                 ///< of them with 150 pairs of 20 objects
  std::vector<const MapCell*> wide;  ///< of the large ones, the widest first
  int num_narrow() const { return num_large - static_cast<int>(wide.size()); }
};

/** Half of the interval's width; NaN without an interval. */
double CalcHalfWidth(const MapCell& cell);

/** The result points into `map`. A large region without an interval is wide. */
MapPrecision FindPrecision(const SimultaneityMap& map, const std::string& hand);

/** "Of 158 regions with at least 150 pairs of 20 objects, 150 have a 95 % interval with a
half-width of at most 5 points of success for 100 ms."; or that no region is so large. */
std::string DescribePrecision(const MapPrecision& precision);

/* What a late digit does to each object, all regions of a map together: how often it was held
without delay and with each, and the effect as above. The 95 % interval comes from drawing the
object's pairs with replacement: it is of this object under the map's regions and draws, and says
nothing of other objects. It is not adjusted: of twenty objects one excludes zero by chance. */
struct RateWithDelay {
  double delay = 0.0;  ///< [s]
  double rate = kUnset;
};

struct ObjectEffect {
  std::string hand, object;
  LateDigit late = LateDigit::kNone;
  int num_pairs = 0;
  std::vector<RateWithDelay> rates;  ///< of success; without delay first
  double estimate = kUnset;          ///< of success, for 100 ms
  Answer<Interval> interval = NoAnswer{"no pair"};
  /** Late trials that ended otherwise than without delay, the first ones. */
  std::vector<std::string> changed;
};

/** "By object: with the last digit 0.3 s late success falls most for ..": of a hand; empty: it has
no such pairs. */
std::string DescribeObjects(const std::vector<ObjectEffect>& effects, const std::string& hand);

/** By hand and late digit, the largest loss first. */
std::vector<ObjectEffect> ListObjectEffects(const MapData& data);

}  // namespace graspbench
