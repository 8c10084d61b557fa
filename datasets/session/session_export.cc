#include <sqlite3.h>

#include <memory>
#include <optional>
#include <string_view>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/statistics/proportion.h"
#include "datasets/records/trial_table.h"
#include "datasets/session/ro_crate.h"
#include "datasets/session/session_store.h"

namespace graspbench {
namespace {

/** A database in memory. What can fail here is a column's name: they hold the ids of digits. */
class Database {
 public:
  Database() {
    Check(sqlite3_open(":memory:", &db_));
    Run("BEGIN");
  }
  ~Database() {
    sqlite3_finalize(insert_);
    sqlite3_close(db_);
  }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void Run(const std::string& sql) {
    Check(sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr));
  }

  /** Creates a table, to which AddRow adds from now on. */
  void AddTable(const std::string& name, const std::vector<std::string>& column_names,
                const std::vector<std::string>& column_types) {
    std::string definition, places;
    for (size_t i = 0; i < column_names.size(); ++i) {
      definition += (i > 0 ? ", " : "") + Quote(column_names[i]) + " " + column_types[i];
      places += i > 0 ? ", ?" : "?";
    }
    Run("CREATE TABLE " + name + " (" + definition + ")");
    const std::string sql = "INSERT INTO " + name + " VALUES (" + places + ")";
    sqlite3_finalize(insert_);
    insert_ = nullptr;
    Check(sqlite3_prepare_v2(db_, sql.c_str(), -1, &insert_, nullptr));
  }

  void AddRow(const std::vector<Json>& cells) {
    for (size_t i = 0; i < cells.size(); ++i) Bind(insert_, static_cast<int>(i) + 1, cells[i]);
    Check(sqlite3_step(insert_));
    sqlite3_reset(insert_);
  }

  void Write(const std::filesystem::path& path) {
    Run("COMMIT");
    sqlite3_int64 size = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> bytes(
        sqlite3_serialize(db_, "main", &size, 0), &sqlite3_free);
    GRASPBENCH_DEMAND(bytes, "serialize");
    WriteFileAtomically(path, std::string_view(reinterpret_cast<const char*>(bytes.get()),
                                               static_cast<size_t>(size)));
  }

 private:
  static std::string Quote(const std::string& name) {
    std::string quoted = "\"";
    for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
  }

  void Check(int status) {
    if (status == SQLITE_OK || status == SQLITE_DONE) return;
    throw Error(ErrorKind::kFormat, std::string("index.sqlite cannot be made from the records: ") +
                                        sqlite3_errmsg(db_));
  }

  void Bind(sqlite3_stmt* insert, int place, const Json& value) {
    if (value.is_null()) {
      sqlite3_bind_null(insert, place);
    } else if (value.is_string()) {
      const auto& text = value.str();
      sqlite3_bind_text(insert, place, text.data(), static_cast<int>(text.size()),
                        SQLITE_TRANSIENT);
    } else if (value.is_number_integer()) {
      sqlite3_bind_int64(insert, place, value.get<sqlite3_int64>());
    } else {
      sqlite3_bind_double(insert, place, value.get<double>());
    }
  }

  sqlite3* db_ = nullptr;
  sqlite3_stmt* insert_ = nullptr;
};

const char* SqlTypeOf(const std::string& type) {
  if (type == "string") return "TEXT";
  return type == "number" ? "REAL" : "INTEGER";
}

struct CellCounts {
  const PlannedTrial* first = nullptr;  ///< names the cell
  int num_planned = 0;
  int num_finished = 0;
  int num_successes = 0;
};

/** @pre plan and records are in the plan's order, in which a cell's trials are neighbours. */
std::vector<CellCounts> CountCells(const Session& session) {
  std::vector<CellCounts> cells;
  auto record = session.records.begin();
  for (const PlannedTrial& planned : session.plan) {
    if (cells.empty() || cells.back().first->hand != planned.hand ||
        cells.back().first->object != planned.object ||
        cells.back().first->grasp != planned.grasp) {
      cells.push_back({&planned});
    }
    ++cells.back().num_planned;
    if (record != session.records.end() && record->plan == planned) {
      ++cells.back().num_finished;
      cells.back().num_successes += record->result.outcome == Outcome::kSuccess;
      ++record;
    }
  }
  return cells;
}

/** The session as an SQLite database, for questions in SQL: table `trials` (the columns of
trial_table.h) and table `cells` (one row per hand, object and grasp of the plan). Made from plan
and journals; nothing is stored in it alone. The same session gives the same bytes. */
void AddTrialTable(const std::vector<TrialColumn>& columns, Database& db) {
  std::vector<std::string> names, types;
  for (const TrialColumn& column : columns) {
    names.push_back(column.name);
    types.push_back(SqlTypeOf(column.type));
  }
  types.front() += " PRIMARY KEY";
  db.AddTable("trials", names, types);
}

void AddCells(const Session& session, Database& db) {
  db.AddTable("cells",
              {"hand", "object", "grasp", "planned", "finished", "successes", "success_rate",
               "wilson_low", "wilson_high"},
              {"TEXT", "TEXT", "TEXT", "INTEGER", "INTEGER", "INTEGER", "REAL", "REAL", "REAL"});
  for (const CellCounts& cell : CountCells(session)) {
    const int n = cell.num_finished;
    const Interval interval = CalcWilsonInterval(cell.num_successes, n);
    const Json rate = JsonNumber(CalcShare(cell.num_successes, n));
    db.AddRow({cell.first->hand, cell.first->object, cell.first->grasp, cell.num_planned, n,
               cell.num_successes, rate, interval.low, interval.high});
  }
}

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
  Database index;
  AddTrialTable(columns, index);
  trials.Write(FormatCsvHeading(columns));
  events.Write(FormatCsvHeading(event_columns));
  ForEachWhole(session, [&](const TrialRecord& record) {
    const std::vector<Json> cells = MakeCsvCells(columns, record);
    trials.Write(FormatCsvLine(cells));
    index.AddRow(cells);
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
  AddCells(session, index);
  index.Write(folder / "index.sqlite");
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
