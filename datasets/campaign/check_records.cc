#include "datasets/campaign/check_records.h"

#include "core/base/error.h"
#include "datasets/judged_grasps/grasp_store.h"
#include "datasets/scene/development_store.h"
#include "datasets/scene/evaluation_journal.h"
#include "datasets/session/session_store.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** @param name  of the session from the folder that is checked, with a slash; empty: it itself. */
void CheckSession(const fs::path& folder, const std::string& name, StoreState& state,
                  Diagnostics& findings) {
  try {
    const Session session = LoadSession(folder / name, OnDamage::kAccept, RecordParts::kBrief);
    for (const Damage& damage : session.damage) {
      if (damage.line == 0) continue;  // a manifest that was made again, as the state says
      state.damages.push_back({name + damage.path, damage.line, damage.text});
    }
    // Of an older session the state itself says that its files cannot be compared.
    if (!state.is_sealed) return;
    for (const Diagnostic& one : session.findings.entries()) {
      findings.Warn(name + one.file, one.line, one.text);
    }
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kFormat) throw;
    state.damages.push_back({name + "journal", 0, error.what()});
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

}  // namespace

Diagnostics CheckRecords(const fs::path& folder, StoreState& state) {
  const StoreKind* kind = FindStoreKind(folder);
  Diagnostics findings;
  if (!kind || !state.damages.empty()) return findings;
  if (kind == &kSessionStore) CheckSession(folder, "", state, findings);
  for (const std::string& store : ListMatches(folder, kind->stores)) {
    if (FindStoreKind(folder / store) != &kSessionStore) continue;
    CheckSession(folder, store + "/", state, findings);
  }
  const std::vector<std::string> searches =
      ListMatches(folder, {"journal.jsonl", "scenes/*/journal.jsonl", "comparison/*/*.jsonl"});
  if (kind == &kDevelopmentStore) {
    CheckAnswers<DevelopmentRecord>(folder, searches, state, findings);
  } else if (kind == &kJudgedGraspStore) {
    CheckAnswers<JudgedGrasp>(folder, searches, state, findings);
  } else if (kind != &kSessionStore) {
    CheckAnswers<EvaluationRecord>(folder, searches, state, findings);
  }
  return findings;
}

}  // namespace graspbench
