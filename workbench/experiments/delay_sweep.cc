#include "workbench/experiments/delay_sweep.h"

#include <map>
#include <optional>
#include <utility>

#include "core/trial/delayed_digit.h"

namespace graspbench {
namespace {

constexpr double kMassShare = 0.25, kFrictionShare = 0.7, kOffsetFactor = 2.0;

struct LateRow {
  LateDigit value;
  const char* name;
};
constexpr LateRow kLateDigits[] = {{LateDigit::kLast, "last"}, {LateDigit::kFirst, "first"}};

/** What the object is like; the first is as run. */
std::vector<Condition> ListStates(const SessionConfig& config) {
  const auto set = [](const char* key, double value) {
    return std::vector<std::string>{std::string(key) + "=" + FormatJson(value)};
  };
  return {{"as run", {}},
          {"light", set("model.mass_scale", kMassShare * config.model.mass_scale)},
          {"slippery", set("model.friction_scale", kFrictionShare * config.model.friction_scale)},
          {"off-centre", set("variation.offset_m", kOffsetFactor * config.variation.offset)}};
}

Condition DelayDigitIn(const Condition& state, const char* late, double delay) {
  Condition condition = state;
  condition.name += std::string(", ") + late + " digit " + FormatJson(delay) + " s late";
  condition.settings.push_back(std::string("delay.") + late + "=" + FormatJson(delay));
  return condition;
}

/** Finished trials by condition and draw. */
using Trials = std::map<std::pair<std::optional<std::string>, std::string>, const TrialRecord*>;

DelayedTrial MakeDelayedTrial(const std::string& state, const char* late, double delay,
                              const TrialRecord& record, const TrialRecord& undelayed) {
  DelayedTrial trial = {state, late, delay, {}, record};
  trial.record.plan = undelayed.plan;
  trial.closing = record.result.closing.value_or(Displacement());
  trial.record.result.closing.reset();
  return trial;
}

}  // namespace

std::vector<Condition> ListDelayConditions(const SessionConfig& config) {
  std::vector<Condition> conditions;
  for (const Condition& state : ListStates(config)) {
    if (!state.settings.empty()) conditions.push_back(state);
    for (const LateRow& late : kLateDigits) {
      for (const double delay : ListDelays()) {
        if (delay > 0.0) conditions.push_back(DelayDigitIn(state, late.name, delay));
      }
    }
  }
  return conditions;
}

PreparedSession PrepareDelays(const ExperimentRequest& request) {
  const Session session = LoadSession(request.folder, request.on_damage, RecordParts::kBrief);
  return PrepareExperiment(session, "delays", ListDelayConditions(session.config), request);
}

std::vector<DelayedTrial> ListDelayedTrials(const Session& experiment) {
  Trials finished;
  for (const TrialRecord& record : experiment.records) {
    finished[{record.plan.condition, NameDraw(record.plan)}] = &record;
  }
  std::vector<DelayedTrial> trials;
  for (const Condition& state : ListStates(experiment.config)) {
    std::vector<DelayedTrial> undelayed;
    const auto name = state.settings.empty() ? std::nullopt : std::optional(state.name);
    for (const TrialRecord& record : experiment.records) {
      if (record.plan.condition != name) continue;
      for (const LateRow& late : kLateDigits) {
        undelayed.push_back(MakeDelayedTrial(state.name, late.name, 0.0, record, record));
        if (FindLateDigit(record.result, late.value).empty()) continue;
        for (const double delay : ListDelays()) {
          const auto found =
              finished.find({DelayDigitIn(state, late.name, delay).name, NameDraw(record.plan)});
          if (delay == 0.0 || found == finished.end()) continue;
          trials.push_back(MakeDelayedTrial(state.name, late.name, delay, *found->second, record));
        }
      }
    }
    for (DelayedTrial& trial : undelayed) trials.push_back(std::move(trial));
  }
  return trials;
}

}  // namespace graspbench
