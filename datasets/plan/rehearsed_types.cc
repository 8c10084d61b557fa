#include "datasets/plan/rehearsed_types.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/plan/rehearsed_grasps.h"

namespace graspbench {

std::string FormatTypes(const RehearsedTypes& types) {
  std::string text = "[";
  for (const auto& [pair, type] : types) {
    text += (text.size() == 1 ? "\n" : ",\n") + FormatJson(RecordToJson(type));
  }
  return text + "\n]\n";
}

RehearsedTypes ParseTypes(const std::string& text, const std::string& file) {
  RehearsedTypes types;
  try {
    for (const Json& json : Json::parse(text)) {
      RehearsedType type;
      ReadRecord(json, type);
      types[{type.hand, type.object}] = type;
    }
  } catch (const std::exception& error) {
    throw Error(ErrorKind::kFormat,
                file + ": not the types of grasps that graspbench writes (" + error.what() + ")");
  }
  return types;
}

const RehearsedTypes& LoadShippedTypes() {
  static const RehearsedTypes types = [] {
    const auto path = FindDataRoot() / "objects" / "catalogue" / "rehearsed_types.json";
    return ParseTypes(ReadFile(path), path.string());
  }();
  return types;
}

std::optional<RehearsedType> FindShippedType(const RehearsalTask& task) {
  const auto found = LoadShippedTypes().find({task.hand->id, task.object->id});
  if (found == LoadShippedTypes().end()) return std::nullopt;
  const RehearsalTask shipped =
      MakeRehearsalTask(SessionConfig(), {}, task.hand, task.grasps, task.object);
  const bool is_same =
      CalcRehearsalHash(MakeTypeTask(shipped, kShippedTypeDraws)) == found->second.hash;
  return is_same ? std::optional<RehearsedType>(found->second) : std::nullopt;
}

bool HasBestGrasp(const SessionConfig& config) {
  const std::string setting = std::string("grasp=") + kBestGrasp;
  return std::count(config.grasps.begin(), config.grasps.end(), kBestGrasp) > 0 ||
         std::any_of(config.conditions.begin(), config.conditions.end(),
                     [&](const Condition& condition) {
                       const auto& all = condition.settings;
                       return std::count(all.begin(), all.end(), setting) > 0;
                     });
}

RehearsalTask MakeTypeTask(RehearsalTask task, int num_draws) {
  task.arm = nullptr;  // a type is one for all arms
  task.config = {std::max(1, static_cast<int>(task.grasps.size())), num_draws};
  return task;
}

bool NeedsType(const RehearsalTask& task) {
  return !task.grasps.empty() && task.object->best_grasp.count(task.hand->id) == 0;
}

RehearsedType MakeType(const RehearsalTask& task, const Rehearsal& rehearsal) {
  const RehearsedCandidate& choice = rehearsal.choice();
  return {task.hand->id,
          task.object->id,
          choice.candidate.standard,
          choice.CountHeld(),
          static_cast<int>(choice.outcomes.size()),
          CalcRehearsalHash(task)};
}

}  // namespace graspbench
