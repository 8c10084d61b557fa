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
    known_starts_ = ListStartLines(folder);
  }

  void Add(const fs::path& other) {
    const Session session = LoadSession(other);
    CheckSamePlan(folder_, other);
    for (const TrialRecord& record : session.records) AddRecord(record, other);
    workers_ += CollectStarts(other, known_starts_);
  }

  int Write() const {
    conflicts_.ThrowIfErrors(
        ErrorKind::kFormat,
        "one trial has different results: two builds or machines have worked on this session; "
        "nothing was merged; leave one of the folders out" +
            (ListJournals(folder_).empty()
                 ? ""
                 : ", or merge with --set-aside FILE, which leaves out what a journal in \"" +
                       folder_.string() + "\" holds"));
    Append("journal", journal_);
    Append("judge", judge_);
    AppendStarts(folder_, workers_);
    return num_new_;
  }

 private:
  void AddRecord(const TrialRecord& record, const fs::path& other) {
    TrialRecord bare = record;
    bare.judgement.reset();
    const auto [known, is_new] = records_.emplace(record.plan.id, bare);
    if (is_new) {
      ++num_new_;
      sources_.emplace(record.plan.id, other.string());
      journal_ += FormatJournalLine(bare) + "\n";
    }
    TrialRecord& mine = known->second;
    if (ToJson(mine.result) != ToJson(record.result))
      Fail(record, other, "another result than in " + FindSource(record.plan.id));
    if (!record.judgement) return;
    if (!mine.judgement) {
      mine.judgement = record.judgement;
      judge_ += FormatJudgementLine(record.plan.id, *record.judgement) + "\n";
    } else if (RecordToJson(*mine.judgement) != RecordToJson(*record.judgement)) {
      Fail(record, other, "another judgement than in \"" + folder_.string() + "\"");
    }
  }

  void Fail(const TrialRecord& record, const fs::path& other, const std::string& what) {
    conflicts_.Fail(
        other.string(), 0,
        "trial " + record.plan.id + " (" + DescribeTrial(record.plan) + ") has " + what);
  }

  /** The folder or journal that has brought the trial's record. */
  std::string FindSource(const std::string& id) const {
    const auto source = sources_.find(id);
    if (source != sources_.end()) return "\"" + source->second + "\"";
    for (const fs::path& path : ListJournals(folder_)) {
      bool is_here = false;
      ForEachTrialOf(path, [&](std::string_view other) { is_here = is_here || other == id; });
      if (is_here) return "journal/" + path.filename().string();
    }
    return "\"" + folder_.string() + "\"";
  }

  void Append(const char* subfolder, const std::string& lines) const {
    if (lines.empty()) return;
    MakeFolder(folder_ / subfolder);
    const fs::path path = FindJournal(folder_ / subfolder, 0, kMergedLabel);
    AppendFile(path).Append(lines);
    if (subfolder == std::string("journal")) JournalIndex index(path);
  }

  fs::path folder_;
  Session session_;
  std::unordered_map<std::string, TrialRecord> records_;  // looked up only, never iterated
  std::unordered_map<std::string, std::string> sources_;  // of new ones; looked up only
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
