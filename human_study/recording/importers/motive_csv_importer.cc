/** @file
OptiTrack Motive's CSV export, raw and cleaned.

Raw: a line of key-value pairs (rates, length unit), rows Type, Name, ID and Position/Rotation, the
row "Frame, Time (Seconds), X, Y, Z, ..", one row a frame. Blank cells are hidden markers. Columns
of rotations and errors are left out. Motive 1.5 to 1.7 (format version 1.1) write the same rows in
the same order without their titles, "Time" without its unit, and no unit of length. Cleaned: one
row of names "<marker>_position_x", .. after frame and time; it states neither rate nor unit. Where
no unit is stated, metres, Motive's own unit, are taken. */

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/importers/text_rows.h"

namespace graspbench {
namespace {

struct PointColumn {
  std::string label;
  size_t column;  ///< of X; Y and Z follow
};

void ReadRows(LineReader& reader, const std::vector<PointColumn>& points,
              const ImportOptions& options, Recording& recording) {
  std::vector<size_t> columns;
  for (const PointColumn& point : points) columns.push_back(point.column);
  FrameRows rows = ReadFrameRows(reader, ',', columns, options, recording);
  SettleTimes(std::move(rows.times), rows.first_line, reader.file(), recording);
}

void MakePoints(const std::vector<PointColumn>& columns, const std::string& unit,
                const std::string& where, const LineReader& reader, Recording& recording) {
  if (columns.empty()) reader.Fail("no columns X, Y, Z of any marker were found");
  for (const PointColumn& c : columns) {
    recording.points.emplace_back();
    recording.points.back().label = c.label;
  }
  SetLengthUnit(recording, unit, where);
  MakeLabelsUnique(recording, where);
  const auto num_unlabelled =
      std::count_if(columns.begin(), columns.end(),
                    [](const PointColumn& c) { return StartsWith(c.label, "Unlabeled"); });
  if (num_unlabelled > 0) {
    recording.Note("unlabelled_markers", where,
                   std::to_string(num_unlabelled) +
                       " unlabelled markers; Motive gives a marker a new identity after each gap, "
                       "so one marker may be several points");
  }
}

void NoteConventionalUnit(Recording& recording) {
  recording.Note("unit_by_convention", "file",
                 "no unit is stated; metres, Motive's own unit, are taken (--unit changes it)");
}

Recording ImportRaw(LineReader& reader, const Cells& pairs, const ImportOptions& options) {
  Recording recording;
  std::string unit = options.unit;
  double capture_rate = std::nan(""), export_rate = std::nan("");
  for (size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const std::string key = ToLower(pairs[i]);
    if (key == "length units") unit = std::string(pairs[i + 1]);
    if (key == "capture frame rate") {
      capture_rate = ParseHeaderNumber(pairs[i + 1], "Capture Frame Rate", 1e-6, 1e6, reader);
    }
    if (key == "export frame rate") {
      export_rate = ParseHeaderNumber(pairs[i + 1], "Export Frame Rate", 1e-6, 1e6, reader);
    }
  }
  recording.rate = std::isfinite(export_rate) ? export_rate : capture_rate;
  std::vector<std::string> names, kinds;
  std::vector<std::vector<std::string>> untitled;  // of format version 1.1: types, names, ids
  Cells cells;
  do {
    SplitCells(reader.Require("the row \"Frame, Time (Seconds), ..\""), ',', cells);
    const std::string title = ToLower(cells.size() > 1 ? cells[1] : "");
    const auto keep = [&](std::vector<std::string>& row) {
      row.assign(cells.begin(), cells.end());
    };
    if (title == "name") keep(names);
    // The row of kinds has no title.
    if (cells.size() > 2 && (cells[2] == "Position" || cells[2] == "Rotation")) {
      keep(kinds);
    } else if (cells.size() > 2 && title.empty() && !IsBlank(cells)) {
      keep(untitled.emplace_back());
    }
  } while (ToLower(cells[0]) != "frame");
  const bool has_titles = !names.empty() || untitled.size() < 2;
  if (!has_titles) names = untitled[1];
  const bool is_unit_conventional = !has_titles && unit.empty();
  if (is_unit_conventional) unit = "m";
  if (names.empty()) reader.Fail("no row \"Name\" stands above the row \"Frame, ..\"");
  std::vector<PointColumn> columns;
  for (size_t c = 2; c + 2 < cells.size() && c < names.size(); ++c) {
    const bool is_triple = cells[c] == "X" && cells[c + 1] == "Y" && cells[c + 2] == "Z";
    if (is_triple && c < kinds.size() && kinds[c] == "Position") columns.push_back({names[c], c});
  }
  MakePoints(columns, unit, "row Name", reader, recording);
  if (is_unit_conventional) NoteConventionalUnit(recording);
  ReadRows(reader, columns, options, recording);
  return recording;
}

Recording ImportCleaned(LineReader& reader, const Cells& names, const ImportOptions& options) {
  Recording recording;
  std::vector<PointColumn> columns;
  const std::string end = "_position_x";
  for (size_t c = 2; c + 2 < names.size(); ++c) {
    const std::string_view name = names[c];
    if (name.size() <= end.size() || name.substr(name.size() - end.size()) != end) continue;
    columns.push_back({std::string(name.substr(0, name.size() - end.size())), c});
  }
  MakePoints(columns, options.unit.empty() ? "m" : options.unit, "line 1", reader, recording);
  if (options.unit.empty()) NoteConventionalUnit(recording);
  ReadRows(reader, columns, options, recording);
  return recording;
}

Recording ImportMotiveCsv(const ImportSource& source, const ImportOptions& options) {
  LineReader reader(source.stream, source.name);
  const std::string first(reader.Require("its header"));
  Cells cells;
  SplitCells(first, ',', cells);
  return cells[0] == "Format Version" ? ImportRaw(reader, cells, options)
                                      : ImportCleaned(reader, cells, options);
}

std::vector<PersonalField> RedactMotiveCsv(std::string& bytes, const std::string&) {
  const std::string line = FindLine(bytes, 1);
  Cells cells;
  SplitCells(line, ',', cells);
  std::vector<PersonalField> fields;
  std::string redacted;
  for (size_t i = 0; i < cells.size(); ++i) {
    const std::string key = i % 2 == 1 ? ToLower(cells[i - 1]) : "";
    const bool is_personal =
        key == "take name" || key == "take notes" || key == "capture start time";
    if (is_personal && !cells[i].empty()) {
      fields.push_back({std::string(cells[i - 1]), std::string(cells[i])});
    }
    redacted += (i > 0 ? "," : "") + (is_personal ? "" : std::string(cells[i]));
  }
  if (!fields.empty()) ReplaceLine(bytes, 1, redacted);
  return fields;
}

bool RecognisesMotive(std::string_view head) {
  if (StartsWith(head, "\xef\xbb\xbf")) head.remove_prefix(3);
  if (StartsWith(head, "Format Version,")) return true;
  const std::string_view line = head.substr(0, head.find('\n'));
  return StartsWith(ToLower(line), "frame,time") &&
         line.find("_position_x") != std::string_view::npos;
}

}  // namespace

Importer MakeMotiveCsvImporter() {
  return {"motive_csv",     "OptiTrack Motive CSV", {},
          RecognisesMotive, ImportMotiveCsv,        RedactMotiveCsv};
}

}  // namespace graspbench
