#include "workbench/text/replay_text.h"

#include <fmt/format.h>

#include "core/base/text/text.h"
#include "datasets/session/find_trial.h"

namespace graspbench {
namespace {

std::string DescribeReplayed(const ReplayedTrial& trial) {
  if (!trial.is_recorded) return "has no record: the session has not finished it";
  if (!trial.difference) return "re-simulation matches the record";
  return fmt::format("{} differs: recorded {}, now {}{}", trial.difference->field,
                     trial.difference->recorded, trial.difference->now,
                     trial.is_damaged ? "; its line fails its checksum" : "");
}

std::string DescribePhysics(const ReplayConditions& conditions) {
  if (conditions.recorded_physics == 0) {
    return fmt::format("version {}; the session does not say its own", conditions.physics);
  }
  if (!conditions.is_other_physics())
    return fmt::format("version {}, the same", conditions.physics);
  return fmt::format("version {}, recorded with {}: results of the two do not belong together",
                     conditions.physics, conditions.recorded_physics);
}

std::string DescribeBuild(const ReplayConditions& conditions) {
  if (conditions.recorded_builds.empty()) return conditions.build + "; the recorded one is unknown";
  if (!conditions.is_other_build()) return conditions.build + ", the same";
  return conditions.build + ", recorded with " +
         fmt::format("{}", fmt::join(conditions.recorded_builds, ", "));
}

bool IsAsRecorded(const ReplayedTrial& trial) { return trial.is_recorded && !trial.difference; }

}  // namespace

std::string FormatReplay(const SessionReplay& replay, bool with_all) {
  std::string text;
  int num_same = 0;
  for (const ReplayedTrial& trial : replay.trials) {
    num_same += IsAsRecorded(trial);
    if (!with_all && IsAsRecorded(trial)) continue;
    text += fmt::format("{} {}, {}: {}\n", trial.planned.id, NameTrial(trial.planned),
                        NameOf(trial.outcome), DescribeReplayed(trial));
  }
  const ReplayConditions& conditions = replay.conditions;
  text += fmt::format("same     {} of {}\nphysics  {}\nbuild    {}\n", num_same,
                      FormatCount(static_cast<int64_t>(replay.trials.size()), "trial"),
                      DescribePhysics(conditions), DescribeBuild(conditions));
  if (conditions.num_changed > 0 && !conditions.is_other_physics()) {
    text += fmt::format("inputs   hand, object or grasp of {} changed since\n",
                        FormatCount(conditions.num_changed, "trial has", "trials have"));
  }
  return text;
}

Json MakeReplayJson(const SessionReplay& replay, const std::string& folder) {
  Json trials = Json::array();
  for (const ReplayedTrial& trial : replay.trials) {
    Json json = ToJson(trial.planned);
    json["name"] = NameTrial(trial.planned);
    json["outcome"] = NameOf(trial.outcome);
    json["recorded"] = trial.is_recorded;
    json["damaged"] = trial.is_damaged;
    json["difference"] = trial.difference ? Json{{"field", trial.difference->field},
                                                 {"recorded", trial.difference->recorded},
                                                 {"now", trial.difference->now}}
                                          : Json();
    trials.push_back(std::move(json));
  }
  const ReplayConditions& conditions = replay.conditions;
  const int num_trials = static_cast<int>(replay.trials.size());
  return {{"folder", folder},
          {"num_trials", num_trials},
          {"num_different", replay.CountDifferent()},
          {"num_missing", replay.CountMissing()},
          {"physics_version", conditions.physics},
          {"recorded_physics_version", conditions.recorded_physics},
          {"build", conditions.build},
          {"recorded_builds", conditions.recorded_builds},
          {"num_changed_inputs", conditions.num_changed},
          {"trials", trials}};
}

}  // namespace graspbench
