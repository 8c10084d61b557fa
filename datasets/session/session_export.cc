#include "core/base/error.h"
#include "core/base/files.h"
#include "datasets/session/session_index.h"
#include "datasets/session/session_store.h"
#include "datasets/session/trial_table.h"

namespace graspbench {

void ExportSession(const std::filesystem::path& folder, const Session& session) {
  const std::filesystem::path exports = folder / "export";
  MakeFolder(exports);
  const std::vector<TrialColumn> columns = ListTrialColumns(session.records);
  std::string lines;
  for (const TrialRecord& record : session.records) lines += FormatJson(ToJson(record)) + "\n";
  WriteFileAtomically(exports / "trials.csv", FormatCsv(columns, session.records));
  WriteFileAtomically(exports / "trials.schema.json",
                      FormatJson(MakeTableSchema(columns, "trial_id"), 2) + "\n");
  WriteFileAtomically(exports / "records.jsonl", lines);
  WriteFileAtomically(exports / "events.csv",
                      FormatCsv(ListEventColumns(), ListEvents(session.records)));
  WriteFileAtomically(exports / "events.schema.json",
                      FormatJson(MakeTableSchema(ListEventColumns(), ""), 2) + "\n");
  WriteFileAtomically(folder / "index.sqlite", MakeSessionIndex(session, columns));
}

}  // namespace graspbench
