#pragma once
/** @file
Tables. A table is described once, by its columns. This list produces the CSV, its data dictionary,
a JSON array and the table that people see in a terminal or on a page, so that these cannot diverge.
The analysis that produces the rows defines the columns. */

#include <algorithm>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/text/json.h"

namespace graspbench {

namespace internal {

template <class T>
constexpr const char* ColumnTypeOf() {
  if (std::is_same_v<T, bool>) return "boolean";
  if (std::is_integral_v<T>) return "integer";
  return std::is_floating_point_v<T> ? "number" : "string";
}

template <class T>
Json MakeCsvValue(const T& value) {
  static_assert(!std::is_same_v<T, Json>, "a value as Json needs its type named");
  if constexpr (std::is_same_v<T, bool>) {
    return value ? 1 : 0;
  } else if constexpr (std::is_same_v<T, double>) {
    return JsonNumber(value);
  } else {
    return value;
  }
}

}  // namespace internal

template <class Row>
struct CsvColumn {
  using Show = std::function<std::string(const Row&)>;

  CsvColumn(std::string its_name, std::string its_type, std::string its_unit, std::string about,
            std::function<Json(const Row&)> take)
      : name(std::move(its_name)),
        type(std::move(its_type)),
        unit(std::move(its_unit)),
        meaning(std::move(about)),
        value(std::move(take)) {}
  /** @param take  a member of Row or a function of it; its result type sets the column's type.
  Non-finite numbers count as missing. */
  template <class Take>
  CsvColumn(std::string its_name, std::string its_unit, std::string about, Take take)
      : CsvColumn(std::move(its_name),
                  internal::ColumnTypeOf<std::decay_t<std::invoke_result_t<Take, const Row&>>>(),
                  std::move(its_unit), std::move(about), [take](const Row& row) {
                    return internal::MakeCsvValue(std::invoke(take, row));
                  }) {}

  /** Returns a copy of the column that is also part of tables for people.
  @param shown_as  formats a cell; if empty, as in the file. */
  CsvColumn Shown(std::string its_heading, Show shown_as = {}) const {
    CsvColumn shown = *this;
    shown.heading = std::move(its_heading);
    shown.show = std::move(shown_as);
    return shown;
  }
  /** Makes a column for people only, which summarises several columns of the file. */
  static CsvColumn ForPeople(std::string its_heading, std::string about, Show shown_as) {
    return CsvColumn("", "", "", std::move(about), {}).Shown(its_heading, std::move(shown_as));
  }

  std::string name;                       ///< with the unit as suffix: "gct_s"; empty: not in files
  std::string type;                       ///< "string", "integer", "number" or "boolean"
  std::string unit;                       ///< "s", "m", ...; empty: none
  std::string meaning;                    ///< one sentence
  std::function<Json(const Row&)> value;  ///< null: missing; booleans are 0 or 1
  std::string heading;                    ///< for people; empty: in files only
  Show show;                              ///< empty: FormatShownCell
};

/** Formats a cell: empty for null, numbers in their shortest exact form, text guarded (GuardCell)
and, where necessary, quoted as in RFC 4180. */
std::string FormatCsvCell(const Json& value);
/** Formats a cell for people: text is neither quoted nor guarded. */
std::string FormatShownCell(const Json& value);

/** Protects a cell against formula injection. Spreadsheets execute text that begins with = + - @,
their full-width forms or a control character. In some locales they split cells at semicolons or
tabs, even inside our quotes. So an apostrophe is put before such a character at the beginning of
the text or after a semicolon, tab or line break, unless the whole text is a number. Where
apostrophes already precede such a character, one more is added, so that UnguardCell restores every
text. */
std::string GuardCell(const std::string& text);
std::string UnguardCell(const std::string& cell);

/** Formats one line of a table: the cells, separated by commas, and a line feed. */
std::string FormatCsvLine(const std::vector<Json>& cells);

/** The parts of a table that is written incrementally. */
template <class Row>
std::string FormatCsvHeading(const std::vector<CsvColumn<Row>>& columns) {
  std::vector<Json> cells;
  for (const CsvColumn<Row>& column : columns) {
    if (!column.name.empty()) cells.push_back(column.name);
  }
  return FormatCsvLine(cells);
}
template <class Row>
std::vector<Json> MakeCsvCells(const std::vector<CsvColumn<Row>>& columns, const Row& row) {
  std::vector<Json> cells;
  for (const CsvColumn<Row>& column : columns) {
    if (!column.name.empty()) cells.push_back(column.value(row));
  }
  return cells;
}
template <class Row>
std::string FormatCsvLines(const std::vector<CsvColumn<Row>>& columns,
                           const std::vector<Row>& rows) {
  std::string lines;
  for (const Row& row : rows) lines += FormatCsvLine(MakeCsvCells(columns, row));
  return lines;
}
/** Formats a table as RFC 4180 with line feeds: a heading and one line per row. All tables are
written by this function or its parts above. */
template <class Row>
std::string FormatCsv(const std::vector<CsvColumn<Row>>& columns, const std::vector<Row>& rows) {
  return FormatCsvHeading(columns) + FormatCsvLines(columns, rows);
}

/** Returns the data dictionary as a Frictionless Table Schema, plus each column's unit.
@param primary_key  name of a column, or empty. */
template <class Row>
Json MakeTableSchema(const std::vector<CsvColumn<Row>>& columns, const std::string& primary_key) {
  Json fields = Json::array();
  for (const CsvColumn<Row>& column : columns) {
    if (column.name.empty()) continue;
    Json field = {{"name", column.name}, {"type", column.type}, {"description", column.meaning}};
    if (!column.unit.empty()) field["unit"] = column.unit;
    if (column.type == "boolean") {
      field["trueValues"] = {"1"};
      field["falseValues"] = {"0"};
    }
    fields.push_back(field);
  }
  Json schema = {{"fields", fields}};
  if (!primary_key.empty()) schema["primaryKey"] = primary_key;
  schema["missingValues"] = {""};
  return schema;
}

/** Returns a list with one object per row. */
template <class Row>
Json MakeJsonRows(const std::vector<CsvColumn<Row>>& columns, const std::vector<Row>& rows) {
  Json list = Json::array();
  for (const Row& row : rows) {
    Json object = Json::object();
    for (const CsvColumn<Row>& column : columns) {
      if (!column.name.empty()) object[column.name] = column.value(row);
    }
    list.push_back(object);
  }
  return list;
}

/** A table as it is shown in a terminal or on a page. */
struct ShownTable {
  struct Column {
    std::string heading;
    std::string hint;  ///< the column's meaning
    std::vector<std::string> cells;
  };
  std::vector<Column> columns;
  size_t num_rows = 0;
};

/** Returns the columns that have a heading, except those without any non-empty cell.
@param headings  the columns to show, in the order of `columns`; empty: all. */
template <class Row>
ShownTable ShowTable(const std::vector<CsvColumn<Row>>& columns, const std::vector<Row>& rows,
                     const std::vector<std::string>& headings = {}) {
  ShownTable table;
  table.num_rows = rows.size();
  for (const CsvColumn<Row>& column : columns) {
    const bool is_named =
        std::find(headings.begin(), headings.end(), column.heading) != headings.end();
    if (column.heading.empty() || (!headings.empty() && !is_named)) continue;
    ShownTable::Column shown = {column.heading, column.meaning, {}};
    for (const Row& row : rows) {
      shown.cells.push_back(column.show ? column.show(row) : FormatShownCell(column.value(row)));
    }
    const bool is_filled = std::any_of(shown.cells.begin(), shown.cells.end(),
                                       [](const std::string& cell) { return !cell.empty(); });
    if (is_filled || rows.empty()) table.columns.push_back(std::move(shown));
  }
  return table;
}

}  // namespace graspbench
