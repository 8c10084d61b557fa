#include "datasets/session/damaged_records.h"

#include <algorithm>
#include <exception>
#include <map>
#include <set>
#include <utility>

#include "datasets/journal/checked_line.h"

namespace graspbench {

std::vector<TrialRecord> ReadDamagedRecords(const Session& session) {
  std::set<std::pair<std::string, int>> damaged;  // file and line
  for (const Damage& damage : session.damage) {
    if (damage.line > 0 && IsMatch(damage.path, {"journal/*.jsonl"})) {
      damaged.emplace(damage.path, damage.line);
    }
  }
  std::map<std::string, TrialRecord> found;
  for (const auto& [file, number] : damaged) {
    ForEachLineOfFile(session.folder / file, [&, wanted = number](const FileLine& line) {
      if (line.number != wanted || IsCheckedLine(line.text)) return;
      try {
        const Json json = Json::parse(line.text);
        TrialRecord record = {PlannedTrialFromJson(json), TrialResultFromJson(json.at("result"))};
        found.emplace(record.plan.id, std::move(record));
      } catch (const std::exception&) {  // it is no record any more
      }
    });
  }
  std::vector<TrialRecord> records;
  for (const PlannedTrial& planned : FindUnfinished(session)) {
    const auto record = found.find(planned.id);
    if (record != found.end()) records.push_back(std::move(record->second));
  }
  return records;
}

}  // namespace graspbench
