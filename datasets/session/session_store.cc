#include "datasets/session/session_store.h"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "datasets/journal/checked_line.h"
#include "datasets/session/frozen_folder.h"
#include "datasets/session/judgement_store.h"
#include "datasets/session/worker_log.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

std::vector<PlannedTrial> LoadPlan(const fs::path& path) {
  std::vector<PlannedTrial> plan;
  Diagnostics problems;
  std::set<std::string> seen;
  ForEachLine(ReadFile(path), [&](std::string_view line, int number, bool) {
    try {
      PlannedTrial planned = PlannedTrialFromJson(Json::parse(line));
      if (!seen.insert(planned.id).second) {
        problems.Fail("plan.jsonl", number, "trial " + planned.id + " is planned twice");
      }
      plan.push_back(std::move(planned));
    } catch (const std::exception& e) {  // of the JSON library, or an Error of a value
      problems.Fail("plan.jsonl", number, e.what());
    }
  });
  problems.ThrowIfErrors(ErrorKind::kFormat,
                         "\"" + path.string() +
                             "\" is damaged; it is written once and never changed, so take it "
                             "from a backup");
  return plan;
}

/** Finished trials by their place in the plan, gathered from journals in any order. */
class Merger {
 public:
  Merger(const std::vector<PlannedTrial>& plan, Diagnostics& findings)
      : plan_(plan), found_(plan.size()), findings_(findings) {
    for (size_t i = 0; i < plan.size(); ++i) place_of_.emplace(plan[i].id, i);
  }

  void AddLine(std::string_view line, const std::string& file, int number, bool is_whole) {
    if (!is_whole) {
      findings_.Warn(file, number,
                     "the last line was not finished when the program stopped; "
                     "its trial counts as not run");
      return;
    }
    try {
      AddRecord(ParseJournalLine(line), file, number);
    } catch (const Error& e) {
      findings_.Warn(file, number,
                     std::string("skipped: ") + e.what() + "; its trial counts as not run");
    }
  }

  /** @throws Error(kFormat) when a trial has two different results. */
  std::vector<TrialRecord> TakeRecords() {
    conflicts_.ThrowIfErrors(
        ErrorKind::kFormat,
        "one trial has different results: two versions of the program have written to this session "
        "or a file was edited; delete the wrong lines and seal the rest with graspbench verify "
        "--repair, or run the session anew");
    std::vector<TrialRecord> records;
    for (Found& found : found_) {
      if (!found.file.empty()) records.push_back(std::move(found.record));
    }
    return records;
  }

 private:
  struct Found {
    TrialRecord record;
    std::string file;  ///< empty: not found
    int line = 0;
  };

  void AddRecord(TrialRecord record, const std::string& file, int number) {
    const auto place = place_of_.find(record.plan.id);
    if (place == place_of_.end() || !(plan_[place->second] == record.plan)) {
      findings_.Warn(file, number, "skipped: trial " + record.plan.id + " is not in the plan");
      return;
    }
    Found& found = found_[place->second];
    if (found.file.empty()) {
      found = {std::move(record), file, number};
    } else if (ToJson(found.record) != ToJson(record)) {
      conflicts_.Fail(file, number,
                      "trial " + record.plan.id + " (" + DescribeTrial(record.plan) +
                          ") differs from " + found.file + ":" + std::to_string(found.line));
    }
  }

  const std::vector<PlannedTrial>& plan_;
  std::unordered_map<std::string, size_t> place_of_;  // looked up only, never iterated
  std::vector<Found> found_;
  Diagnostics& findings_;
  Diagnostics conflicts_;
};

}  // namespace

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

std::vector<fs::path> ListJournals(const fs::path& folder, const std::string& subfolder) {
  std::vector<fs::path> paths;
  std::error_code status;
  for (const auto& entry : fs::directory_iterator(folder / subfolder, status)) {
    if (entry.path().extension() == ".jsonl") paths.push_back(entry.path());
  }
  if (status && status != std::errc::no_such_file_or_directory) {
    throw Error(ErrorKind::kIo, "cannot read folder \"" + (folder / subfolder).string() +
                                    "\": " + status.message());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

namespace {

/** Without judgements. @param only  patterns of the files that may be read; empty: all. */
Session LoadFiles(const fs::path& folder, OnDamage on_damage,
                  const std::vector<std::string>& only) {
  Frozen frozen = LoadFrozen(kSessionStore, folder, on_damage, only);
  Session session;
  session.damage = std::move(frozen.damage);
  if (!frozen.is_sealed) {
    session.findings.Warn(kSessionStore.file, 0,
                          "the session is older than manifests: changes of its configuration, its "
                          "plan and missing lines are not noticed");
  }
  session.config = SessionConfigFromJson(frozen.config, (folder / kSessionStore.file).string());
  session.plan = LoadPlan(folder / "plan.jsonl");
  Merger merger(session.plan, session.findings);
  for (const fs::path& path : ListJournals(folder)) {
    const std::string file = "journal/" + path.filename().string();
    if (!only.empty() && !IsMatch(file, only)) continue;
    ForEachLine(ReadFile(path), [&](std::string_view line, int number, bool is_whole) {
      merger.AddLine(line, file, number, is_whole);
    });
  }
  session.records = merger.TakeRecords();
  return session;
}

}  // namespace

Session LoadSession(const fs::path& folder, OnDamage on_damage) {
  Session session = LoadFiles(folder, on_damage, {});
  LoadJudgements(folder, session);
  session.machine_differences = DescribeDifferences(LoadWorkers(folder, session.findings));
  return session;
}

Session LoadPlannedSession(const fs::path& folder) {
  return LoadFiles(folder, OnDamage::kRefuse, {kSessionStore.file, "plan.jsonl"});
}

Session LoadShardOfSession(const fs::path& folder, const std::string& label) {
  return LoadFiles(folder, OnDamage::kRefuse,
                   {kSessionStore.file, "plan.jsonl", "journal/" + label + "-*.jsonl",
                    "workers/" + label + "-*.jsonl"});
}

fs::path FindJournal(const fs::path& subfolder, int worker, const std::string& label) {
  const std::string name = (label.empty() ? "" : label + "-") + std::to_string(worker);
  fs::path path = subfolder / (name + ".jsonl");
  for (int number = 2; !label.empty() && EndsInTornLine(path); ++number) {
    path = subfolder / (name + "-" + std::to_string(number) + ".jsonl");
  }
  return path;
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
  std::string text = ListDifferences(FindConfigDifferences(session.config, config));
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
              "the session was started with the same settings, but a hand, an object, a grasp or "
              "the physics has changed since; its results and new ones do not belong together:" +
                  text + "\nstart another session with --out");
}

}  // namespace graspbench
