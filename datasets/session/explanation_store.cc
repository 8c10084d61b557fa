#include "datasets/session/explanation_store.h"

#include <set>

#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/read_journal.h"
#include "datasets/shards/worker_log.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

constexpr char kExplainFolder[] = "explain";
constexpr int kExplainVersion = 2;

fs::path MakeExplainPath(const fs::path& folder, int worker, const std::string& label) {
  MakeFolder(folder / kExplainFolder);
  return FindJournal(folder / kExplainFolder, worker, label);
}

void AddExplanation(const std::string& id, const Explanation& explanation, const fs::path& folder,
                    Explanations& known) {
  const auto [first, is_new] = known.emplace(id, explanation);
  if (is_new || RecordToJson(first->second) == RecordToJson(explanation)) return;
  if (first->second.is_short() != explanation.is_short()) {
    if (first->second.is_short()) first->second = explanation;
    return;
  }
  throw Error(ErrorKind::kFormat,
              "trial " + id + " has two different explanations in \"" +
                  (folder / kExplainFolder).string() +
                  "\": two builds of the program have explained it; remove one of the files");
}

/** The same for all trials of a condition. */
std::string NameCondition(const PlannedTrial& planned) {
  return FormatJson(Json{planned.hand, planned.object, planned.grasp,
                         planned.condition ? Json(*planned.condition) : Json()});
}

}  // namespace

ExplanationWriter::ExplanationWriter(const fs::path& folder, int worker, const std::string& label)
    : file_(MakeExplainPath(folder, worker, label)) {}

void ExplanationWriter::Append(const std::string& trial_id, const Explanation& explanation) {
  file_.Append(FormatCheckedLine({{"trial_id", trial_id},
                                  {"explain_version", kExplainVersion},
                                  {"explanation", RecordToJson(explanation)}}) +
               "\n");
}

Explanations LoadExplanations(const fs::path& folder) {
  Explanations known;
  if (folder.empty()) return known;
  Diagnostics findings;
  std::vector<Damage> damage;
  for (const fs::path& path : ListJournals(folder, kExplainFolder)) {
    const std::string file = std::string(kExplainFolder) + "/" + path.filename().string();
    std::vector<std::pair<std::string, Explanation>> lines;
    const auto take = [&](const FileLine& line) {
      const Json json = ParseCheckedLine(line.text);
      if (IntFrom(json.at("explain_version")) != kExplainVersion) return;
      Explanation explanation;
      ReadRecord(json.at("explanation"), explanation);
      lines.emplace_back(json.at("trial_id").get<std::string>(), std::move(explanation));
    };
    ReadJournal(folder, file, take, findings, damage);
    for (const auto& [id, explanation] : lines) AddExplanation(id, explanation, folder, known);
  }
  return known;
}

std::vector<PlannedTrial> FindUnexplained(const Session& session, ExplainScope scope) {
  const Explanations known = LoadExplanations(session.folder);
  const auto is_explained = [&](const TrialRecord& record) {
    const auto explained = known.find(record.plan.id);
    return explained != known.end() &&
           (scope == ExplainScope::kShortly || !explained->second.is_short());
  };
  std::set<std::string> done;  // conditions
  for (const TrialRecord& record : session.records) {
    if (is_explained(record)) done.insert(NameCondition(record.plan));
  }
  std::vector<PlannedTrial> trials;
  for (const TrialRecord& record : session.records) {
    if (!record.result.diagnosis || record.result.policy || is_explained(record)) continue;
    if (scope == ExplainScope::kShortly && done.size() >= kMostShortly) break;
    const bool is_first = done.insert(NameCondition(record.plan)).second;
    if (is_first || scope == ExplainScope::kAll) trials.push_back(record.plan);
  }
  return trials;
}

void MergeExplanations(const fs::path& folder, const fs::path& other) {
  Explanations known = LoadExplanations(folder);
  std::vector<std::string> added;
  for (const auto& [id, explanation] : LoadExplanations(other)) {
    const auto before = known.find(id);
    const bool is_better =
        before == known.end() || (before->second.is_short() && !explanation.is_short());
    if (is_better) added.push_back(id);
    AddExplanation(id, explanation, folder, known);
  }
  if (added.empty()) return;
  ExplanationWriter writer(folder, 0, kMergedLabel);
  for (const std::string& id : added) writer.Append(id, known.at(id));
}

}  // namespace graspbench
