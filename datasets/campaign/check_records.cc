#include "datasets/campaign/check_records.h"

#include <optional>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/json.h"
#include "datasets/judged_grasps/grasp_store.h"
#include "datasets/scene/answer_journal.h"
#include "datasets/scene/development_store.h"
#include "datasets/scene/rehearsal_store.h"
#include "datasets/session/find_trial.h"
#include "datasets/session/session_store.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** @param name  of the session from the folder that is checked, with a slash; empty: it itself.
@returns the session, where it can be read. */
std::optional<Session> CheckSession(const fs::path& folder, const std::string& name,
                                    StoreState& state, Diagnostics& findings) {
  try {
    Session session = LoadSession(folder / name, OnDamage::kAccept, RecordParts::kBrief);
    for (const Damage& damage : session.damage) {
      if (damage.line == 0) continue;  // a manifest that was made again, as the state says
      state.damages.push_back({name + damage.path, damage.line, damage.text});
    }
    for (const Diagnostic& one : session.findings.entries()) {
      findings.Warn(name + one.file, one.line, one.text);
    }
    return session;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kFormat) throw;
    state.damages.push_back({name + "journal", 0, error.what()});
    return std::nullopt;
  }
}

/** Is the session at `name` one on that above it? A part of a map is one of its own. */
void CheckExperiment(const Session& session, const Session& below, const std::string& name,
                     StoreState& state) {
  if (name.compare(0, 4, "map/") == 0) return;
  try {
    CheckIsExperimentOn(session, below, name);
  } catch (const Error& error) {
    state.damages.push_back({name, 0, error.what()});
  }
}

/** @param names  of journals of a search, from the folder. */
template <class Record>
void CheckAnswers(const fs::path& folder, const std::vector<std::string>& names, StoreState& state,
                  Diagnostics& findings) {
  for (const std::string& name : names) {
    const std::string place = name.substr(0, name.rfind('/') + 1);  // npos + 1 is 0
    Diagnostics found;
    std::vector<Damage> damages;
    LoadAnswers<Record>(folder / name, found, damages);
    for (const Damage& damage : damages) state.damages.push_back({name, damage.line, damage.text});
    for (const Diagnostic& one : found.entries()) {
      findings.Warn(place + one.file, one.line, one.text);
    }
  }
}

/** run.json has no seal, since every run adds to it. */
void CheckRunRecord(const fs::path& folder, Diagnostics& findings) {
  const fs::path path = folder / "run.json";
  if (!fs::exists(fs::symlink_status(path))) return;
  try {
    if (Json::parse(ReadFile(path)).at("runs").is_array()) return;
  } catch (const Error&) {
  } catch (const Json::exception&) {
  }
  findings.Warn("run.json", 0,
                "cannot be read: date, host and duration of the runs are lost. No result depends "
                "on them; the next run starts a new file");
}

}  // namespace

Diagnostics CheckRecords(const fs::path& folder, StoreState& state) {
  const StoreKind* kind = FindStoreKind(folder);
  Diagnostics findings;
  if (!kind || !state.damages.empty()) return findings;
  CheckRunRecord(folder, findings);
  std::optional<Session> session;
  if (kind == &kSessionStore) session = CheckSession(folder, "", state, findings);
  for (const std::string& store : ListMatches(folder, kind->stores)) {
    if (FindStoreKind(folder / store) != &kSessionStore) continue;
    const std::optional<Session> below = CheckSession(folder, store + "/", state, findings);
    if (session && below) CheckExperiment(*session, *below, store, state);
  }
  const std::vector<std::string> searches =
      ListMatches(folder, {"journal.jsonl", "scenes/*/journal.jsonl", "comparison/*/*.jsonl"});
  if (kind == &kDevelopmentStore) {
    CheckAnswers<DevelopmentRecord>(folder, searches, state, findings);
  } else if (kind == &kJudgedGraspStore) {
    CheckAnswers<JudgedGrasp>(folder, searches, state, findings);
  } else if (kind == &kRehearsalStore) {
    CheckAnswers<RehearsedPair>(folder, searches, state, findings);
  } else if (kind != &kSessionStore) {
    CheckAnswers<EvaluationRecord>(folder, searches, state, findings);
  }
  return findings;
}

}  // namespace graspbench
