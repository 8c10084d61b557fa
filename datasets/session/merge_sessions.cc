#include "datasets/session/merge_sessions.h"

#include <set>
#include <unordered_map>

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/hash.h"
#include "datasets/journal/append_file.h"
#include "datasets/session/judgement_store.h"
#include "datasets/session/worker_log.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kMergedLabel[] = "merged";

/** The program's version may differ: what matters are schema, physics, settings and plan. */
void CheckSamePlan(const fs::path& folder, const fs::path& other) {
  const auto load = [](const fs::path& of) {
    Json frozen = Json::parse(ReadFile(of / kSessionStore.file));
    frozen.erase("program_version");
    return frozen;
  };
  const auto describe = [](const fs::path& of, const Json& frozen) {
    return "\n  " + of.string() + ": schema " + FormatJson(frozen.at("schema")) + ", physics " +
           FormatJson(frozen.at("physics_version")) + ", settings " +
           CalcHashHex(FormatJson(frozen.at("config"))) + ", plan " +
           CalcHashHex(ReadFile(of / "plan.jsonl"));
  };
  const Json here = load(folder), there = load(other);
  if (here == there && ReadFile(folder / "plan.jsonl") == ReadFile(other / "plan.jsonl")) return;
  throw Error(ErrorKind::kUsage,
              "\"" + other.string() + "\" holds another session than \"" + folder.string() +
                  "\", nothing was merged:" + describe(folder, here) + describe(other, there));
}

/** What is to be appended, one text a file. */
class Additions {
 public:
  explicit Additions(const fs::path& folder) : folder_(folder), session_(LoadSession(folder)) {
    for (TrialRecord& record : session_.records) records_.emplace(record.plan.id, record);
    Diagnostics findings;
    for (const WorkerStart& start : LoadWorkers(folder, findings)) {
      known_starts_.insert(FormatWorkerLine(start));
    }
  }

  void Add(const fs::path& other) {
    const Session session = LoadSession(other);
    CheckSamePlan(folder_, other);
    for (const TrialRecord& record : session.records) AddRecord(record, other);
    Diagnostics findings;
    for (const WorkerStart& start : LoadWorkers(other, findings)) {
      const std::string line = FormatWorkerLine(start);
      if (known_starts_.insert(line).second) workers_ += line + "\n";
    }
  }

  int Write() const {
    conflicts_.ThrowIfErrors(
        ErrorKind::kFormat,
        "one trial has different results: two builds or machines have worked on this session; "
        "nothing was merged, keep the results of one of them");
    Append("journal", journal_);
    Append("judge", judge_);
    Append("workers", workers_);
    return num_new_;
  }

 private:
  void AddRecord(const TrialRecord& record, const fs::path& other) {
    TrialRecord bare = record;
    bare.judgement.reset();
    const auto [known, is_new] = records_.emplace(record.plan.id, bare);
    if (is_new) {
      ++num_new_;
      journal_ += FormatJournalLine(bare) + "\n";
    }
    TrialRecord& mine = known->second;
    if (ToJson(mine.result) != ToJson(record.result)) Fail(record, other, "another result");
    if (!record.judgement) return;
    if (!mine.judgement) {
      mine.judgement = record.judgement;
      judge_ += FormatJudgementLine(record.plan.id, *record.judgement) + "\n";
    } else if (RecordToJson(*mine.judgement) != RecordToJson(*record.judgement)) {
      Fail(record, other, "another judgement");
    }
  }

  void Fail(const TrialRecord& record, const fs::path& other, const std::string& what) {
    conflicts_.Fail(other.string(), 0,
                    "trial " + record.plan.id + " (" + DescribeTrial(record.plan) + ") has " +
                        what + " than in \"" + folder_.string() + "\" or a folder before this one");
  }

  void Append(const char* subfolder, const std::string& lines) const {
    if (lines.empty()) return;
    MakeFolder(folder_ / subfolder);
    AppendFile(FindJournal(folder_ / subfolder, 0, kMergedLabel)).Append(lines);
  }

  fs::path folder_;
  Session session_;
  std::unordered_map<std::string, TrialRecord> records_;  // looked up only, never iterated
  std::set<std::string> known_starts_;
  std::string journal_, judge_, workers_;
  int num_new_ = 0;
  Diagnostics conflicts_;
};

}  // namespace

int MergeSessions(const fs::path& folder, const std::vector<fs::path>& others) {
  if (others.empty()) return 0;
  Additions additions(folder);
  for (const fs::path& other : others) additions.Add(other);
  return additions.Write();
}

}  // namespace graspbench
