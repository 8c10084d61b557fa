#include "datasets/session/check_records.h"

#include "core/base/error.h"
#include "datasets/session/session_store.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** @param name  of the session from the folder that is checked, with a slash; empty: it itself. */
Diagnostics CheckSession(const fs::path& folder, const std::string& name, StoreState& state) {
  try {
    Session session = LoadSession(folder / name, OnDamage::kAccept, RecordParts::kBrief);
    for (const Damage& damage : session.damage) {
      if (damage.line == 0) continue;  // a manifest that was made anew, as the state says
      state.damages.push_back({name + damage.path, damage.line, damage.text});
    }
    // Of an older session the state itself says that its files cannot be compared.
    if (state.is_sealed) return std::move(session.findings);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kFormat) throw;
    state.damages.push_back({name + "journal", 0, error.what()});
  }
  return {};
}

}  // namespace

Diagnostics CheckRecords(const fs::path& folder, StoreState& state) {
  const StoreKind* kind = FindStoreKind(folder);
  if (!kind || !state.damages.empty()) return {};
  Diagnostics findings;
  if (kind == &kSessionStore) findings = CheckSession(folder, "", state);
  for (const std::string& store : ListMatches(folder, kind->stores)) {
    if (FindStoreKind(folder / store) != &kSessionStore) continue;
    const Diagnostics inner = CheckSession(folder, store + "/", state);
    for (const Diagnostic& one : inner.entries()) {
      findings.Warn(store + "/" + one.file, one.line, one.text);
    }
  }
  return findings;
}

}  // namespace graspbench
