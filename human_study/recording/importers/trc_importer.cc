/** @file
TRC (Motion Analysis, OpenSim), with tabs, commas or blanks: a line with a path, names and values of
the header, a row of labels over three columns each, a row X1 Y1 Z1 .., and one row a frame.
OpenSim's documentation ("Marker (.trc) Files") asks for tabs and allows any white space between the
numbers; blanks come from editors and scripts that replaced the tabs, one by one or in runs. */

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

/** Tabs before commas before blanks: a path may hold any of the others. */
char FindTrcDelimiter(std::string_view line) {
  for (const char delimiter : {'\t', ','}) {
    if (line.find(delimiter) != std::string_view::npos) return delimiter;
  }
  return kBlanks;
}

/** Labels stand over X, with two empty cells after each; in runs of blanks one after the other. */
void ReadLabels(LineReader& reader, char delimiter, size_t num_points, const std::string& unit,
                Recording& recording) {
  Cells cells;
  SplitRow(reader.Require("the row of labels"), delimiter, 0, cells);
  const size_t step = delimiter == kBlanks ? 1 : 3;
  if (delimiter == kBlanks && cells.size() != 2 + num_points) {
    reader.Fail("the row has " + std::to_string(cells.size()) +
                " words, expected Frame#, Time and " + std::to_string(num_points) +
                " labels; in a file with blanks for tabs a label must have none");
  }
  recording.points.resize(num_points);
  for (size_t i = 0; i < num_points && 2 + step * i < cells.size(); ++i) {
    recording.points[i].label = std::string(cells[2 + step * i]);
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
  reader.Require("its header");
  const std::string name_line(reader.Require("the names of its header"));
  const char delimiter = FindTrcDelimiter(name_line);
  Cells names;
  SplitRow(name_line, delimiter, 0, names);
  const std::string value_line(reader.Require("the values of its header"));
  Cells values;
  SplitRow(value_line, delimiter, 0, values);
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

/** The first line holds the path of the file on the machine that wrote it, as its fourth cell. */
std::vector<PersonalField> RedactTrc(std::string& bytes, const std::string&) {
  const std::string line = FindLine(bytes, 1);
  const char delimiter = FindTrcDelimiter(line);
  Cells cells;
  SplitRow(line, delimiter, 0, cells);
  if (cells.size() < 4 || cells[3].empty()) return {};
  const auto start = static_cast<size_t>(cells[3].data() - line.data());
  const size_t length = delimiter == kBlanks ? line.size() - start : cells[3].size();
  const std::string path = line.substr(start, length);
  std::string redacted = line;
  redacted.replace(start, length, "redacted.trc");
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
