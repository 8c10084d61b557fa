#include "datasets/session/judgement_store.h"

#include <cmath>
#include <unordered_map>

#include "core/base/files.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {
namespace {

constexpr char kFolder[] = "judge";

/** Reads one line into the record it belongs to. False: that has another judgement already.
@throws Json::exception, Error(kFormat). */
bool AddJudgement(const Json& json, const std::unordered_map<std::string, TrialRecord*>& records) {
  if (IntFrom(json.at("judge_version")) != kJudgeVersion) return true;
  const auto id = json.at("trial_id").get<std::string>();
  const auto record = records.find(id);
  if (record == records.end()) {
    throw Error(ErrorKind::kFormat, "trial " + id + " is not finished");
  }
  Judgement judgement;
  ReadRecord(json.at("judgement"), judgement);
  std::optional<Judgement>& known = record->second->judgement;
  if (known) return RecordToJson(*known) == RecordToJson(judgement);
  known = std::move(judgement);
  return true;
}

std::filesystem::path MakeJudgePath(const std::filesystem::path& folder, int worker,
                                    const std::string& label) {
  MakeFolder(folder / kFolder);
  return FindJournal(folder / kFolder, worker, label);
}

}  // namespace

std::string FormatJudgementLine(const std::string& trial_id, const Judgement& judgement) {
  return FormatCheckedLine({{"trial_id", trial_id},
                            {"judge_version", kJudgeVersion},
                            {"judgement", RecordToJson(judgement)}});
}

JudgementWriter::JudgementWriter(const std::filesystem::path& folder, int worker,
                                 const std::string& label)
    : file_(MakeJudgePath(folder, worker, label)) {}

void JudgementWriter::Append(const std::string& trial_id, const Judgement& judgement) {
  file_.Append(FormatJudgementLine(trial_id, judgement) + "\n");
}

void LoadJudgements(const std::filesystem::path& folder, Session& session) {
  std::unordered_map<std::string, TrialRecord*> records;  // looked up only, never iterated
  for (TrialRecord& record : session.records) records.emplace(record.plan.id, &record);
  Diagnostics conflicts;
  for (const std::filesystem::path& path : ListJournals(folder, kFolder)) {
    const std::string file = std::string(kFolder) + "/" + path.filename().string();
    ForEachLine(ReadFile(path), [&](std::string_view line, int number, bool is_whole) {
      if (!is_whole) {
        session.findings.Warn(file, number,
                              "the last line was not finished; its trial counts as "
                              "not judged");
        return;
      }
      try {
        if (!AddJudgement(ParseCheckedLine(line), records)) {
          conflicts.Fail(file, number, "a trial has two different judgements");
        }
      } catch (const std::exception& e) {  // of the JSON library, or an Error of a value
        session.findings.Warn(file, number,
                              std::string("skipped: ") + e.what() + "; it counts as not judged");
      }
    });
  }
  conflicts.ThrowIfErrors(
      ErrorKind::kFormat,
      "two versions of the program have judged this session or a file was "
      "edited; delete the folder \"judge\", seal the rest with graspbench verify "
      "--repair and judge the session anew");
}

std::vector<PlannedTrial> FindUnjudged(const Session& session) {
  std::vector<PlannedTrial> trials;
  for (const TrialRecord& record : session.records) {
    const Outcome outcome = record.result.outcome;
    const bool may_be_held = MayBeInHand(outcome) && !std::isnan(record.result.steady_penetration);
    if (may_be_held && !record.judgement) trials.push_back(record.plan);
  }
  return trials;
}

}  // namespace graspbench
