#include "datasets/session/session_index.h"

#include <sqlite3.h>

#include <memory>

#include "core/base/error.h"
#include "core/statistics/proportion.h"

namespace graspbench {
namespace {

/** A database in memory. What can fail here is a column's name: they hold the ids of digits. */
class Database {
 public:
  Database() { Check(sqlite3_open(":memory:", &db_)); }
  ~Database() { sqlite3_close(db_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void Run(const std::string& sql) {
    Check(sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr));
  }

  /** Creates a table and fills it row by row from `cell(row, column)`. */
  template <class Cell>
  void AddTable(const std::string& name, const std::vector<std::string>& column_names,
                const std::vector<std::string>& column_types, size_t num_rows, Cell&& cell) {
    std::string definition, places;
    for (size_t i = 0; i < column_names.size(); ++i) {
      definition += (i > 0 ? ", " : "") + Quote(column_names[i]) + " " + column_types[i];
      places += i > 0 ? ", ?" : "?";
    }
    Run("CREATE TABLE " + name + " (" + definition + ")");
    const std::string sql = "INSERT INTO " + name + " VALUES (" + places + ")";
    sqlite3_stmt* statement = nullptr;
    Check(sqlite3_prepare_v2(db_, sql.c_str(), -1, &statement, nullptr));
    const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> insert(statement,
                                                                       &sqlite3_finalize);
    for (size_t row = 0; row < num_rows; ++row) {
      for (size_t i = 0; i < column_names.size(); ++i) {
        Bind(insert.get(), static_cast<int>(i) + 1, cell(row, i));
      }
      Check(sqlite3_step(insert.get()));
      sqlite3_reset(insert.get());
    }
  }

  std::string Serialize() {
    sqlite3_int64 size = 0;
    unsigned char* bytes = sqlite3_serialize(db_, "main", &size, 0);
    GRASPBENCH_DEMAND(bytes, "serialize");
    std::string content(reinterpret_cast<const char*>(bytes), static_cast<size_t>(size));
    sqlite3_free(bytes);
    return content;
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
      const auto& text = value.get_ref<const std::string&>();
      sqlite3_bind_text(insert, place, text.data(), static_cast<int>(text.size()),
                        SQLITE_TRANSIENT);
    } else if (value.is_number_integer()) {
      sqlite3_bind_int64(insert, place, value.get<sqlite3_int64>());
    } else {
      sqlite3_bind_double(insert, place, value.get<double>());
    }
  }

  sqlite3* db_ = nullptr;
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

}  // namespace

std::string MakeSessionIndex(const Session& session, const std::vector<TrialColumn>& columns) {
  Database db;
  db.Run("BEGIN");
  std::vector<std::string> names, types;
  for (const TrialColumn& column : columns) {
    names.push_back(column.name);
    types.push_back(SqlTypeOf(column.type));
  }
  types.front() += " PRIMARY KEY";
  db.AddTable("trials", names, types, session.records.size(),
              [&](size_t row, size_t i) { return columns[i].value(session.records[row]); });

  const std::vector<CellCounts> cells = CountCells(session);
  db.AddTable("cells",
              {"hand", "object", "grasp", "planned", "finished", "successes", "success_rate",
               "wilson_low", "wilson_high"},
              {"TEXT", "TEXT", "TEXT", "INTEGER", "INTEGER", "INTEGER", "REAL", "REAL", "REAL"},
              cells.size(), [&](size_t row, size_t i) {
                const CellCounts& cell = cells[row];
                const int n = cell.num_finished;
                const Interval interval = CalcWilsonInterval(cell.num_successes, n);
                const Json rate = JsonNumber(CalcShare(cell.num_successes, n));
                return Json::array({cell.first->hand, cell.first->object, cell.first->grasp,
                                    cell.num_planned, n, cell.num_successes, rate, interval.low,
                                    interval.high})
                    .at(i);
              });
  db.Run("COMMIT");
  return db.Serialize();
}

}  // namespace graspbench
