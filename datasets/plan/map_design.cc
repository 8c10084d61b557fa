#include "datasets/plan/map_design.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/text/json.h"
#include "datasets/plan/conditions.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

constexpr size_t kLaw = 0, kGrip = 2;  // places of factors
constexpr size_t kFirm = 3;            // level of the grip
constexpr int kNumRuns = 32, kNumRunsWithoutGrip = 16;

int Bit(int run, int place) { return (run >> place) & 1; }

/** Levels of drive law, speed, grip, friction, offset, mass in one run. */
std::vector<size_t> ListLevels(int run, bool varies_grip) {
  const int law = Bit(run, 0), speed = Bit(run, 1), friction = Bit(run, 2);
  const int grip1 = varies_grip ? Bit(run, 3) : 0, grip2 = varies_grip ? Bit(run, 4) : 0;
  const int offset = varies_grip ? law ^ speed ^ grip1 ^ grip2 : Bit(run, 3);
  const int mass = law ^ speed ^ friction ^ (varies_grip ? grip2 : offset);
  std::vector<size_t> levels;
  for (const int level : {law, speed, 2 * grip1 + grip2, friction, offset, mass}) {
    levels.push_back(static_cast<size_t>(level));
  }
  return levels;
}

/** Of each factor and level, as conditions write it. */
std::vector<std::vector<std::string>> ListSettings(const SessionConfig& config) {
  std::vector<std::vector<std::string>> settings;
  for (const MapFactorRow& factor : ListMapFactors()) {
    settings.emplace_back();
    for (const MapLevelRow& level : factor.levels) {
      settings.back().push_back(NormaliseSetting(level.setting, config));
    }
  }
  return settings;
}

int CountTrials(const MapPart& part, const SessionConfig& base) {
  constexpr double kTrialsOfRegion = 60.0;
  const bool takes_all = base.objects == SessionConfig().objects;
  const size_t num_objects = takes_all ? ListObjects().size() : base.objects.size();
  const double trials = std::round(kTrialsOfRegion / std::max<size_t>(num_objects, 1));
  return static_cast<int>(std::clamp(trials, 1.0, static_cast<double>(part.most_trials)));
}

}  // namespace

const std::vector<MapFactorRow>& ListMapFactors() {
  static const std::vector<MapFactorRow> factors = {
      {"drive law",
       {{"hold", "strategy.drive_law=hold"}, {"saturating", "strategy.drive_law=saturating"}}},
      {"speed after touch",
       {{"1", "strategy.touch_speed=1"}, {"0.25", "strategy.touch_speed=0.25"}}},
      {"grip",
       {{"margin 1.5", "strategy.grip_margin=1.5"},
        {"margin 2", "strategy.grip_margin=2"},
        {"margin 4", "strategy.grip_margin=4"},
        {"firm", "strategy.grip=posture"}}},
      {"friction", {{"1", "model.friction_scale=1"}, {"0.6", "model.friction_scale=0.6"}}},
      {"offset",
       {{"2 mm", "variation.offset_m=0.002"}, {"10 mm", "variation.offset_m=0.01"}},
       true},
      {"mass", {{"1", "model.mass_scale=1"}, {"0.25", "model.mass_scale=0.25"}}}};
  return factors;
}

std::vector<MapPart> ListMapParts(bool is_quick) {
  if (is_quick) return {{"success", "Success", true, {0.3}, 1, 0, false, false}};
  return {{"success", "Success", true, {0.1, 0.3}, 3, 0, false, false},
          {"threshold", "Grip threshold", false, {0.3}, 1, 12, true, false},
          {"strength", "Breaking force", false, {0.3}, 1, 5, false, true}};
}

SessionConfig MakeMapSession(const MapPart& part, SessionConfig base) {
  base.trials = CountTrials(part, base);
  base.strategy.grip = "margin";
  base.strategy.grip_force = 0.0;  // a least force would hide the margin
  for (const MapFactorRow& factor : ListMapFactors()) {
    ApplySetting(factor.levels.front().setting, base);
  }
  SessionConfig config = base;
  const auto settings = ListSettings(base);
  std::vector<std::string> delays = {""};
  for (const double delay : part.delays) {
    for (const char* key : {"delay.last=", "delay.first="}) {
      delays.push_back(NormaliseSetting(key + FormatJson(delay), base));
    }
  }
  const int num_runs = part.varies_grip ? kNumRuns : kNumRunsWithoutGrip;
  for (int run = 0; run < num_runs; ++run) {
    const std::vector<size_t> levels = ListLevels(run, part.varies_grip);
    if (levels[kLaw] > 0 && levels[kGrip] == kFirm) continue;
    for (const std::string& delay : delays) {
      Condition condition;
      for (size_t i = 0; i < levels.size(); ++i) {
        if (levels[i] > 0) condition.settings.push_back(settings[i][levels[i]]);
      }
      if (!delay.empty()) condition.settings.push_back(delay);
      if (condition.settings.empty()) continue;  // the base
      for (const std::string& setting : condition.settings) {
        condition.name += (condition.name.empty() ? "" : ", ") + setting;
      }
      ApplyCondition(condition, base);  // what cannot be combined is refused here
      config.conditions.push_back(std::move(condition));
    }
  }
  return config;
}

bool IsMap(const SessionConfig& config) {
  if (config.conditions.empty()) return false;
  const auto has_name = [](const Condition& a, const Condition& b) { return a.name == b.name; };
  SessionConfig base = config;
  base.conditions.clear();
  for (const bool is_quick : {false, true}) {
    const MapPart part = ListMapParts(is_quick).front();
    const size_t most = (1 + 2 * part.delays.size()) * kNumRuns;
    if (config.conditions.size() > most || config.conditions.size() < most / 2) continue;
    const std::vector<Condition> all = MakeMapSession(part, base).conditions;
    if (std::equal(all.begin(), all.end(), config.conditions.begin(), config.conditions.end(),
                   has_name)) {
      return true;
    }
  }
  return false;
}

std::vector<std::vector<size_t>> ListMapLevels(const std::vector<Condition>& conditions,
                                               const SessionConfig& config) {
  const auto settings = ListSettings(config);
  std::vector<std::vector<size_t>> levels;
  for (const Condition& condition : conditions) {
    levels.emplace_back(settings.size(), 0);
    const auto& all = condition.settings;
    for (size_t factor = 0; factor < settings.size(); ++factor) {
      for (size_t level = 1; level < settings[factor].size(); ++level) {
        const bool has_it = std::find(all.begin(), all.end(), settings[factor][level]) != all.end();
        if (has_it) levels.back()[factor] = level;
      }
    }
  }
  return levels;
}

}  // namespace graspbench
