#include "datasets/session/judgement_store.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/read_journal.h"
#include "datasets/records/trial_record.h"

namespace graspbench {
namespace {

constexpr char kFolder[] = "judge";

/** Joins judgements to the records of a session. */
class Joiner {
 public:
  explicit Joiner(Session& session)
      : session_(session),
        is_brief_(!session.lines.trials.empty()),
        has_records_(!session.records.empty()) {
    for (size_t i = 0; i < session.records.size(); ++i) {
      places_.emplace(session.records[i].plan.id, i);
    }
    if (has_records_) return;
    for (size_t i = 0; i < session.lines.trials.size(); ++i) {
      if (session.lines.trials[i].file >= 0) places_.emplace(session.plan[i].id, i);
    }
  }

  /** False: the line's trial has another judgement already.
  @throws Json::exception, Error(kFormat). */
  bool Add(std::string_view line, const LinePlace& place) {
    const Json json = ParseCheckedLine(line);
    if (IntFrom(json.at("judge_version")) != kJudgeVersion) return true;
    const auto id = json.at("trial_id").get<std::string>();
    const auto found = places_.find(id);
    if (found == places_.end() && !IsPlanned(id)) {
      throw Error(ErrorKind::kFormat, DescribeForeign(id));
    }
    if (found == places_.end()) {  // its record was set aside
      const std::string& file = session_.lines.files.at(static_cast<size_t>(place.file));
      session_.findings.Warn(file, place.number,
                             "skipped: trial " + id + " is not finished; it is ignored");
      return true;
    }
    Judgement judgement;
    ReadRecord(json.at("judgement"), judgement);
    return has_records_ ? AddTo(session_.records[found->second], std::move(judgement), place)
                        : AddPlace(found->second, judgement, place);
  }

 private:
  bool AddTo(TrialRecord& record, Judgement judgement, const LinePlace& place) {
    if (record.judgement) {
      return RecordToJson(*LoadWhole(session_, record).judgement) == RecordToJson(judgement);
    }
    if (is_brief_) {
      std::vector<BreakingLoad>().swap(judgement.loads);
      judgement.epsilons.shrink_to_fit();
      judgement.verdicts.shrink_to_fit();
      session_.lines.judgements[static_cast<size_t>(&record - session_.records.data())] = place;
    }
    record.judgement = std::move(judgement);
    return true;
  }

  bool AddPlace(size_t trial, const Judgement& judgement, const LinePlace& place) {
    LinePlace& known = session_.lines.judgements[trial];
    if (known.file >= 0) {
      return RecordToJson(ParseJudgementLine(ReadLine(session_.lines, known))) ==
             RecordToJson(judgement);
    }
    known = place;
    return true;
  }

  bool IsPlanned(const std::string& id) const {
    return std::any_of(session_.plan.begin(), session_.plan.end(),
                       [&](const PlannedTrial& planned) { return planned.id == id; });
  }

  Session& session_;
  bool is_brief_, has_records_;
  /** Of finished trials, among the records, or in the plan. Looked up only, never iterated. */
  std::unordered_map<std::string_view, size_t> places_;
};

std::filesystem::path MakeJudgePath(const std::filesystem::path& folder, int worker,
                                    const std::string& label) {
  MakeFolder(folder / kFolder);
  return FindJournal(folder / kFolder, worker, label);
}

}  // namespace

JudgementWriter::JudgementWriter(const std::filesystem::path& folder, int worker,
                                 const std::string& label)
    : file_(MakeJudgePath(folder, worker, label)) {}

void JudgementWriter::Append(const std::string& trial_id, const Judgement& judgement) {
  file_.Append(FormatJudgementLine(trial_id, judgement) + "\n");
}

void LoadJudgements(const std::filesystem::path& folder, Session& session) {
  Joiner joiner(session);
  Diagnostics conflicts;
  for (const std::filesystem::path& path : ListJournals(folder, kFolder)) {
    const std::string file = std::string(kFolder) + "/" + path.filename().string();
    session.lines.files.push_back(file);
    const int index = static_cast<int>(session.lines.files.size()) - 1;
    const auto take = [&](const FileLine& line) {
      if (!joiner.Add(line.text, {index, line.number, line.start, line.text.size()})) {
        conflicts.Fail(file, line.number, "a trial has two different judgements");
      }
    };
    ReadJournal(folder, file, take, session.findings, session.damage);
  }
  conflicts.ThrowIfErrors(ErrorKind::kFormat,
                          "two machines or versions of the program have judged this session, or a "
                          "file was edited; graspbench merge DIR --set-aside FILE ignores one of "
                          "these files and keeps it aside; then judge again");
}

bool HasBegunJudge(const std::filesystem::path& folder) {
  return !ListJournals(folder, kFolder).empty();
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
