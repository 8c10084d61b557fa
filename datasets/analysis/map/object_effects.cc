#include "datasets/analysis/map/object_effects.h"

#include <algorithm>
#include <map>

#include "core/base/text/text.h"
#include "datasets/analysis/map/map_pairs.h"

namespace graspbench {
namespace {

constexpr int kNumResamples = 1999;
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
  const Answer<BootstrapInterval> drawn = CalcBootstrap(pairs.size(), calc_mean, id, kNumResamples);
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
  std::string text = "By object: a late last digit costs " + std::to_string(num_lose) + " of " +
                     FormatCount(num_all, "object") + " success, and gains " +
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

}  // namespace graspbench
