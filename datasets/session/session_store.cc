#include "datasets/session/session_store.h"

#include <algorithm>
#include <exception>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/session/judgement_store.h"
#include "datasets/shards/worker_log.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

/** Places of trials of an id that another has before them; in the plan's order. */
std::vector<size_t> FindRepeated(const std::vector<PlannedTrial>& plan) {
  std::vector<std::pair<std::string_view, size_t>> ids;
  ids.reserve(plan.size());
  for (size_t i = 0; i < plan.size(); ++i) ids.emplace_back(plan[i].id, i);
  std::sort(ids.begin(), ids.end());
  std::vector<size_t> repeated;
  for (size_t i = 1; i < ids.size(); ++i) {
    if (ids[i].first == ids[i - 1].first) repeated.push_back(ids[i].second);
  }
  std::sort(repeated.begin(), repeated.end());
  return repeated;
}

std::vector<PlannedTrial> LoadPlan(const fs::path& path) {
  std::vector<PlannedTrial> plan;
  std::vector<int> numbers;  // of their lines
  Diagnostics problems;
  ForEachLineOfFile(path, [&](const FileLine& line) {
    if (line.text.empty()) return;
    try {
      plan.push_back(ParsePlannedTrial(line.text));
      numbers.push_back(line.number);
    } catch (const std::exception& e) {  // of the JSON library, or an Error of a value
      problems.Fail("plan.jsonl", line.number, e.what());
    }
  });
  for (const size_t i : FindRepeated(plan)) {
    problems.Fail("plan.jsonl", numbers[i], "trial " + plan[i].id + " is planned twice");
  }
  problems.ThrowIfErrors(ErrorKind::kFormat,
                         "\"" + path.string() +
                             "\" is damaged; it is written once and never changed, so take it "
                             "from a backup");
  return plan;
}

template <class T>
void Drop(std::vector<T>& values) {
  std::vector<T>().swap(values);
}

void MakeBrief(TrialResult& result) {
  result.contacts.shrink_to_fit();
  Drop(result.touches);
  Drop(result.phases);
  Drop(result.contact_events);
  Drop(result.snapshots);
  if (result.policy) Drop(result.policy->rows);
}

/** Finished trials by their place in the plan, gathered from journals in any order. */
class Merger {
 public:
  Merger(const fs::path& folder, Session& session, RecordParts parts)
      : session_(session),
        parts_(parts),
        records_(parts == RecordParts::kPlaces ? 0 : session.plan.size()),
        places_(session.plan.size()) {
    lines_.folder = folder;
    place_of_.reserve(session.plan.size());
    for (size_t i = 0; i < session.plan.size(); ++i) place_of_.emplace(session.plan[i].id, i);
  }

  void AddFile(const std::string& file) {
    lines_.files.push_back(file);
    ReadJournal(
        lines_.folder, file,
        [&](const FileLine& line) { AddRecord(ParseJournalLine(line.text), line); },
        session_.findings, session_.damage);
  }

  /** @throws Error(kFormat) when a trial has two different results. */
  void TakeRecords() {
    conflicts_.ThrowIfErrors(
        ErrorKind::kFormat,
        "one trial has different results: two machines or versions of the program have written to "
        "this session, or a file was edited; graspbench merge DIR --set-aside FILE ignores one of "
        "these files and keeps it aside, or rerun the session");
    if (parts_ == RecordParts::kPlaces) {
      lines_.judgements.resize(places_.size());
      lines_.trials = std::move(places_);
      session_.lines = std::move(lines_);
      return;
    }
    size_t num_found = 0;  // they move up in place: of a large session there is no room for two
    for (size_t i = 0; i < records_.size(); ++i) {
      if (places_[i].file < 0) continue;
      if (num_found < i) {
        records_[num_found] = std::move(records_[i]);
        places_[num_found] = places_[i];
      }
      ++num_found;
    }
    records_.resize(num_found);
    places_.resize(num_found);
    session_.records = std::move(records_);
    if (parts_ == RecordParts::kWhole) return;
    lines_.judgements.resize(num_found);
    lines_.trials = std::move(places_);
    session_.lines = std::move(lines_);
  }

 private:
  void AddRecord(TrialRecord record, const FileLine& line) {
    const std::string& file = lines_.files.back();
    const auto found = place_of_.find(record.plan.id);
    if (found == place_of_.end() || !(session_.plan[found->second] == record.plan)) {
      throw Error(ErrorKind::kFormat, DescribeForeign(record.plan.id));
    }
    LinePlace& place = places_[found->second];
    if (place.file < 0) {
      place = {static_cast<int>(lines_.files.size()) - 1, line.number, line.start,
               line.text.size()};
      if (parts_ == RecordParts::kBrief) MakeBrief(record.result);
      if (parts_ != RecordParts::kPlaces) records_[found->second] = std::move(record);
    } else if (ToJson(LoadKnown(found->second)) != ToJson(record)) {
      conflicts_.Fail(file, line.number,
                      "trial " + record.plan.id + " (" + DescribeTrial(record.plan) +
                          ") differs from " + NameOfLine(lines_, place));
    }
  }

  TrialRecord LoadKnown(size_t index) const {
    if (parts_ == RecordParts::kWhole) return records_[index];
    return ParseJournalLine(ReadLine(lines_, places_[index]));
  }

  Session& session_;
  RecordParts parts_;
  std::unordered_map<std::string_view, size_t> place_of_;  // looked up only, never iterated
  std::vector<TrialRecord> records_;                       // by place in the plan
  std::vector<LinePlace> places_;                          // of the same
  RecordLines lines_;
  Diagnostics conflicts_;
};

/** @param num_known  of the damages, which its hashes have shown. */
void RefuseForeign(const Session& session, size_t num_known, OnDamage on_damage) {
  RefuseDamage(
      "the session", session.folder,
      {session.damage.begin() + static_cast<std::ptrdiff_t>(num_known), session.damage.end()},
      on_damage,
      "graspbench merge DIR --set-aside FILE leaves out what one of these files holds and "
      "keeps it beside; report, export, judge and run --resume go on without these lines "
      "with --accept-damage");
}

/** Without judgements. @param only  patterns of the files that may be read; empty: all. */
Session LoadFiles(const fs::path& folder, OnDamage on_damage, RecordParts parts,
                  const std::vector<std::string>& only) {
  Frozen frozen = LoadFrozen(kSessionStore, folder, on_damage, only);
  Session session;
  session.folder = folder;
  session.damage = std::move(frozen.damage);
  const size_t num_damages = session.damage.size();
  session.config = SessionConfigFromJson(frozen.config, (folder / kSessionStore.file).string());
  session.physics_version = frozen.physics_version;
  session.plan = LoadPlan(folder / "plan.jsonl");
  Merger merger(folder, session, parts);
  for (const fs::path& path : ListJournals(folder)) {
    const std::string file = "journal/" + path.filename().string();
    if (only.empty() || IsMatch(file, only)) merger.AddFile(file);
  }
  merger.TakeRecords();
  RefuseForeign(session, num_damages, on_damage);
  return session;
}

/** The first condition in which they differ, there and now; empty: in none. */
std::string DescribeConditions(const std::vector<Condition>& there,
                               const std::vector<Condition>& now) {
  const auto describe = [](const std::vector<Condition>& conditions, size_t i) {
    return i < conditions.size() ? conditions[i].name : "none";
  };
  for (size_t i = 0; i < std::max(there.size(), now.size()); ++i) {
    if (describe(there, i) == describe(now, i)) continue;
    return "\n  condition " + std::to_string(i + 1) + ": " + describe(there, i) + " and " +
           describe(now, i);
  }
  return "";
}

}  // namespace

TrialRecord LoadWhole(const Session& session, const TrialRecord& record) {
  const RecordLines& lines = session.lines;
  if (lines.trials.empty()) return record;
  const auto index = static_cast<size_t>(&record - session.records.data());
  GRASPBENCH_DEMAND(index < session.records.size(), record.plan.id);
  LinePlace place = lines.trials[index];
  try {
    TrialRecord whole = ParseJournalLine(ReadLine(lines, place));
    if (!(whole.plan == record.plan))
      throw Error(ErrorKind::kFormat, "it belongs to another trial");
    place = lines.judgements[index];
    if (place.file >= 0) whole.judgement = ParseJudgementLine(ReadLine(lines, place));
    return whole;
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::kFormat) throw;
    throw Error(ErrorKind::kFormat,
                NameOfLine(lines, place) + " has changed since the session was loaded: " +
                    e.what() + "; make sure that no other process writes there, and start again");
  }
}

std::string DescribeForeign(const std::string& trial_id) {
  return "trial " + trial_id + " is not in the plan: the line belongs to another session";
}

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

bool HasSession(const fs::path& folder) { return HasFrozen(kSessionStore, folder); }

void CreateSession(const fs::path& folder, const SessionConfig& config,
                   const std::vector<PlannedTrial>& plan) {
  if (HasSession(folder)) {
    throw Error(ErrorKind::kUsage, "\"" + folder.string() +
                                       "\" already holds a session; continue it with --resume or "
                                       "choose another folder with --out");
  }
  std::string lines;
  for (const PlannedTrial& planned : plan) lines += FormatJson(ToJson(planned)) + "\n";
  MakeFolder(folder / "journal");
  WriteFileAtomically(folder / "plan.jsonl", lines);
  WriteFrozen(kSessionStore, folder, ToJson(config));
}

Session LoadSession(const fs::path& folder, OnDamage on_damage, RecordParts parts) {
  Session session = LoadFiles(folder, on_damage, parts, {});
  const size_t num_damages = session.damage.size();
  LoadJudgements(folder, session);
  RefuseForeign(session, num_damages, on_damage);
  const std::vector<WorkerStart> starts = LoadWorkers(folder, session.findings).starts;
  session.machine_differences = DescribeDifferences(starts);
  const std::string unchecked = DescribeUnchecked(FindUnchecked(folder, starts));
  if (!unchecked.empty()) session.machine_differences.push_back(unchecked);
  return session;
}

Session LoadPlannedSession(const fs::path& folder) {
  return LoadFiles(folder, OnDamage::kRefuse, RecordParts::kBrief,
                   {kSessionStore.file, "plan.jsonl"});
}

Session LoadShardOfSession(const fs::path& folder, const std::string& label) {
  return LoadFiles(folder, OnDamage::kRefuse, RecordParts::kBrief,
                   {kSessionStore.file, "plan.jsonl", "inputs/policies.json", "inputs/grasps/*",
                    "inputs/*/*/*", "inputs/*/*/*/*", "journal/" + label + "-*.jsonl",
                    "journal/merged-*.jsonl", "workers/" + label + "-*.jsonl"});
}

JournalWriter::JournalWriter(const fs::path& journal, bool has_index) : file_(journal) {
  if (has_index) index_.emplace(journal);
}

void JournalWriter::Append(const TrialRecord& record) {
  file_.Append(FormatJournalLine(record) + "\n");
  if (index_) index_->Append(record.plan.id, file_.size());
}

std::vector<PlannedTrial> FindUnfinished(const Session& session) {
  std::vector<PlannedTrial> unfinished;
  auto record = session.records.begin();
  for (const PlannedTrial& planned : session.plan) {
    if (record != session.records.end() && record->plan == planned) {
      ++record;
    } else {
      unfinished.push_back(planned);
    }
  }
  return unfinished;
}

void CheckSameSession(const Session& session, const SessionConfig& config,
                      const std::vector<PlannedTrial>& plan) {
  std::string text = ListDifferences(FindConfigDifferences(session.config, config)) +
                     DescribeConditions(session.config.conditions, config.conditions);
  if (!text.empty()) {
    throw Error(ErrorKind::kUsage,
                "the session was started with other settings (there and now):" + text +
                    "\nresume it without them, or start another session with --out");
  }
  if (session.plan == plan) return;
  std::vector<std::string> changed;
  for (const PlannedTrial& planned : plan) {
    const std::string cell = planned.hand + ", " + planned.object + ", " + planned.grasp;
    if (std::find(session.plan.begin(), session.plan.end(), planned) == session.plan.end() &&
        (changed.empty() || changed.back() != cell)) {
      changed.push_back(cell);
    }
  }
  constexpr size_t kMaxListed = 5;
  for (size_t i = 0; i < changed.size() && i < kMaxListed; ++i) text += "\n  " + changed[i];
  if (changed.size() > kMaxListed) {
    text += "\n  and " + std::to_string(changed.size() - kMaxListed) + " more";
  }
  throw Error(ErrorKind::kUsage,
              "the session has the same settings, but a hand, an object, a grasp" +
                  (HasArm(config.arm) ? ", the arm \"" + config.arm.model + "\"" : "") +
                  " or the physics has changed since; old and new results must not be mixed:" +
                  text + "\nstart another session with --out");
}

}  // namespace graspbench
