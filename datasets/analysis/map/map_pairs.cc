#include "datasets/analysis/map/map_pairs.h"

#include <cmath>
#include <map>
#include <tuple>

namespace graspbench {
namespace {

constexpr double kMapDose = 0.1;  // effects are for so much delay [s]

double CalcSign(double change) { return change > 0.0 ? 1.0 : change < 0.0 ? -1.0 : 0.0; }

using MapPairKey = std::tuple<std::string, int, std::vector<size_t>>;

}  // namespace

double CalcPairEffect(MapMeasure measure, double undelayed,
                      const std::vector<std::pair<double, double>>& delayed) {
  double products = 0.0, squares = 0.0, signs = 0.0;
  for (const auto& [delay, value] : delayed) {
    products += delay * (value - undelayed);
    squares += delay * delay;
    // Two digits that never touch are as far as each other; inf - inf is no number.
    signs += value == undelayed ? 0.0 : std::isnan(value) ? kUnset : CalcSign(value - undelayed);
  }
  if (std::isnan(undelayed) || delayed.empty()) return kUnset;
  if (measure == MapMeasure::kPush) return signs / static_cast<double>(delayed.size());
  return kMapDose * products / squares;
}

std::vector<MapPair> ListMapPairs(const MapData& data, const std::string& hand, LateDigit late,
                                  MapMeasure measure) {
  const auto place = static_cast<size_t>(measure);
  std::map<MapPairKey, double> undelayed;
  std::map<MapPairKey, std::vector<const MapTrial*>> delayed;
  for (const MapTrial& trial : data.trials) {
    if (trial.hand != hand) continue;
    const MapPairKey key(trial.object, trial.draw, trial.levels);
    if (trial.late == LateDigit::kNone) undelayed[key] = trial.values[place];
    if (trial.late == late) delayed[key].push_back(&trial);
  }
  std::vector<MapPair> pairs;
  for (const auto& [key, trials] : delayed) {
    const auto found = undelayed.find(key);
    if (found == undelayed.end()) continue;
    std::vector<std::pair<double, double>> values;
    std::string changed;
    for (const MapTrial* trial : trials) {
      values.emplace_back(trial->delay, trial->values[place]);
      if (changed.empty() && trial->values[place] != found->second) changed = trial->name;
    }
    const double effect = CalcPairEffect(measure, found->second, values);
    if (std::isnan(effect)) continue;
    pairs.push_back({std::get<2>(key), std::get<0>(key), found->second, values, effect, changed});
  }
  return pairs;
}

}  // namespace graspbench
