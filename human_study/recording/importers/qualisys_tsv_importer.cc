/** @file
Qualisys Track Manager's TSV export of 3-D trajectories: key-value lines, then one row a frame, with
or without the columns Frame and Time and their heading. Lengths are millimetres by QTM's
convention; the file does not state it, so a unit that a person states counts. A missing sample is
empty, "nan" or 0 0 0. */

#include <cmath>
#include <map>

#include "core/base/text/text.h"
#include "core/base/whole_number.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/importers/text_rows.h"

namespace graspbench {
namespace {

struct QualisysHeader {
  double num_frames = std::nan("");
  double num_markers = std::nan("");
  std::vector<std::string> labels;
  std::vector<std::string> types;
};

bool IsKey(std::string_view cell) {
  if (cell.empty()) return false;
  for (const char c : cell) {
    if (!((c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9'))) return false;
  }
  return cell[0] >= 'A';
}

/** Reads one key-value line; false for the first line that is none. */
bool ReadKeyLine(const Cells& cells, const LineReader& reader, QualisysHeader& header,
                 Recording& recording) {
  if (!IsKey(cells[0])) return false;
  const std::string key(cells[0]);
  const std::string_view value = cells.size() > 1 ? cells[1] : "";
  if (key == "NO_OF_FRAMES") {
    header.num_frames = ParseHeaderNumber(value, key, 0, 2147483647.0, reader);
  } else if (key == "NO_OF_MARKERS") {
    header.num_markers = ParseHeaderNumber(value, key, 0, 65535, reader);
  } else if (key == "FREQUENCY") {
    recording.rate = ParseHeaderNumber(value, key, 1e-6, 1e6, reader);
  } else if (key == "DATA_INCLUDED" && value != "3D") {
    reader.Fail("DATA_INCLUDED is " + std::string(value.substr(0, 20)) +
                "; only position exports (3D) can be read");
  } else if (key == "MARKER_NAMES" || key == "TRAJECTORY_TYPES") {
    std::vector<std::string>& list = key == "MARKER_NAMES" ? header.labels : header.types;
    list.assign(cells.begin() + 1, cells.end());
    while (!list.empty() && list.back().empty()) list.pop_back();
  } else if (key == "EVENT" && cells.size() >= 4) {
    recording.events.push_back(
        {std::string(value), "",
         ParseHeaderNumber(cells[3], "the time of an event", -1e9, 1e9, reader),
         EventSource::kEventGroup});
  }
  return true;
}

/** Names of all markers; empty ones when the header only counts them. */
std::vector<std::string> FindLabels(const QualisysHeader& header, const LineReader& reader,
                                    Recording& recording) {
  std::vector<std::string> labels = header.labels;
  if (labels.empty() && header.num_markers > 0) {
    labels.resize(ToWhole<size_t>(header.num_markers));
  }
  if (labels.empty()) reader.Fail("neither MARKER_NAMES nor NO_OF_MARKERS name any marker");
  if (static_cast<double>(labels.size()) != header.num_markers) {
    recording.Note("point_count_disputed", "NO_OF_MARKERS",
                   "does not agree with the " + std::to_string(labels.size()) +
                       " names of MARKER_NAMES, which are taken");
  }
  return labels;
}

void MakePoints(const std::vector<std::string>& labels, const QualisysHeader& header,
                const std::string& unit, Recording& recording) {
  for (const std::string& label : labels) {
    recording.points.emplace_back();
    recording.points.back().label = label;
  }
  SetLengthUnit(recording, unit.empty() ? "mm" : unit, "file");
  if (unit.empty()) {
    recording.Note("unit_by_convention", "file",
                   "Qualisys exports millimetres and does not say so; millimetres are taken "
                   "(--unit changes it, recording.unit in a study)");
  }
  MakeLabelsUnique(recording, "MARKER_NAMES");
  for (size_t i = 0; i < std::min(header.types.size(), recording.points.size()); ++i) {
    if (header.types[i] == "Mixed") {
      recording.Note("mixed_trajectory", "TRAJECTORY_TYPES",
                     "\"" + recording.points[i].label +
                         "\" holds filled samples among the measured ones, and the file does not "
                         "say which; all are taken as measured");
    }
  }
}

/** Columns before the first marker: Frame and Time, or none. */
size_t FindFirstColumn(const Cells& cells, size_t num_points, const LineReader& reader) {
  if (cells.size() < 3 * num_points) {
    reader.Fail("the first row of data has " + std::to_string(cells.size()) +
                " columns, expected " + std::to_string(3 * num_points) + " or more");
  }
  size_t extra = cells.size() - 3 * num_points;
  if (extra % 2 == 1 && cells.back().empty()) --extra;  // a tab at the end of the row
  if (extra != 0 && extra != 2) {
    reader.Fail("the row has " + std::to_string(cells.size()) + " columns, expected " +
                std::to_string(3 * num_points) + " or, with frame and time, " +
                std::to_string(3 * num_points + 2));
  }
  return extra;
}

Recording ImportQualisysTsv(const ImportSource& source, const ImportOptions& options) {
  Recording recording;
  QualisysHeader header;
  LineReader reader(source.stream, source.name);
  Cells cells;
  std::string_view line = reader.Require("its header");
  SplitCells(line, '\t', cells);
  while (ReadKeyLine(cells, reader, header, recording)) {
    SplitCells(reader.Require("the first row of data"), '\t', cells);
  }
  const std::vector<std::string> labels = FindLabels(header, reader, recording);
  if (ToLower(cells[0]) == "frame") {
    SplitCells(reader.Require("the first row of data"), '\t', cells);
  }
  const size_t num_points = labels.size();
  const size_t first_column = FindFirstColumn(cells, num_points, reader);
  MakePoints(labels, header, options.unit, recording);
  const bool has_times = first_column == 2;
  const int first_line = reader.line();
  std::vector<double> times;
  OddSamples odd;
  if (has_times) {
    recording.first_frame =
        ToWhole<int>(ParseHeaderNumber(cells[0], "the first frame's number", -1e9, 1e9, reader));
  }
  do {
    if (IsBlank(cells)) break;
    if (!HasAllColumns(cells, first_column + 3 * num_points, reader, options, recording)) break;
    if (has_times) times.push_back(ParseNumber(cells, 1, reader));
    for (size_t i = 0; i < num_points; ++i) {
      AppendTriple(cells, first_column + 3 * i, reader, recording.points[i], odd);
    }
    ++recording.num_frames;
    if (!reader.Next(line)) break;
    SplitCells(line, '\t', cells);
  } while (true);
  NoteOdd(odd, recording);
  NoteFrameCount(header.num_frames, "NO_OF_FRAMES", recording);
  SettleTimes(std::move(times), first_line, source.name, recording);
  return recording;
}

std::vector<PersonalField> RedactQualisysTsv(std::string& bytes, const std::string&) {
  std::vector<PersonalField> fields;
  for (int line = 1; line <= 40; ++line) {
    const std::string text = FindLine(bytes, line);
    for (const std::string key : {"TIME_STAMP", "DESCRIPTION"}) {
      if (!StartsWith(text, key + "\t") || text.size() <= key.size() + 1) continue;
      fields.push_back({key, text.substr(key.size() + 1)});
      ReplaceLine(bytes, line, key + "\t--");
    }
  }
  return fields;
}

}  // namespace

Importer MakeQualisysTsvImporter() {
  return {"qualisys_tsv",
          "Qualisys TSV",
          {},
          [](std::string_view head) { return StartsWith(head, "NO_OF_FRAMES\t"); },
          ImportQualisysTsv,
          RedactQualisysTsv};
}

}  // namespace graspbench
