/** @file
OptiTrack Motive's CSV export, raw and cleaned.

Raw: a line of key-value pairs (rates, length unit), rows Type, Name, ID and Position/Rotation, the
row "Frame, Time (Seconds), X, Y, Z, ..", one row a frame. Blank cells are hidden markers. Columns
of rotations and errors are left out. Motive 1.5 to 1.7 (format version 1.1) write the same rows in
the same order without their titles, "Time" without its unit, and no unit of length. Cleaned: one
row of names "<marker>_position_x", .. after frame and time; it states neither rate nor unit. Where
no unit is stated, metres, Motive's own unit, are taken.

Tagged (Tracking Tools and Motive to 1.4, up to 2014; "info,version,1.1"): the first cell says what
a row is. comment: text; righthanded or lefthanded: the axes; info: a name and a value, such as
framecount; rigidbody: a body's definition, and extended data of a frame; frame: its index, its time
[s], the number of bodies with 11 cells each (id, position, quaternion, angles), the number of
markers with 5 each (x, y, z, id, name). A frame lists the markers that it saw.
Sources: docs.optitrack.com, "Data Export: CSV"; for the tagged rows, of which no page of their
maker is left, the reader that Garth Zeglin adapted to version 1.1 in 2014 (Olin College's mocap). */

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <unordered_map>

#include "core/base/text/text.h"
#include "core/base/whole_number.h"
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

/** Samples of one marker, in the frames that list it. */
struct TaggedMarker {
  std::string label;
  std::vector<size_t> frames;
  std::vector<std::array<double, 3>> places;
};

/** The tagged rows of a file, before each marker gets a value in every frame. */
class TaggedRows {
 public:
  void AddFrame(const Cells& cells, const LineReader& reader) {
    constexpr size_t kBodyCells = 11, kMarkerCells = 5;
    size_t at = 3;
    at += 1 + kBodyCells * ReadCount(cells, at, "its number of rigid bodies", reader);
    const size_t num_markers = ReadCount(cells, at++, "its number of markers", reader);
    if (cells.size() < at + kMarkerCells * num_markers) {
      reader.Fail("the frame has " + std::to_string(cells.size()) + " cells, expected " +
                  std::to_string(at + kMarkerCells * num_markers) + " for " +
                  std::to_string(num_markers) + " markers; the file is cut off or damaged here");
    }
    if (times_.empty()) first_line_ = reader.line();
    times_.push_back(ParseNumber(cells, 2, reader));
    for (size_t i = 0; i < num_markers; ++i, at += kMarkerCells) {
      const std::string name(cells[at + 4]);
      const bool is_named = !name.empty() && !StartsWith(ToLower(name), "unlabel");
      AddMarker(is_named ? name : "unlabelled_" + std::string(cells[at + 3]),
                {ParseNumber(cells, at, reader), ParseNumber(cells, at + 1, reader),
                 ParseNumber(cells, at + 2, reader)});
    }
  }

  /** Markers that few frames list are left out: each would need a value in all of them. */
  void MakePoints(Recording& recording) const {
    constexpr size_t kOneIn = 20;  // frames
    recording.num_frames = times_.size();
    size_t num_passing = 0, num_unlabelled = 0;
    for (const TaggedMarker& marker : markers_) {
      if (kOneIn * marker.frames.size() < times_.size()) {
        ++num_passing;
        continue;
      }
      num_unlabelled += StartsWith(marker.label, "unlabelled_");
      RecordedPoint& point = recording.points.emplace_back();
      point.label = marker.label;
      point.Resize(times_.size());
      for (size_t i = 0; i < marker.frames.size(); ++i) {
        const auto& [x, y, z] = marker.places[i];
        point.SetMeasured(marker.frames[i], x, y, z);
      }
    }
    if (num_passing > 0) {
      recording.Note("passing_markers", "rows frame",
                     std::to_string(num_passing) +
                         " markers are listed in less than 5 % of the frames and left out");
    }
    if (num_unlabelled > 0) {
      recording.Note("unlabelled_markers", "rows frame",
                     std::to_string(num_unlabelled) + " markers have no name; their ids name them");
    }
    if (num_repeated_ > 0) {
      recording.Note("duplicate_label", "rows frame",
                     std::to_string(num_repeated_) +
                         " times a frame lists a name twice; its first place is taken");
    }
  }
  const std::vector<double>& times() const { return times_; }
  int first_line() const { return first_line_; }

 private:
  static size_t ReadCount(const Cells& cells, size_t at, const std::string& what,
                          const LineReader& reader) {
    if (at >= cells.size()) reader.Fail("the frame ends before " + what);
    return ToWhole<size_t>(ParseHeaderNumber(cells[at], what, 0, 65535, reader));
  }
  void AddMarker(const std::string& label, const std::array<double, 3>& place) {
    const auto [known, is_new] = known_.try_emplace(label, markers_.size());
    if (is_new) markers_.push_back({label, {}, {}});
    TaggedMarker& marker = markers_[known->second];
    const size_t frame = times_.size() - 1;
    if (!marker.frames.empty() && marker.frames.back() == frame) {
      ++num_repeated_;
      return;
    }
    marker.frames.push_back(frame);
    marker.places.push_back(place);
  }

  std::vector<TaggedMarker> markers_;
  std::unordered_map<std::string, size_t> known_;
  std::vector<double> times_;
  size_t num_repeated_ = 0;
  int first_line_ = 0;
};

Recording ImportTagged(LineReader& reader, Cells cells, const ImportOptions& options) {
  Recording recording;
  TaggedRows rows;
  double num_frames = std::nan("");
  std::string line;
  do {
    const std::string tag = ToLower(cells[0]);
    const std::string key = cells.size() > 2 ? ToLower(cells[1]) : "";
    if (tag == "frame") {
      rows.AddFrame(cells, reader);
    } else if (tag == "info" && key == "version" && cells[2] != "1.1") {
      reader.Fail("tagged rows of version " + std::string(cells[2].substr(0, 20)) +
                  ", only those of 1.1 can be read; export the take again with Motive 1.5 or "
                  "later, or as C3D");
    } else if (tag == "info" && key == "framecount") {
      num_frames = ParseHeaderNumber(cells[2], "framecount", 0, 2147483647.0, reader);
    } else if (tag == "lefthanded") {
      recording.Note("left_handed_axes", "line " + std::to_string(reader.line()),
                     "the axes are left-handed, and the places are taken as they are: distances "
                     "and times are right, a mesh of the object would be mirrored");
    }
    std::string_view next;
    if (!reader.Next(next)) break;
    line = std::string(next);
    SplitCells(line, ',', cells);
  } while (true);
  rows.MakePoints(recording);
  if (recording.points.empty()) reader.Fail("no row \"frame\" lists a marker");
  SetLengthUnit(recording, options.unit.empty() ? "m" : options.unit, "file");
  if (options.unit.empty()) NoteConventionalUnit(recording);
  if (std::isfinite(num_frames)) NoteFrameCount(num_frames, "framecount", recording);
  SettleTimes(rows.times(), rows.first_line(), reader.file(), recording);
  return recording;
}

bool IsTag(std::string_view cell) {
  const std::string tag = ToLower(cell);
  return tag == "comment" || tag == "righthanded" || tag == "lefthanded" || tag == "info";
}

Recording ImportMotiveCsv(const ImportSource& source, const ImportOptions& options) {
  LineReader reader(source.stream, source.name);
  const std::string first(reader.Require("its header"));
  Cells cells;
  SplitCells(first, ',', cells);
  if (IsTag(cells[0])) return ImportTagged(reader, cells, options);
  return cells[0] == "Format Version" ? ImportRaw(reader, cells, options)
                                      : ImportCleaned(reader, cells, options);
}

/** Comments of a person stand in no known place. */
std::vector<PersonalField> RedactTagged(std::string& bytes) {
  std::vector<PersonalField> fields;
  std::istringstream stream(bytes);
  LineReader reader(stream, "");
  std::string_view text;
  Cells cells;
  while (reader.Next(text)) {
    SplitCells(text, ',', cells);
    if (ToLower(cells[0]) == "frame") break;
    if (ToLower(cells[0]) != "comment" || cells.size() < 2) continue;
    fields.push_back({"line " + std::to_string(reader.line()), std::string(text.substr(8))});
  }
  for (const PersonalField& field : fields) {
    ReplaceLine(bytes, std::stoi(field.where.substr(5)), "comment,");
  }
  return fields;
}

std::vector<PersonalField> RedactMotiveCsv(std::string& bytes, const std::string&) {
  const std::string line = FindLine(bytes, 1);
  Cells cells;
  SplitCells(line, ',', cells);
  if (IsTag(cells[0])) return RedactTagged(bytes);
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
  // The comments of tagged rows may fill the head.
  const std::string lower = ToLower(head);
  const auto has_line = [&](const std::string& start) {
    return StartsWith(lower, start) || lower.find("\n" + start) != lower.npos;
  };
  if (IsTag(head.substr(0, head.find_first_of(",\r\n"))) &&
      (has_line("info,version,") || has_line("righthanded") || has_line("lefthanded") ||
       lower.find("optitrack") != lower.npos)) {
    return true;
  }
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
