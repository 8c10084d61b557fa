#include "datasets/session/session_index.h"

#include <sqlite3.h>

#include <string_view>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/statistics/proportion.h"

namespace graspbench {

/** A database in memory. What can fail here is a column's name: they hold the ids of digits. */
class SessionIndex::Database {
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

namespace {

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

}  // namespace

SessionIndex::SessionIndex(const std::vector<TrialColumn>& columns)
    : db_(std::make_unique<Database>()) {
  std::vector<std::string> names, types;
  for (const TrialColumn& column : columns) {
    names.push_back(column.name);
    types.push_back(SqlTypeOf(column.type));
  }
  types.front() += " PRIMARY KEY";
  db_->AddTable("trials", names, types);
}

SessionIndex::~SessionIndex() = default;

void SessionIndex::AddTrial(const std::vector<Json>& cells) { db_->AddRow(cells); }

void SessionIndex::Write(const Session& session, const std::filesystem::path& path) {
  db_->AddTable("cells",
                {"hand", "object", "grasp", "planned", "finished", "successes", "success_rate",
                 "wilson_low", "wilson_high"},
                {"TEXT", "TEXT", "TEXT", "INTEGER", "INTEGER", "INTEGER", "REAL", "REAL", "REAL"});
  for (const CellCounts& cell : CountCells(session)) {
    const int n = cell.num_finished;
    const Interval interval = CalcWilsonInterval(cell.num_successes, n);
    const Json rate = JsonNumber(CalcShare(cell.num_successes, n));
    db_->AddRow({cell.first->hand, cell.first->object, cell.first->grasp, cell.num_planned, n,
                 cell.num_successes, rate, interval.low, interval.high});
  }
  db_->Write(path);
}

}  // namespace graspbench
