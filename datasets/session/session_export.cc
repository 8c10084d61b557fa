#include "core/base/atomic_file.h"
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
  const std::vector<CsvColumn<EventRow>> event_columns = ListEventColumns();
  AtomicFile trials(exports / "trials.csv"), events(exports / "events.csv"),
      lines(exports / "records.jsonl");
  SessionIndex index(columns);
  trials.Write(FormatCsvHeading(columns));
  events.Write(FormatCsvHeading(event_columns));
  ForEachWhole(session, [&](const TrialRecord& record) {
    const std::vector<Json> cells = MakeCsvCells(columns, record);
    trials.Write(FormatCsvLine(cells));
    index.AddTrial(cells);
    events.Write(FormatCsvLines(event_columns, ListEvents(record)));
    lines.Write(FormatJson(ToJson(record)) + "\n");
  });
  trials.Commit();
  WriteFileAtomically(exports / "trials.schema.json",
                      FormatJson(MakeTableSchema(columns, "trial_id"), 2) + "\n");
  lines.Commit();
  events.Commit();
  WriteFileAtomically(exports / "events.schema.json",
                      FormatJson(MakeTableSchema(event_columns, ""), 2) + "\n");
  index.Write(session, folder / "index.sqlite");
}

}  // namespace graspbench
