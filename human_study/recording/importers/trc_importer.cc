/** @file
TRC (Motion Analysis, OpenSim), with tabs or commas: a line with a path, names and values of the
header, a row of labels over three columns each, a row X1 Y1 Z1 .., and one row a frame. */

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/whole_number.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/importers/text_rows.h"

namespace graspbench {
namespace {

/** Value under a name of the header's second line; empty when absent. */
std::string_view FindValue(const Cells& names, const Cells& values, std::string_view name) {
  for (size_t i = 0; i < std::min(names.size(), values.size()); ++i) {
    if (ToLower(names[i]) == name) return values[i];
  }
  return {};
}

/** Labels stand over X, with two empty cells after each. */
void ReadLabels(LineReader& reader, char delimiter, size_t num_points, const std::string& unit,
                Recording& recording) {
  Cells cells;
  SplitCells(reader.Require("the row of labels"), delimiter, cells);
  recording.points.resize(num_points);
  for (size_t i = 0; i < num_points && 2 + 3 * i < cells.size(); ++i) {
    recording.points[i].label = std::string(cells[2 + 3 * i]);
  }
  DropEmptyEnd(cells);
  if (cells.size() > 2 + 3 * num_points) {
    recording.Note("extra_labels", "line 4",
                   "more labels than the " + std::to_string(num_points) +
                       " markers of NumMarkers; the first ones are taken");
  }
  SetLengthUnit(recording, unit, "Units");
  MakeLabelsUnique(recording, "line 4");
}

Recording ImportTrc(const ImportSource& source, const ImportOptions& options) {
  Recording recording;
  LineReader reader(source.stream, source.name);
  const std::string first(reader.Require("its header"));
  const char delimiter = first.find('\t') != std::string::npos ? '\t' : ',';
  const std::string name_line(reader.Require("the names of its header"));
  Cells names;
  SplitCells(name_line, delimiter, names);
  const std::string value_line(reader.Require("the values of its header"));
  Cells values;
  SplitCells(value_line, delimiter, values);
  recording.rate =
      ParseHeaderNumber(FindValue(names, values, "datarate"), "DataRate", 1e-6, 1e6, reader);
  const double num_frames = ParseHeaderNumber(FindValue(names, values, "numframes"), "NumFrames", 0,
                                              2147483647.0, reader);
  const double num_markers =
      ParseHeaderNumber(FindValue(names, values, "nummarkers"), "NumMarkers", 1, 65535, reader);
  std::string unit(FindValue(names, values, "units"));
  if (unit.empty()) unit = options.unit;

  const auto num_points = ToWhole<size_t>(num_markers);
  ReadLabels(reader, delimiter, num_points, unit, recording);
  reader.Require("the row X1 Y1 Z1");

  std::vector<size_t> columns;
  for (size_t i = 0; i < num_points; ++i) columns.push_back(2 + 3 * i);
  FrameRows rows = ReadFrameRows(reader, delimiter, columns, options, recording);
  NoteFrameCount(num_frames, "NumFrames", recording);
  SettleTimes(std::move(rows.times), rows.first_line, source.name, recording);
  return recording;
}

/** The first line holds the path of the file on the machine that wrote it. */
std::vector<PersonalField> RedactTrc(std::string& bytes, const std::string&) {
  const std::string line = FindLine(bytes, 1);
  const char delimiter = line.find('\t') != std::string::npos ? '\t' : ',';
  Cells cells;
  SplitCells(line, delimiter, cells);
  if (cells.size() < 4 || cells[3].empty()) return {};
  const std::string path(cells[3]);
  std::string redacted = line;
  redacted.replace(static_cast<size_t>(cells[3].data() - line.data()), path.size(), "redacted.trc");
  ReplaceLine(bytes, 1, redacted);
  return {{"line 1", path}};
}

}  // namespace

Importer MakeTrcImporter() {
  return {"trc",     "TRC",
          {".trc"},  [](std::string_view head) { return StartsWith(head, "PathFileType"); },
          ImportTrc, RedactTrc};
}

}  // namespace graspbench
