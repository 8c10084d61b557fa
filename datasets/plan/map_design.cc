#include "datasets/plan/map_design.h"

#include <algorithm>
#include <array>

#include "core/base/text/json.h"
#include "datasets/plan/conditions.h"

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

Condition MakeCondition(const std::vector<size_t>& levels, const std::string& delay,
                        const SessionConfig& config) {
  Condition condition;
  for (size_t i = 0; i < levels.size(); ++i) {
    if (levels[i] == 0) continue;
    const std::string& setting = ListMapFactors()[i].levels[levels[i]].setting;
    condition.settings.push_back(NormaliseSetting(setting, config));
  }
  if (!delay.empty()) condition.settings.push_back(NormaliseSetting(delay, config));
  for (const std::string& setting : condition.settings) {
    condition.name += (condition.name.empty() ? "" : ", ") + setting;
  }
  return condition;
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
          {"threshold", "Grip threshold", false, {0.3}, 1, 0, true, false},
          {"strength", "Breaking force", false, {0.3}, 1, 5, false, true}};
}

SessionConfig MakeMapSession(const MapPart& part, SessionConfig base) {
  base.trials = part.trials;
  base.strategy.grip = "margin";
  base.strategy.grip_force = 0.0;  // a least force would hide the margin
  for (const MapFactorRow& factor : ListMapFactors()) {
    ApplySetting(factor.levels.front().setting, base);
  }
  SessionConfig config = base;
  const int num_runs = part.varies_grip ? kNumRuns : kNumRunsWithoutGrip;
  for (int run = 0; run < num_runs; ++run) {
    const std::vector<size_t> levels = ListLevels(run, part.varies_grip);
    if (levels[kLaw] > 0 && levels[kGrip] == kFirm) continue;
    std::vector<std::string> delays = {""};
    for (const double delay : part.delays) {
      delays.push_back("delay.last=" + FormatJson(delay));
      delays.push_back("delay.first=" + FormatJson(delay));
    }
    for (const std::string& delay : delays) {
      Condition condition = MakeCondition(levels, delay, base);
      if (condition.settings.empty()) continue;  // the base
      ApplyCondition(condition, base);           // what cannot be combined is refused here
      config.conditions.push_back(std::move(condition));
    }
  }
  return config;
}

bool IsMap(const SessionConfig& config) {
  if (config.conditions.empty()) return false;
  const auto has_name = [](const Condition& a, const Condition& b) { return a.name == b.name; };
  for (const bool is_quick : {false, true}) {
    SessionConfig base = config;
    base.conditions.clear();
    const std::vector<Condition> all =
        MakeMapSession(ListMapParts(is_quick).front(), base).conditions;
    if (std::equal(all.begin(), all.end(), config.conditions.begin(), config.conditions.end(),
                   has_name)) {
      return true;
    }
  }
  return false;
}

std::vector<size_t> FindMapLevels(const Condition& condition, const SessionConfig& config) {
  std::vector<size_t> levels;
  for (const MapFactorRow& factor : ListMapFactors()) {
    size_t level = 0;
    for (size_t i = 1; i < factor.levels.size(); ++i) {
      const std::string setting = NormaliseSetting(factor.levels[i].setting, config);
      const auto& all = condition.settings;
      if (std::find(all.begin(), all.end(), setting) != all.end()) level = i;
    }
    levels.push_back(level);
  }
  return levels;
}

}  // namespace graspbench
