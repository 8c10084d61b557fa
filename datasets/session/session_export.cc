#include <optional>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "datasets/session/session_index.h"
#include "datasets/session/session_store.h"
#include "datasets/session/trial_table.h"

namespace graspbench {

void ExportSession(const std::filesystem::path& folder, const Session& session, bool with_records) {
  const std::filesystem::path exports = folder / "export";
  MakeFolder(exports);
  // Records that were asked for once do not get old.
  with_records = with_records || std::filesystem::exists(exports / "records.jsonl");
  UnsealOutput(exports);
  const std::vector<TrialColumn> columns = ListTrialColumns(session.records, session.config);
  const std::vector<CsvColumn<EventRow>> event_columns = ListEventColumns();
  AtomicFile trials(exports / "trials.csv"), events(exports / "events.csv");
  std::optional<AtomicFile> lines;
  if (with_records) lines.emplace(exports / "records.jsonl");
  SessionIndex index(columns);
  trials.Write(FormatCsvHeading(columns));
  events.Write(FormatCsvHeading(event_columns));
  ForEachWhole(session, [&](const TrialRecord& record) {
    const std::vector<Json> cells = MakeCsvCells(columns, record);
    trials.Write(FormatCsvLine(cells));
    index.AddTrial(cells);
    events.Write(FormatCsvLines(event_columns, ListEvents(record)));
    if (lines) lines->Write(FormatJson(ToJson(record)) + "\n");
  });
  trials.Commit();
  events.Commit();
  if (lines) lines->Commit();
  WriteFileAtomically(exports / "trials.schema.json",
                      FormatJson(MakeTableSchema(columns, "trial_id"), 2) + "\n");
  WriteFileAtomically(exports / "events.schema.json",
                      FormatJson(MakeTableSchema(event_columns, ""), 2) + "\n");
  index.Write(session, folder / "index.sqlite");
  std::vector<std::string> files = {"../index.sqlite", "events.csv", "events.schema.json",
                                    "trials.csv", "trials.schema.json"};
  if (with_records) files.push_back("records.jsonl");
  SealOutput(exports, files);
}

}  // namespace graspbench
