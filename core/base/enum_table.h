#pragma once
/** @file
One table per enum, with one row per value: its name and any further attributes.

    enum class Shape { kBall, kBox };
    struct ShapeRow {
      Shape value;
      const char* name;  // as in files
    };
    inline constexpr ShapeRow kShapes[] = {{Shape::kBall, "ball"}, {Shape::kBox, "box"}};

A row may have more members: text for a person, a code, rules. The names are written nowhere else.
If there are no more members, NamedValue<Shape> is the row. */

#include <string>
#include <vector>

#include "core/base/error.h"

namespace graspbench {

template <class Enum>
struct NamedValue {
  Enum value;
  const char* name;  ///< as in files
};

/** @pre the table has a row of this value. */
template <class Row, size_t N, class Enum>
const Row& RowOf(const Row (&table)[N], Enum value) {
  for (const Row& row : table) {
    if (row.value == value) return row;
  }
  GRASPBENCH_DEMAND(false, "no row of value " + std::to_string(static_cast<int>(value)));
  return table[0];
}

template <class Row, size_t N>
std::vector<std::string> ListNames(const Row (&table)[N]) {
  std::vector<std::string> names;
  for (const Row& row : table) names.push_back(row.name);
  return names;
}

/** Returns null if no row has this name. */
template <class Row, size_t N>
const Row* FindRow(const Row (&table)[N], const std::string& name) {
  for (const Row& row : table) {
    if (name == row.name) return &row;
  }
  return nullptr;
}

/** @param what  noun for the message, for example "outcome".
@throws Error(kFormat) with suggestions if no row has this name. */
template <class Row, size_t N>
const Row& RowFromName(const Row (&table)[N], const std::string& name, const char* what) {
  if (const Row* row = FindRow(table, name)) return *row;
  throw Error(ErrorKind::kFormat, std::string("no ") + what + " \"" + name + "\"" +
                                      SuggestNames(name, ListNames(table)));
}

}  // namespace graspbench
