#include "human_study/recording/importers/table_layouts.h"

#include <algorithm>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

constexpr size_t kSuffix = 2;  // of "_x"

/** A heading row that begins with `name`. */
Cells RequireRow(LineReader& reader, char delimiter, const std::string& name, std::string& line) {
  line = std::string(reader.Require("the heading row \"" + name + "\""));
  Cells cells;
  SplitCells(line, delimiter, cells);
  if (cells[0] != name) {
    reader.Fail("the heading row begins with \"" + std::string(cells[0].substr(0, 30)) +
                "\"; DeepLabCut writes \"" + name + "\" here (layout: deeplabcut)");
  }
  return cells;
}

std::vector<std::string> ReadDeepLabCut(LineReader& reader, char delimiter) {
  std::string scorer_line, line, part_line, coord_line;
  RequireRow(reader, delimiter, "scorer", scorer_line);
  line = std::string(reader.Require("the heading row \"bodyparts\""));
  Cells individuals, parts;
  SplitCells(line, delimiter, parts);
  const bool has_individuals = parts[0] == "individuals";
  if (has_individuals) {
    individuals = parts;
    parts = RequireRow(reader, delimiter, "bodyparts", part_line);
  } else if (parts[0] != "bodyparts") {
    reader.Fail("the second row begins with \"" + std::string(parts[0].substr(0, 30)) +
                "\"; DeepLabCut writes \"bodyparts\" there, or \"individuals\"");
  }
  const Cells coords = RequireRow(reader, delimiter, "coords", coord_line);
  if (parts.size() != coords.size() || (has_individuals && individuals.size() != coords.size())) {
    reader.Fail("its heading rows have " + std::to_string(parts.size()) + " and " +
                std::to_string(coords.size()) + " cells; expected as many in each");
  }
  std::vector<std::string> names = {""};  // the frame's number
  for (size_t i = 1; i < coords.size(); ++i) {
    const std::string owner = has_individuals ? std::string(individuals[i]) + ":" : "";
    names.push_back(owner + std::string(parts[i]) + "_" + std::string(coords[i]));
  }
  return names;
}

std::vector<std::string> ReadFreeMoCap(LineReader& reader, char delimiter) {
  const std::string line(reader.Require("the names of its columns"));
  Cells cells;
  SplitCells(line, delimiter, cells);
  return {cells.begin(), cells.end()};
}

}  // namespace

const std::vector<TableLayout>& TableLayoutList() {
  static const std::vector<TableLayout> layouts = {
      {"deeplabcut", "DeepLabCut 3-D", true, ReadDeepLabCut},
      {"freemocap", "FreeMoCap", false, ReadFreeMoCap},
  };
  return layouts;
}

const TableLayout* FindTableLayout(const std::string& id) {
  for (const TableLayout& layout : TableLayoutList()) {
    if (id == layout.id) return &layout;
  }
  return nullptr;
}

std::vector<std::string> FindLayoutPoints(const std::vector<std::string>& names,
                                          const LineReader& reader) {
  const auto has = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<std::string> points;
  bool is_flat = false;
  for (const std::string& name : names) {
    if (name.size() <= kSuffix || name.compare(name.size() - kSuffix, kSuffix, "_x") != 0) continue;
    const std::string point = name.substr(0, name.size() - kSuffix);
    if (!has(point + "_y")) continue;
    if (!has(point + "_z")) {
      is_flat = true;
      continue;
    }
    if (std::count(names.begin(), names.end(), name) > 1) {
      reader.Fail("the point \"" + point + "\" is there twice");
    }
    points.push_back(point);
  }
  if (points.empty()) {
    reader.Fail(is_flat ? "these are places in a picture (x and y, no z): triangulate them first, "
                          "and read the 3-D table"
                        : "no three columns NAME_x, NAME_y, NAME_z are there");
  }
  return points;
}

}  // namespace graspbench
