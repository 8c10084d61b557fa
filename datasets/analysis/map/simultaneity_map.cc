#include "datasets/analysis/map/simultaneity_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/base/enum_table.h"
#include "core/base/random.h"
#include "core/base/text/text.h"
#include "core/statistics/multiple_tests.h"
#include "core/statistics/proportion.h"
#include "datasets/analysis/map/map_pairs.h"

namespace graspbench {

namespace {

constexpr int kNumObjectResamples = 1999;
constexpr int kNumNamed = 3;
constexpr size_t kMostChangedOfObject = 3;

ObjectEffect MakeEffect(const std::vector<const MapPair*>& pairs, ObjectEffect effect) {
  const auto calc_mean = [&](const std::vector<size_t>& members) {
    double sum = 0.0;
    for (const size_t member : members) sum += pairs[member]->effect;
    return sum / static_cast<double>(members.size());
  };
  effect.num_pairs = static_cast<int>(pairs.size());
  std::map<double, std::pair<double, int>> sums;  // by delay
  const auto count = [&](double delay, double value) {
    sums[delay].first += value;
    ++sums[delay].second;
  };
  double sum = 0.0;
  for (const MapPair* pair : pairs) {
    sum += pair->effect;
    count(0.0, pair->undelayed);
    for (const auto& [delay, value] : pair->delayed) count(delay, value);
    const bool is_shown = !pair->changed.empty() && effect.changed.size() < kMostChangedOfObject;
    if (is_shown) effect.changed.push_back(pair->changed);
  }
  effect.estimate = sum / effect.num_pairs;
  for (const auto& [delay, total] : sums) {
    effect.rates.push_back({delay, total.first / total.second});
  }
  const std::string id =
      "object " + effect.hand + " " + NameLateDigit(effect.late) + " " + effect.object;
  const Answer<BootstrapInterval> drawn =
      CalcBootstrap(pairs.size(), calc_mean, id, kNumObjectResamples);
  effect.interval = drawn ? Answer<Interval>(drawn->interval) : Answer<Interval>(drawn.none());
  return effect;
}

}  // namespace

std::string DescribeObjects(const std::vector<ObjectEffect>& effects, const std::string& hand) {
  int num_all = 0, num_lose = 0, num_gain = 0;
  std::string most;
  for (const ObjectEffect& effect : effects) {
    if (effect.hand != hand || effect.late != LateDigit::kLast) continue;
    ++num_all;
    if (!effect.interval) continue;
    num_gain += effect.interval->low > 0.0;
    if (effect.interval->high >= 0.0) continue;
    ++num_lose;
    if (num_lose > kNumNamed) continue;
    most += (most.empty() ? "" : ", ") + effect.object + " " +
            FormatFixed(100.0 * effect.rates.front().rate, 0) + " to " +
            FormatFixed(100.0 * effect.rates.back().rate, 0) + " %";
  }
  if (num_all == 0) return "";
  std::string text = "By object: a late last digit lowers success on " + std::to_string(num_lose) +
                     " of " + FormatCount(num_all, "object") + " and raises it on " +
                     std::to_string(num_gain) + " (95 % intervals, not adjusted)";
  if (!most.empty()) text += "; most, from no to the longest delay: " + most;
  return text + ".";
}

std::vector<ObjectEffect> ListObjectEffects(const MapData& data) {
  std::vector<std::string> hands;
  for (const MapTrial& trial : data.trials) {
    if (std::count(hands.begin(), hands.end(), trial.hand) == 0) hands.push_back(trial.hand);
  }
  std::vector<ObjectEffect> effects;
  for (const std::string& hand : hands) {
    for (const LateDigit late : {LateDigit::kLast, LateDigit::kFirst}) {
      const std::vector<MapPair> pairs = ListMapPairs(data, hand, late, MapMeasure::kSuccess);
      std::map<std::string, std::vector<const MapPair*>> by_object;
      for (const MapPair& pair : pairs) by_object[pair.object].push_back(&pair);
      const auto begin = static_cast<std::ptrdiff_t>(effects.size());
      for (const auto& [object, members] : by_object) {
        ObjectEffect effect;
        effect.hand = hand;
        effect.object = object;
        effect.late = late;
        effects.push_back(MakeEffect(members, effect));
      }
      std::stable_sort(
          effects.begin() + begin, effects.end(),
          [](const ObjectEffect& a, const ObjectEffect& b) { return a.estimate < b.estimate; });
    }
  }
  return effects;
}

double CalcHalfWidth(const MapCell& cell) {
  return cell.interval ? 0.5 * (cell.interval->high - cell.interval->low) : kUnset;
}

MapPrecision FindPrecision(const SimultaneityMap& map, const std::string& hand) {
  MapPrecision precision;
  for (const MapCell& cell : map.cells) {
    if (cell.hand != hand || cell.measure != MapMeasure::kSuccess) continue;
    if (cell.where.empty() || cell.num_pairs == 0) continue;
    ++precision.num_regions;
    if (cell.num_pairs < kPairsOfLargeRegion || cell.num_objects < kObjectsOfLargeRegion) continue;
    ++precision.num_large;
    if (!(CalcHalfWidth(cell) <= kNarrowHalfWidth)) precision.wide.push_back(&cell);
  }
  std::stable_sort(
      precision.wide.begin(), precision.wide.end(),
      [](const MapCell* a, const MapCell* b) { return CalcHalfWidth(*a) > CalcHalfWidth(*b); });
  return precision;
}

std::string DescribePrecision(const MapPrecision& precision) {
  const std::string size = "at least " + std::to_string(kPairsOfLargeRegion) + " pairs of " +
                           std::to_string(kObjectsOfLargeRegion) + " objects";
  if (precision.num_large == 0) {
    return "None of " + FormatCount(precision.num_regions, "region") + " has " + size + ".";
  }
  return "Of " + FormatCount(precision.num_large, "region") + " with " + size + ", " +
         std::to_string(precision.num_narrow()) +
         " have a 95 % interval with a half-width of at most " +
         FormatFixed(100.0 * kNarrowHalfWidth, 0) + " points of success for 100 ms.";
}

namespace {

constexpr int kNumMapResamples = 1999;
constexpr double kFalseDiscoveryRate = 0.05;
constexpr double kCeiling = 0.975;
constexpr double kFloor = 0.025;
constexpr size_t kMostChanged = 3;

bool IsWithin(const MapPair& pair, const std::vector<MapLevel>& where) {
  return std::all_of(where.begin(), where.end(), [&](const MapLevel& level) {
    return pair.levels[level.factor] == level.level;
  });
}

/** Sums of an object's effects, and their number. */
struct ObjectSum {
  double sum = 0.0, count = 0.0;
};

double CalcPooledMean(const std::vector<ObjectSum>& objects, const std::vector<size_t>& members) {
  ObjectSum all;
  for (const size_t member : members) {
    all.sum += objects[member].sum;
    all.count += objects[member].count;
  }
  return all.sum / all.count;
}

/** What a change of one (an end, a doubling, a sign) would add to the pair's effect. */
double CalcUnitEffect(const MapPair& pair, MapMeasure measure) {
  auto delayed = pair.delayed;
  for (auto& [delay, value] : delayed) value = 1.0;
  return CalcPairEffect(measure, 0.0, delayed);
}

/** Where every object has the same mean nothing is left to draw: the share of pairs that differ
from it, at most, by Wilson's interval, times what they may differ by: a change of one, of a rate or
a sign as far as its scale goes. */
Interval CalcAlikeInterval(double mean, const std::vector<const MapPair*>& pairs,
                           MapMeasure measure) {
  double unit = 0.0;
  int num_other = 0;
  for (const MapPair* pair : pairs) {
    unit = std::max(unit, CalcUnitEffect(*pair, measure));
    num_other += pair->effect == mean ? 0 : 1;
  }
  const double share = CalcWilsonInterval(num_other, static_cast<int>(pairs.size())).high;
  const bool is_bounded = measure == MapMeasure::kSuccess || measure == MapMeasure::kPush;
  const double below = is_bounded ? mean + unit : unit, above = is_bounded ? unit - mean : unit;
  return {mean - share * below, mean + share * above};
}

Answer<Interval> CalcCellInterval(const std::vector<ObjectSum>& objects,
                                  const std::vector<const MapPair*>& pairs, MapMeasure measure,
                                  const std::string& id) {
  const auto calc_mean = [&](const std::vector<size_t>& members) {
    return CalcPooledMean(objects, members);
  };
  constexpr size_t kMinObjects = 5;
  const double first = objects.front().sum / objects.front().count;
  const bool are_alike = std::all_of(objects.begin(), objects.end(), [&](const ObjectSum& one) {
    return one.sum / one.count == first;
  });
  if (are_alike && objects.size() >= kMinObjects) return CalcAlikeInterval(first, pairs, measure);
  const Answer<BootstrapInterval> drawn =
      CalcBootstrap(objects.size(), calc_mean, id, kNumMapResamples);
  return drawn ? Answer<Interval>(drawn->interval) : Answer<Interval>(drawn.none());
}

double CalcSignP(const std::vector<ObjectSum>& objects, const std::string& id) {
  double observed = 0.0, size = 0.0;
  for (const ObjectSum& one : objects) {
    observed += one.sum;
    size += std::abs(one.sum);
  }
  RandomStream random(id, "signs");
  int num_as_large = 0;
  for (int k = 0; k < kNumMapResamples; ++k) {
    double sum = 0.0;
    for (const ObjectSum& one : objects) sum += random.NextIndex(2) == 0 ? one.sum : -one.sum;
    // Sums of the same numbers in another order differ in their last bits.
    num_as_large += std::abs(sum) >= std::abs(observed) - 1e-12 * size ? 1 : 0;
  }
  return (1.0 + num_as_large) / (1.0 + kNumMapResamples);
}

MapCell MakeCell(const std::vector<MapPair>& pairs, MapCell cell, const std::string& id) {
  std::map<std::string, ObjectSum> by_object;
  double undelayed = 0.0;
  std::vector<const MapPair*> own;
  for (const MapPair& pair : pairs) {
    if (!IsWithin(pair, cell.where)) continue;
    own.push_back(&pair);
    by_object[pair.object].sum += pair.effect;
    by_object[pair.object].count += 1.0;
    undelayed += pair.undelayed;
    const bool is_shown = cell.measure == MapMeasure::kSuccess && !pair.changed.empty();
    if (is_shown && cell.changed.size() < kMostChanged) cell.changed.push_back(pair.changed);
  }
  cell.num_pairs = static_cast<int>(own.size());
  if (own.empty()) return cell;
  std::vector<ObjectSum> objects;
  for (const auto& [name, sum] : by_object) objects.push_back(sum);
  cell.num_objects = static_cast<int>(objects.size());
  cell.undelayed = undelayed / cell.num_pairs;
  std::vector<size_t> all(objects.size());
  std::iota(all.begin(), all.end(), size_t{0});
  cell.estimate = CalcPooledMean(objects, all);
  cell.interval = CalcCellInterval(objects, own, cell.measure, id);
  cell.p = CalcSignP(objects, id);
  return cell;
}

/** Everywhere, then every level, then every two levels of two factors. */
std::vector<std::vector<MapLevel>> ListPlaces(const std::vector<MapFactor>& factors) {
  std::vector<MapLevel> levels;
  for (size_t factor = 0; factor < factors.size(); ++factor) {
    for (size_t level = 0; level < factors[factor].levels.size(); ++level) {
      levels.push_back({factor, level});
    }
  }
  std::vector<std::vector<MapLevel>> places = {{}};
  for (const MapLevel& level : levels) places.push_back({level});
  for (const MapLevel& a : levels) {
    for (const MapLevel& b : levels) {
      if (a.factor < b.factor) places.push_back({a, b});
    }
  }
  return places;
}

int CountObjectsToDecide(const MapCell& cell, double bound) {
  const double half_width = 0.5 * (cell.interval->high - cell.interval->low);
  const double size = std::abs(cell.estimate);
  const double wanted = std::max(size, bound - size);
  return static_cast<int>(std::ceil(cell.num_objects * std::pow(half_width / wanted, 2.0)));
}

void Decide(MapCell& cell) {
  const MapMeasureRow& measure = RowOf(kMapMeasures, cell.measure);
  if (!cell.interval) return;
  const bool excludes_zero = cell.interval->low > 0.0 || cell.interval->high < 0.0;
  const bool is_rate = cell.measure == MapMeasure::kSuccess;
  if (excludes_zero && cell.adjusted_p <= kFalseDiscoveryRate) {
    cell.verdict = cell.estimate * measure.harm > 0.0 ? MapVerdict::kCosts : MapVerdict::kGains;
  } else if (is_rate && cell.undelayed <= kFloor) {
    cell.verdict = MapVerdict::kFloor;
  } else if (cell.interval->low > -measure.bound && cell.interval->high < measure.bound) {
    cell.verdict = is_rate && cell.undelayed >= kCeiling ? MapVerdict::kCeiling : MapVerdict::kNone;
  } else {
    const int wanted = CountObjectsToDecide(cell, measure.bound);
    // Not too wide an interval, but too many regions, or signs of too few objects.
    cell.num_objects_to_decide = wanted > cell.num_objects ? wanted : 0;
  }
}

/** Of the cells from `begin` on, all of one measure: what holds everywhere is one family of
hypotheses, what holds in a region another. */
void DecideAll(std::vector<MapCell>& cells, size_t begin) {
  for (const bool is_everywhere : {true, false}) {
    std::vector<MapCell*> family;
    std::vector<double> p;
    for (size_t i = begin; i < cells.size(); ++i) {
      if (cells[i].where.empty() != is_everywhere) continue;
      family.push_back(&cells[i]);
      p.push_back(cells[i].p);
    }
    const std::vector<double> adjusted = AdjustBenjaminiHochberg(p);
    for (size_t i = 0; i < family.size(); ++i) {
      family[i]->adjusted_p = adjusted[i];
      Decide(*family[i]);
    }
  }
}

}  // namespace

const char* NameLateDigit(LateDigit late) { return late == LateDigit::kFirst ? "first" : "last"; }

SimultaneityMap MapSimultaneity(const MapData& data) {
  SimultaneityMap map;
  map.factors = data.factors;
  for (const MapTrial& trial : data.trials) {
    GRASPBENCH_DEMAND(trial.levels.size() == data.factors.size(), trial.object);
    if (std::count(map.hands.begin(), map.hands.end(), trial.hand) == 0) {
      map.hands.push_back(trial.hand);
    }
  }
  for (const MapMeasureRow& measure : kMapMeasures) {
    const size_t begin = map.cells.size();
    for (const std::string& hand : map.hands) {
      for (const LateDigit late : {LateDigit::kLast, LateDigit::kFirst}) {
        const std::vector<MapPair> pairs = ListMapPairs(data, hand, late, measure.value);
        if (pairs.empty()) continue;
        for (const std::vector<MapLevel>& where : ListPlaces(map.factors)) {
          MapCell cell;
          cell.hand = hand;
          cell.late = late;
          cell.measure = measure.value;
          cell.where = where;
          const std::string id = std::string(measure.name) + " " + hand + " " +
                                 NameLateDigit(late) + " " + NameWhere(map, cell);
          map.cells.push_back(MakeCell(pairs, cell, id));
        }
      }
    }
    DecideAll(map.cells, begin);
  }
  return map;
}

const MapCell* FindCell(const SimultaneityMap& map, MapMeasure measure, const std::string& hand,
                        LateDigit late, const std::vector<MapLevel>& where) {
  const auto is_same = [](const MapLevel& a, const MapLevel& b) {
    return a.factor == b.factor && a.level == b.level;
  };
  const auto found = std::find_if(map.cells.begin(), map.cells.end(), [&](const MapCell& cell) {
    return cell.measure == measure && cell.hand == hand && cell.late == late &&
           std::equal(cell.where.begin(), cell.where.end(), where.begin(), where.end(), is_same);
  });
  return found == map.cells.end() ? nullptr : &*found;
}

std::string NameWhere(const SimultaneityMap& map, const MapCell& cell) {
  std::string name;
  for (const MapLevel& level : cell.where) {
    const MapFactor& factor = map.factors[level.factor];
    name += (name.empty() ? "" : ", ") + factor.name + " " + factor.levels[level.level];
  }
  return name.empty() ? "everywhere" : name;
}

std::string FormatEffect(const MapCell& cell) {
  const MapMeasureRow& measure = RowOf(kMapMeasures, cell.measure);
  if (std::isnan(cell.estimate)) return "n/a";
  const std::string estimate = FormatFixed(measure.scale * cell.estimate, measure.decimals);
  if (!cell.interval) return estimate + " (" + cell.interval.reason() + ")";
  return estimate + " (" + FormatFixed(measure.scale * cell.interval->low, measure.decimals) +
         " to " + FormatFixed(measure.scale * cell.interval->high, measure.decimals) + ")";
}

namespace {

/** The cells of two levels with this verdict, the largest effects first. */
std::vector<const MapCell*> ListRegions(const SimultaneityMap& map, const std::string& hand,
                                        MapMeasure measure, MapVerdict verdict) {
  std::vector<const MapCell*> regions;
  for (const MapCell& cell : map.cells) {
    if (cell.hand == hand && cell.measure == measure && cell.late == LateDigit::kLast &&
        cell.where.size() == 2 && cell.num_pairs > 0 && cell.verdict == verdict) {
      regions.push_back(&cell);
    }
  }
  std::stable_sort(regions.begin(), regions.end(), [](const MapCell* a, const MapCell* b) {
    return std::abs(a->estimate) > std::abs(b->estimate);
  });
  return regions;
}

int CountRegions(const SimultaneityMap& map, const std::string& hand, MapMeasure measure) {
  return static_cast<int>(
      std::count_if(map.cells.begin(), map.cells.end(), [&](const MapCell& cell) {
        return cell.hand == hand && cell.measure == measure && cell.late == LateDigit::kLast &&
               cell.where.size() == 2 && cell.num_pairs > 0;
      }));
}

/** What a late digit does to a measure. */
struct MapVerbs {
  MapMeasure measure;
  const char* costs;
  const char* gains;
};
constexpr MapVerbs kMapVerbs[] = {
    {MapMeasure::kSuccess, "costs success", "gains success"},
    {MapMeasure::kThreshold, "asks for more grip", "asks for less grip"},
    {MapMeasure::kPush, "pushes farther", "pushes less far"},
    {MapMeasure::kBreakingForce, "weakens the hold", "strengthens the hold"}};

const MapVerbs& VerbsOf(MapMeasure measure) {
  return *std::find_if(std::begin(kMapVerbs), std::end(kMapVerbs),
                       [&](const MapVerbs& verbs) { return verbs.measure == measure; });
}

std::string DescribeRegions(const SimultaneityMap& map, const std::vector<const MapCell*>& regions,
                            int num_all, const std::string& what) {
  const std::string start = "A late last digit " + what + " in ";
  const std::string all = std::to_string(num_all) + " regions";
  if (regions.empty()) return start + "none of " + all + ". ";
  return start + std::to_string(regions.size()) + " of " + all + ", most where " +
         NameWhere(map, *regions.front()) + ": " + FormatEffect(*regions.front()) + ". ";
}

}  // namespace

std::string DescribeMap(const SimultaneityMap& map, const std::string& hand, MapMeasure measure) {
  const int num_all = CountRegions(map, hand, measure);
  if (num_all == 0) return "";
  const auto list = [&](MapVerdict verdict) { return ListRegions(map, hand, measure, verdict); };
  const MapVerbs& verbs = VerbsOf(measure);
  std::string text = DescribeRegions(map, list(MapVerdict::kCosts), num_all, verbs.costs);
  const std::vector<const MapCell*> gains = list(MapVerdict::kGains);
  if (!gains.empty()) text += DescribeRegions(map, gains, num_all, verbs.gains);
  text += "Of regions of two factors it makes no difference in " +
          std::to_string(list(MapVerdict::kNone).size());
  const size_t num_ends = list(MapVerdict::kCeiling).size() + list(MapVerdict::kFloor).size();
  if (num_ends > 0) text += ", success is at its ceiling or floor in " + std::to_string(num_ends);
  return text + ", and " + std::to_string(list(MapVerdict::kUndecided).size()) +
         " are not decided.";
}

Json ToJson(const SimultaneityMap& map) {
  Json factors = Json::array();
  for (const MapFactor& factor : map.factors) {
    factors.push_back({{"name", factor.name}, {"levels", factor.levels}});
  }
  Json cells = Json::array();
  for (const MapCell& cell : map.cells) {
    if (cell.num_pairs == 0) continue;
    Json row = {{"measure", RowOf(kMapMeasures, cell.measure).name},
                {"hand", cell.hand},
                {"late_digit", NameLateDigit(cell.late)},
                {"where", NameWhere(map, cell)},
                {"pairs", cell.num_pairs},
                {"objects", cell.num_objects},
                {"undelayed", JsonNumber(cell.undelayed)},
                {"estimate", JsonNumber(cell.estimate)},
                {"low", cell.interval ? JsonNumber(cell.interval->low) : Json()},
                {"high", cell.interval ? JsonNumber(cell.interval->high) : Json()},
                {"p", JsonNumber(cell.p)},
                {"adjusted_p", JsonNumber(cell.adjusted_p)},
                {"verdict", RowOf(kMapVerdicts, cell.verdict).name}};
    if (!cell.interval) row["no_interval"] = cell.interval.reason();
    if (cell.num_objects_to_decide > 0) row["objects_to_decide"] = cell.num_objects_to_decide;
    if (!cell.changed.empty()) row["changed"] = cell.changed;
    cells.push_back(row);
  }
  return {{"factors", factors}, {"cells", cells}};
}

}  // namespace graspbench
