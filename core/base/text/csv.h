#pragma once
/** @file
A table is described once, by its columns: one list makes the CSV, its data dictionary, a JSON array
and what people see in a terminal or on a page, so that these cannot drift apart. The analysis that
makes the rows lists the columns. */

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
  /** @param take  a member of Row, or a function of it: what it gives decides the type; a number
  that is not finite is missing. */
  template <class Take>
  CsvColumn(std::string its_name, std::string its_unit, std::string about, Take take)
      : CsvColumn(std::move(its_name),
                  internal::ColumnTypeOf<std::decay_t<std::invoke_result_t<Take, const Row&>>>(),
                  std::move(its_unit), std::move(about), [take](const Row& row) {
                    return internal::MakeCsvValue(std::invoke(take, row));
                  }) {}

  /** The column in tables for people, too. @param shown_as  a cell's text; else that of the file. */
  CsvColumn Shown(std::string its_heading, Show shown_as = {}) const {
    CsvColumn shown = *this;
    shown.heading = std::move(its_heading);
    shown.show = std::move(shown_as);
    return shown;
  }
  /** A column for people alone, which sums up several of the file. */
  static CsvColumn ForPeople(std::string its_heading, std::string about, Show shown_as) {
    return CsvColumn("", "", "", std::move(about), {}).Shown(its_heading, std::move(shown_as));
  }

  std::string name;                       ///< with the unit as suffix: "gct_s"; empty: in no file
  std::string type;                       ///< "string", "integer", "number" or "boolean"
  std::string unit;                       ///< "s", "m", ...; empty: none
  std::string meaning;                    ///< one sentence
  std::function<Json(const Row&)> value;  ///< null: missing; a boolean is 0 or 1
  std::string heading;                    ///< for people; empty: in files alone
  Show show;                              ///< empty: as FormatShownCell
};

/** Empty for null; numbers shortest-exact; text guarded, and quoted after RFC 4180 where it must
be. */
std::string FormatCsvCell(const Json& value);
/** The same for people: text as it is, neither quoted nor guarded. */
std::string FormatShownCell(const Json& value);

/** Spreadsheets run a text that begins with = + - @, their wide forms or a control character as a
formula. In some countries cells end at semicolons or tabs, inside of quotes of ours, too. So a
beginning of that kind, of the text or behind a semicolon, tab or line break, gets an apostrophe in
front, unless the whole text is a number. What has apostrophes there already gets one more, so that
UnguardCell gives every text back. */
std::string GuardCell(const std::string& text);
std::string UnguardCell(const std::string& cell);

/** One line of a table: the cells with commas between them, and a line feed. */
std::string FormatCsvLine(const std::vector<Json>& cells);

/** The parts of a table that is written piece by piece. */
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
/** RFC 4180 with line feeds: a heading and one line a row. The one writer of such tables. */
template <class Row>
std::string FormatCsv(const std::vector<CsvColumn<Row>>& columns, const std::vector<Row>& rows) {
  return FormatCsvHeading(columns) + FormatCsvLines(columns, rows);
}

/** The data dictionary in the form of a Frictionless Table Schema, plus each column's unit.
@param primary_key  a column, or empty. */
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

/** One object a row. */
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

/** What people see of a table, in a terminal or on a page. */
struct ShownTable {
  struct Column {
    std::string heading;
    std::string hint;  ///< the column's meaning
    std::vector<std::string> cells;
  };
  std::vector<Column> columns;
  size_t num_rows = 0;
};

/** The columns that have a heading; one that no row fills is left out.
@param headings  the columns to show, in the order of the list; empty: all. */
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
