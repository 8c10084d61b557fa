/** @file
Vicon Nexus's ASCII export: blocks divided by empty lines. A block has its title, its rate, a row of
labels, a row "Frame, Sub Frame, X, Y, Z, ..", a row of units and one row a frame (Trajectories) or
sub-frame (Devices). Events have columns of their own. Other blocks (Joints, Model Outputs, ..) are
skipped and noted. */

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/whole_number.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/importers/text_rows.h"

namespace graspbench {
namespace {

struct Block {
  double rate = 0.0;
  Cells labels, columns, units;  // views into the lines below
  std::string label_line, column_line, unit_line;
};

void ReadBlockHead(LineReader& reader, char delimiter, const std::string& title, Block& block) {
  Cells cells;
  SplitCells(reader.Require("the rate of block " + title), delimiter, cells);
  block.rate = ParseHeaderNumber(cells[0], "the rate of block " + title, 1e-6, 1e6, reader);
  block.label_line = reader.Require("the labels of block " + title);
  SplitCells(block.label_line, delimiter, block.labels);
  block.column_line = reader.Require("the columns of block " + title);
  SplitCells(block.column_line, delimiter, block.columns);
  DropEmptyEnd(block.columns);
  if (block.columns.size() < 2 || ToLower(block.columns[0]) != "frame") {
    reader.Fail("expected the row \"Frame, Sub Frame, ..\" of block " + title);
  }
  block.unit_line = reader.Require("the units of block " + title);
  SplitCells(block.unit_line, delimiter, block.units);
}

std::string CellOr(const Cells& cells, size_t i, std::string_view otherwise) {
  return std::string(i < cells.size() && !cells[i].empty() ? cells[i] : otherwise);
}

/** Splits the next row; false at the block's end. */
bool NextRow(LineReader& reader, char delimiter, Cells& cells) {
  std::string_view line;
  if (!reader.Next(line)) return false;
  SplitCells(line, delimiter, cells);
  return !IsBlank(cells);
}

void ReadTrajectories(LineReader& reader, char delimiter, const ImportOptions& options,
                      Recording& recording) {
  Block block;
  ReadBlockHead(reader, delimiter, "Trajectories", block);
  if (!recording.points.empty()) reader.Fail("a second block of Trajectories");
  recording.rate = block.rate;
  const size_t num_points = (block.columns.size() - 2) / 3;
  recording.points.resize(num_points);
  for (size_t i = 0; i < num_points; ++i) {
    recording.points[i].label = CellOr(block.labels, 2 + 3 * i, "");
  }
  SetLengthUnit(recording, CellOr(block.units, 2, options.unit), "units of Trajectories");
  MakeLabelsUnique(recording, "labels of Trajectories");
  Cells cells;
  OddSamples odd;
  while (NextRow(reader, delimiter, cells)) {
    if (!HasAllColumns(cells, 2 + 3 * num_points, reader, options, recording)) break;
    const double frame = ParseHeaderNumber(cells[0], "the frame's number", -1e9, 1e9, reader);
    if (recording.num_frames == 0) recording.first_frame = ToWhole<int>(frame);
    if (frame != recording.first_frame + static_cast<double>(recording.num_frames)) {
      reader.Fail(
          "frame " + std::string(cells[0]) + " follows frame " +
          std::to_string(recording.first_frame + static_cast<int64_t>(recording.num_frames) - 1) +
          "; frames must be consecutive");
    }
    for (size_t i = 0; i < num_points; ++i) {
      AppendTriple(cells, 2 + 3 * i, reader, recording.points[i], odd);
    }
    ++recording.num_frames;
  }
  NoteOdd(odd, recording);
  recording.start_time = (recording.first_frame - 1) / recording.rate;
}

void ReadDevices(LineReader& reader, char delimiter, const ImportOptions& options,
                 Recording& recording) {
  Block block;
  ReadBlockHead(reader, delimiter, "Devices", block);
  const size_t first_channel = recording.analog.size();
  std::string device;
  for (size_t c = 2; c < block.columns.size(); ++c) {
    device = CellOr(block.labels, c, device);
    AnalogChannel channel;
    channel.label = (device.empty() ? "" : device + " ") + std::string(block.columns[c]);
    channel.unit = CellOr(block.units, c, "");
    channel.rate = block.rate;
    recording.analog.push_back(std::move(channel));
  }
  Cells cells;
  while (NextRow(reader, delimiter, cells)) {
    if (!HasAllColumns(cells, block.columns.size(), reader, options, recording)) break;
    for (size_t c = 2; c < block.columns.size(); ++c) {
      recording.analog[first_channel + c - 2].samples.push_back(
          static_cast<float>(ParseNumber(cells, c, reader)));
    }
  }
}

/** Its columns are Subject, Context, Name, Time (s), Description. */
void ReadEvents(LineReader& reader, char delimiter, const ImportOptions& options,
                Recording& recording) {
  reader.Require("the rate of block Events");
  reader.Require("the columns of block Events");
  Cells cells;
  while (NextRow(reader, delimiter, cells)) {
    if (!HasAllColumns(cells, 4, reader, options, recording)) break;
    recording.events.push_back(
        {std::string(cells[2]), std::string(cells[1]),
         ParseHeaderNumber(cells[3], "the time of an event", -1e9, 1e9, reader),
         EventSource::kEventGroup});
  }
}

Recording ImportNexusCsv(const ImportSource& source, const ImportOptions& options) {
  Recording recording;
  LineReader reader(source.stream, source.name);
  Cells cells;
  std::string_view line;
  const std::string first(reader.Require("its first block"));
  const char delimiter = first.find('\t') != std::string::npos ? '\t' : ',';
  SplitCells(first, delimiter, cells);
  do {
    const std::string title(cells[0]);
    if (IsBlank(cells)) continue;
    if (title == "Trajectories") {
      ReadTrajectories(reader, delimiter, options, recording);
    } else if (title == "Devices") {
      ReadDevices(reader, delimiter, options, recording);
    } else if (title == "Events") {
      ReadEvents(reader, delimiter, options, recording);
    } else {
      recording.Note("block_skipped", "line " + std::to_string(reader.line()),
                     "block \"" + title.substr(0, 40) +
                         "\" holds neither positions nor devices and is not read");
      while (NextRow(reader, delimiter, cells)) {
      }
    }
  } while (reader.Next(line) && (SplitCells(line, delimiter, cells), true));
  if (recording.points.empty() && recording.analog.empty()) {
    reader.Fail("no block of Trajectories or Devices was found");
  }
  return recording;
}

/** Blanks the part of a row that names a subject: what precedes ':' in a label, or the first cell
of an event. */
std::string RedactRow(const std::string& row, bool is_event, const std::string& where,
                      std::vector<PersonalField>& fields) {
  std::string redacted;
  size_t start = 0;
  while (start <= row.size()) {
    const size_t end = std::min(row.find_first_of(",\t", start), row.size());
    std::string cell = row.substr(start, end - start);
    const size_t colon = cell.find(':');
    const bool is_subject = is_event ? start == 0 && !cell.empty() : colon != std::string::npos;
    if (is_subject) {
      fields.push_back({where, cell});
      cell.erase(0, is_event ? cell.size() : colon + 1);
    }
    redacted += cell;
    if (end < row.size()) redacted += row[end];
    start = end + 1;
  }
  return redacted;
}

std::vector<PersonalField> RedactNexusCsv(std::string& bytes, const std::string&) {
  std::vector<PersonalField> fields;
  std::string redacted;
  bool is_events = false;
  int row = -1;  // within its block: 0 is the title
  int line_number = 0;
  for (size_t start = 0; start < bytes.size(); ++line_number) {
    const size_t end = std::min(bytes.find('\n', start), bytes.size());
    std::string line = bytes.substr(start, end - start);
    const bool is_blank = line.find_first_not_of(", \t\r") == std::string::npos;
    row = is_blank ? -1 : row + 1;
    if (row == 0) is_events = StartsWith(line, "Events");
    if (is_events ? row >= 3 : row == 2) {
      line = RedactRow(line, is_events, "line " + std::to_string(line_number + 1), fields);
    }
    redacted += line;
    if (end < bytes.size()) redacted += '\n';
    start = end + 1;
  }
  bytes = std::move(redacted);
  return fields;
}

bool RecognisesNexus(std::string_view head) {
  for (const std::string_view title :
       {"Trajectories", "Devices", "Events", "Joints", "Model Outputs"}) {
    if (!StartsWith(head, title)) continue;
    const char next = head.size() > title.size() ? head[title.size()] : '\0';
    if (next == '\n' || next == '\r' || next == ',' || next == '\t') return true;
  }
  return false;
}

}  // namespace

Importer MakeNexusCsvImporter() {
  return {"nexus_csv", "Vicon Nexus CSV", {}, RecognisesNexus, ImportNexusCsv, RedactNexusCsv};
}

}  // namespace graspbench
