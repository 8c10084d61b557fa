#include "datasets/session/merge_sessions.h"

#include <set>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "datasets/journal/append_file.h"
#include "datasets/session/explanation_store.h"
#include "datasets/session/judgement_store.h"
#include "datasets/shards/worker_log.h"

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
  const auto seal_plan = [](const fs::path& of) { return SealFile(of, "plan.jsonl").sha256; };
  if (here == there && seal_plan(folder) == seal_plan(other)) return;
  throw Error(ErrorKind::kUsage,
              "\"" + other.string() + "\" holds a different session from \"" + folder.string() +
                  "\", nothing was merged:" + describe(folder, here) + describe(other, there));
}

/** Which lines are to be appended. Of a session of many trials there is no room for records: lines
are read again where they are compared or copied. */
class Additions {
 public:
  explicit Additions(const fs::path& folder) : folder_(folder) {
    const Session session = LoadSession(folder, OnDamage::kRefuse, RecordParts::kPlaces);
    AddLines(session);
    known_.reserve(session.plan.size());
    for (size_t i = 0; i < session.plan.size(); ++i) {
      known_.push_back({{0, session.lines.trials[i]}, {0, session.lines.judgements[i]}});
    }
    known_starts_ = ListStartLines(folder);
  }

  void Add(const fs::path& other) {
    const Session session = LoadSession(other, OnDamage::kRefuse, RecordParts::kPlaces);
    CheckSamePlan(folder_, other);
    const size_t index = AddLines(session);
    for (size_t i = 0; i < session.plan.size(); ++i) {
      const Line trial{index, session.lines.trials[i]};
      if (!trial.IsThere()) continue;
      AddRecord(session.plan[i], known_[i], trial, {index, session.lines.judgements[i]});
    }
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
    Append("journal", trials_);
    Append("judge", judgements_);
    AppendStarts(folder_, workers_);
    return static_cast<int>(trials_.size());
  }

 private:
  /** A line of one of the sessions. */
  struct Line {
    size_t session;
    LinePlace place;
    bool IsThere() const { return place.file >= 0; }
  };
  struct Known {
    Line trial, judgement;
  };

  size_t AddLines(const Session& session) {
    sessions_.push_back({session.folder, session.lines.files, {}, {}});
    return sessions_.size() - 1;
  }

  std::string Read(const Line& line) const { return ReadLine(sessions_[line.session], line.place); }

  void AddRecord(const PlannedTrial& planned, Known& mine, const Line& trial,
                 const Line& judgement) {
    if (!mine.trial.IsThere()) {
      mine.trial = trial;
      trials_.push_back(trial);
    } else if (!HasSameResult(Read(mine.trial), Read(trial))) {
      Fail(planned, trial, "another result than in " + NameSource(mine.trial));
    }
    if (!judgement.IsThere()) return;
    if (!mine.judgement.IsThere()) {
      mine.judgement = judgement;
      judgements_.push_back(judgement);
    } else if (!HasSameJudgement(Read(mine.judgement), Read(judgement))) {
      Fail(planned, judgement, "another judgement than in \"" + folder_.string() + "\"");
    }
  }

  static bool HasSameResult(const std::string& a, const std::string& b) {
    return a == b || ToJson(ParseJournalLine(a).result) == ToJson(ParseJournalLine(b).result);
  }
  static bool HasSameJudgement(const std::string& a, const std::string& b) {
    return a == b || RecordToJson(ParseJudgementLine(a)) == RecordToJson(ParseJudgementLine(b));
  }

  void Fail(const PlannedTrial& planned, const Line& line, const std::string& what) {
    conflicts_.Fail(sessions_[line.session].folder.string(), 0,
                    "trial " + planned.id + " (" + DescribeTrial(planned) + ") has " + what);
  }

  /** The folder or journal that has brought the trial's record. */
  std::string NameSource(const Line& line) const {
    const RecordLines& lines = sessions_[line.session];
    return line.session > 0 ? "\"" + lines.folder.string() + "\""
                            : lines.files[static_cast<size_t>(line.place.file)];
  }

  void Append(const char* subfolder, const std::vector<Line>& lines) const {
    constexpr size_t kPiece = 1 << 24;  // [bytes]; each is waited for until it is on the disk
    if (lines.empty()) return;
    MakeFolder(folder_ / subfolder);
    const fs::path path = FindJournal(folder_ / subfolder, 0, kMergedLabel);
    {
      AppendFile file(path);
      std::string text;
      for (const Line& line : lines) {
        text += Read(line) + "\n";
        if (text.size() < kPiece) continue;
        file.Append(text);
        text.clear();
      }
      if (!text.empty()) file.Append(text);
    }
    if (subfolder == std::string("journal")) JournalIndex index(path);
  }

  fs::path folder_;
  std::vector<RecordLines> sessions_;      // their folders and files; the first is folder_
  std::vector<Known> known_;               // by place in the plan
  std::vector<Line> trials_, judgements_;  // new ones
  std::set<std::string> known_starts_;
  std::string workers_;
  Diagnostics conflicts_;
};

}  // namespace

int MergeSessions(const fs::path& folder, const std::vector<fs::path>& others) {
  if (others.empty()) return 0;
  Additions additions(folder);
  for (const fs::path& other : others) additions.Add(other);
  const int num_trials = additions.Write();
  for (const fs::path& other : others) MergeExplanations(folder, other);
  return num_trials;
}

}  // namespace graspbench
