#include <optional>

#include "core/base/error.h"
#include "core/base/files/atomic_file.h"
#include "core/base/files/files.h"
#include "datasets/records/trial_table.h"
#include "datasets/session/provenance.h"
#include "datasets/session/session_index.h"
#include "datasets/session/session_store.h"

namespace graspbench {
namespace {

/** @pre the files are sealed as they are. */
Json MakeResource(const std::filesystem::path& exports, const std::string& name) {
  const ManifestFile file = SealFile(exports, name + ".csv");
  return {{"name", name},
          {"path", file.path},
          {"profile", "tabular-data-resource"},
          {"format", "csv"},
          {"mediatype", "text/csv"},
          {"encoding", "utf-8"},
          {"bytes", file.bytes},
          {"hash", "sha256:" + file.sha256},
          {"schema", name + ".schema.json"}};
}

/** A Frictionless Data Package of the tables, which names the records they were made from. */
std::string FormatDataPackage(const std::filesystem::path& exports, const ManifestOrigin& origin,
                              const std::vector<ExportTable>& more) {
  Json sources = Json::array();
  for (const ManifestSource& source : origin.inputs) {
    sources.push_back({{"title", source.path}, {"path", source.path}, {"sha256", source.sha256}});
  }
  Json resources = {MakeResource(exports, "trials"), MakeResource(exports, "events")};
  for (const ExportTable& table : more) resources.push_back(MakeResource(exports, table.name));
  const Json package = {
      {"profile", "tabular-data-package"},
      {"name", "graspbench-session"},
      {"description", "Trials of simulated grasps, one row each, and their contact events"},
      {"resources", resources},
      {"sources", sources}};
  return FormatJson(package, 2) + "\n";
}

}  // namespace

void ExportSession(const std::filesystem::path& folder, const Session& session, bool with_records,
                   const std::vector<ExportTable>& more) {
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
  for (const ExportTable& table : more) {
    WriteFileAtomically(exports / (table.name + ".csv"), table.csv);
    WriteFileAtomically(exports / (table.name + ".schema.json"),
                        FormatJson(table.schema, 2) + "\n");
  }
  index.Write(session, folder / "index.sqlite");
  const ManifestOrigin origin =
      session.folder.empty()
          ? MakeOrigin("graspbench export .")
          : MakeOutputOrigin(session.folder, "graspbench export .",
                             {"session.json", "plan.jsonl", "journal/*.jsonl", "judge/*.jsonl"});
  WriteFileAtomically(exports / "datapackage.json", FormatDataPackage(exports, origin, more));
  std::vector<std::string> files = {"../index.sqlite",    "datapackage.json", "events.csv",
                                    "events.schema.json", "trials.csv",       "trials.schema.json"};
  if (with_records) files.push_back("records.jsonl");
  for (const ExportTable& table : more) {
    files.insert(files.end(), {table.name + ".csv", table.name + ".schema.json"});
  }
  SealOutput(exports, files, origin);
}

}  // namespace graspbench
