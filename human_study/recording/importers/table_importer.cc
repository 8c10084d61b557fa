/** @file
A plain table, one row a sample, its columns named by a mapping (table_mapping.h): by the names of
its heading, or by their numbers. Tabs, semicolons, commas or blanks between the cells. */

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <unordered_map>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/importers/table_mapping.h"
#include "human_study/recording/importers/text_rows.h"

namespace graspbench {
namespace {

bool IsNumber(std::string_view cell) { return ParseFiniteNumber(cell).has_value(); }

constexpr size_t kNoColumn = SIZE_MAX;

/** Index of a column of the heading; kNoColumn for no name. All absent ones are told at once. */
class Heading {
 public:
  /** Reads the heading; the first row of a table without one is still to be read. */
  Heading(LineReader& reader, const TableMapping& mapping) {
    if (const TableLayout* layout = FindTableLayout(mapping.layout)) {
      delimiter_ = ',';
      names_ = layout->read_names(reader, delimiter_);
      num_lines_ = reader.line();
      return;
    }
    const bool has_heading = mapping.has_heading;
    num_lines_ = has_heading ? 1 : 0;
    line_ = reader.Require(has_heading ? "the names of its columns" : "its first row");
    delimiter_ = FindDelimiter(line_);
    Cells cells;
    SplitRow(line_, delimiter_, 0, cells);
    names_.assign(cells.begin(), cells.end());
    has_numbers_ = std::all_of(names_.begin(), names_.end(), IsNumber);
    if (has_heading) return;
    if (std::none_of(names_.begin(), names_.end(), IsNumber)) {
      reader.Fail(
          "the first row has no number, but the mapping says heading: false; take that out "
          "and name the columns");
    }
    for (size_t i = 0; i < names_.size(); ++i) names_[i] = std::to_string(i + 1);
    has_numbers_ = false;
  }
  const std::vector<std::string>& names() const { return names_; }
  /** Before the first row. */
  int num_lines() const { return num_lines_; }
  char delimiter() const { return delimiter_; }
  size_t size() const { return names_.size(); }
  size_t Find(const std::string& name) {
    if (name.empty()) return kNoColumn;
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found != names_.end()) return static_cast<size_t>(found - names_.begin());
    absent_.push_back(name);
    return kNoColumn;
  }
  void Check(const LineReader& reader) const {
    if (absent_.empty()) return;
    std::string list;
    for (const std::string& name : absent_) list += (list.empty() ? "" : ", ") + name;
    if (has_numbers_) {
      reader.Fail("the first row holds numbers, not the names of columns (" + list +
                  "); for a table without a heading the mapping says heading: false and numbers "
                  "the columns from 1");
    }
    reader.Fail("the mapping names columns the table does not have: " + list +
                SuggestNames(absent_[0], names_));
  }

 private:
  std::string line_;
  char delimiter_ = ',';
  int num_lines_ = 0;
  bool has_numbers_ = false;
  std::vector<std::string> names_, absent_;
};

/** In the order of their first rows; a table may hold tens of thousands. */
class TrialList {
 public:
  /** @param begin  of the row [bytes]; @param line  its number. */
  void Add(std::string_view trial, int64_t begin, int line) {
    if (trials_.empty() || trial != trials_[last_].name) {  // most rows go on with a trial
      const auto [known, is_new] = known_.try_emplace(std::string(trial), trials_.size());
      if (is_new) trials_.push_back({std::string(trial), {begin, line, line}});
      last_ = known->second;
    }
    trials_[last_].rows.last_line = line;
  }
  const std::vector<TableTrial>& trials() const { return trials_; }
  std::vector<TableTrial> Take() { return std::move(trials_); }

 private:
  std::vector<TableTrial> trials_;
  std::unordered_map<std::string, size_t> known_;
  size_t last_ = 0;
};

/** A glove's columns and the points that its angles make. */
class GloveRows {
 public:
  GloveRows(const TableMapping& mapping, Heading& heading, Recording& recording) {
    if (!mapping.glove.IsNamed()) return;
    model_.emplace(mapping.glove);
    for (const std::string& column : mapping.glove.ListColumns()) {
      columns_.push_back(heading.Find(column));
    }
    first_ = recording.points.size();
    for (const std::string& label : model_->labels()) {
      recording.points.emplace_back();
      recording.points.back().label = label;
    }
    recording.Note("glove_model", "mapping", model_->Describe());
  }

  void Append(const Cells& cells, LineReader& reader, Recording& recording) const {
    if (!model_) return;
    std::vector<double> numbers;
    for (const size_t column : columns_) numbers.push_back(ParseNumber(cells, column, reader));
    const std::vector<Eigen::Vector3d> points =
        model_->CalcPoints(numbers, recording.points[first_].metres_per_unit);
    for (size_t i = 0; i < model_->labels().size(); ++i) {
      const Eigen::Vector3d p =
          points.empty() ? Eigen::Vector3d::Constant(std::nan("")) : points[i];
      recording.points[first_ + i].Append(p.x(), p.y(), p.z());
    }
  }

 private:
  std::optional<GloveModel> model_;
  std::vector<size_t> columns_;
  size_t first_ = 0;
};

/** Columns of each point of the mapping; the points are added to the recording. */
std::vector<std::array<size_t, 3>> AddPoints(const TableMapping& mapping, Heading& heading,
                                             Recording& recording) {
  std::vector<std::array<size_t, 3>> columns;
  for (const TableMapping::Point& point : mapping.points) {
    columns.push_back({heading.Find(point.columns[0]), heading.Find(point.columns[1]),
                       heading.Find(point.columns[2])});
    recording.points.emplace_back();
    recording.points.back().label = point.label;
  }
  return columns;
}

/** The same of the channels. */
std::vector<size_t> AddChannels(const TableMapping& mapping, Heading& heading,
                                Recording& recording) {
  std::vector<size_t> columns;
  for (const auto& [label, column] : mapping.channels) {
    columns.push_back(heading.Find(column));
    recording.analog.emplace_back();
    recording.analog.back().label = label;
  }
  return columns;
}

/** Channels have the clock of the rows, which must then be even. */
void SettleChannels(const ImportSource& source, Recording& recording) {
  if (recording.analog.empty()) return;
  if (!recording.times.empty()) {
    throw Error(ErrorKind::kFormat, source.name +
                                        ": its times are uneven, so that its channels have no "
                                        "rate; take them out of the mapping, or export the table "
                                        "at an even rate");
  }
  for (AnalogChannel& channel : recording.analog) channel.rate = recording.rate;
}

/** MediaPipe's image landmarks are shares of a picture, with depths from the wrist's: whatever unit
the mapping states, they are no lengths. */
void RefuseImageLandmarks(const ImportSource& source, const Recording& recording) {
  constexpr float kNone = 1e-5f, kSome = 1e-4f;
  const RecordedPoint* wrist = nullptr;
  bool within_picture = recording.num_frames > 0, has_depth = false;
  for (const RecordedPoint& point : recording.points) {
    if (point.label == "wrist") wrist = &point;
    for (size_t i = 0; i < point.states.size(); ++i) {
      if (point.states[i] == SampleState::kInvalid) continue;
      const float* const p = &point.xyz[3 * i];
      within_picture =
          within_picture && std::min(p[0], p[1]) > -0.5f && std::max(p[0], p[1]) < 1.5f;
      has_depth = has_depth || std::abs(p[2]) > kSome;
    }
  }
  if (wrist == nullptr || !within_picture || !has_depth) return;
  if (wrist->CountStates(SampleState::kInvalid) == wrist->states.size()) return;  // nothing is seen
  for (size_t i = 0; i < wrist->states.size(); ++i) {
    if (wrist->states[i] == SampleState::kInvalid) continue;
    if (std::abs(wrist->xyz[3 * i + 2]) > kNone) return;
  }
  throw Error(ErrorKind::kFormat,
              source.name +
                  ": these are landmarks of an image (the wrist's z is 0 in every row, x and y lie "
                  "within a picture): shares of its width, not lengths. Place them by a depth "
                  "camera or by two cameras first");
}

/** Exactly one of the table's trials was read. */
void CheckTrial(const ImportSource& source, const ImportOptions& options,
                const std::vector<TableTrial>& trials, const Recording& recording) {
  if (options.trial.empty() && trials.size() > 1) {
    throw Error(ErrorKind::kUsage, source.name + ": the table holds " +
                                       std::to_string(trials.size()) + " trials, \"" +
                                       trials.front().name + "\" to \"" + trials.back().name +
                                       "\"; name one (--trial of graspbench mocap, column "
                                       "table_trial of a study's trials.csv)");
  }
  if (!options.trial.empty() && recording.num_frames == 0) {
    std::vector<std::string> names;
    for (const TableTrial& trial : trials) names.push_back(trial.name);
    throw Error(ErrorKind::kNotFound, source.name + ": no trial \"" + options.trial + "\"" +
                                          SuggestNames(options.trial, names));
  }
}

void CheckTrialIsNamed(const TableMapping& mapping, const ImportOptions& options) {
  if (!mapping.trial.empty() || options.trial.empty()) return;
  throw Error(ErrorKind::kUsage, "--trial " + options.trial +
                                     " was asked for, but the mapping names no column \"trial\"");
}

/** From the start, behind the heading. */
LineReader OpenRows(std::istream& stream, const std::string& file, int num_heading_lines) {
  stream.clear();
  stream.seekg(0);
  LineReader reader(stream, file);
  std::string_view line;
  while (reader.line() < num_heading_lines && reader.Next(line)) {
  }
  return reader;
}

LineReader OpenRows(std::istream& stream, const std::string& file, const TableRows& rows) {
  stream.clear();
  stream.seekg(rows.begin);
  return LineReader(stream, file, rows.first_line - 1);
}

/** What a layout has and a mapping has not named. */
TableMapping AddLayoutPoints(TableMapping mapping, const Heading& heading,
                             const LineReader& reader) {
  if (mapping.layout.empty() || !mapping.points.empty()) return mapping;
  for (const std::string& point : FindLayoutPoints(heading.names(), reader)) {
    mapping.points.push_back({point, {point + "_x", point + "_y", point + "_z"}});
  }
  return mapping;
}

/** A length of the file is so many of its unit. */
void ScaleLengths(double scale, Recording& recording) {
  if (scale == 1.0 || recording.points.empty()) return;
  for (RecordedPoint& point : recording.points) {
    for (float& coordinate : point.xyz) coordinate = static_cast<float>(scale * coordinate);
  }
  recording.Note("scaled_lengths", "mapping",
                 "a length of 1 in the file is " + FormatSignificant(scale, 6) + " " +
                     recording.points.front().unit + ", as the mapping says");
}

Recording ImportMapped(const ImportSource& source, const ImportOptions& options,
                       const TableMapping& stated) {
  Recording recording;
  LineReader head(source.stream, source.name);
  Heading heading(head, stated);
  const TableMapping mapping = AddLayoutPoints(stated, heading, head);
  const std::vector<std::array<size_t, 3>> columns = AddPoints(mapping, heading, recording);
  const std::vector<size_t> channels = AddChannels(mapping, heading, recording);
  const GloveRows glove(mapping, heading, recording);
  const size_t time = heading.Find(mapping.time);
  const size_t trial = heading.Find(mapping.trial);
  const size_t occluded = heading.Find(mapping.occluded);
  heading.Check(head);
  SetLengthUnit(recording, mapping.unit.empty() ? options.unit : mapping.unit, "mapping");
  if (mapping.glove.IsNamed()) CheckLengthUnits(recording, source.name);
  if (mapping.rate > 0) recording.rate = mapping.rate;
  CheckTrialIsNamed(mapping, options);

  LineReader reader = options.rows ? OpenRows(source.stream, source.name, *options.rows)
                                   : OpenRows(source.stream, source.name, heading.num_lines());
  const int last_line = options.rows ? options.rows->last_line : std::numeric_limits<int>::max();
  std::string_view line;
  Cells cells;
  std::vector<double> times;
  TrialList trials;
  OddSamples odd;
  size_t num_occluded = 0;
  int first_line = 0;
  while (reader.line() < last_line && reader.Next(line)) {
    SplitRow(line, heading.delimiter(), 0, cells);
    if (IsBlank(cells)) continue;
    if (!HasAllColumns(cells, heading.size(), reader, options, recording)) break;
    if (trial != kNoColumn) {
      trials.Add(cells[trial], 0, reader.line());
      if (!options.trial.empty() && cells[trial] != options.trial) continue;
    }
    if (recording.num_frames == 0) first_line = reader.line();
    const bool is_occluded =
        occluded != kNoColumn && !(ParseNumber(cells, occluded, reader) == 0.0);
    for (size_t i = 0; i < columns.size(); ++i) {
      AppendTriple(cells, columns[i], reader, recording.points[i], odd);
      if (is_occluded) recording.points[i].SetInvalid(recording.num_frames);
    }
    glove.Append(cells, reader, recording);
    num_occluded += is_occluded;
    for (size_t i = 0; i < channels.size(); ++i) {
      recording.analog[i].samples.push_back(
          static_cast<float>(ParseNumber(cells, channels[i], reader)));
    }
    if (time != kNoColumn) {
      times.push_back(mapping.seconds_per_time_unit * ParseNumber(cells, time, reader));
    }
    ++recording.num_frames;
  }
  CheckTrial(source, options, trials.trials(), recording);
  ScaleLengths(mapping.scale, recording);
  NoteOdd(odd, recording);
  if (num_occluded > 0) {
    recording.Note(
        "occluded_samples", mapping.occluded,
        std::to_string(num_occluded) + " rows are flagged as occluded; taken as invalid");
  }
  SettleTimes(std::move(times), first_line, source.name, recording);
  SettleChannels(source, recording);
  RefuseImageLandmarks(source, recording);
  return recording;
}

Recording ImportTable(const ImportSource& source, const ImportOptions& options) {
  if (options.mapping.empty()) {
    throw Error(ErrorKind::kUsage, source.name +
                                       ": a plain table needs a mapping that names its columns "
                                       "(--mapping columns.yaml)");
  }
  return ImportMapped(source, options, LoadTableMapping(options.mapping));
}

}  // namespace

std::vector<TableTrial> ListTableTrials(std::istream& stream, const std::string& name,
                                        const TableMapping& mapping) {
  LineReader reader(stream, name);
  Heading heading(reader, mapping);
  const size_t column = heading.Find(mapping.trial);
  heading.Check(reader);
  TrialList trials;
  LineReader rows = OpenRows(stream, name, heading.num_lines());
  std::string_view line;
  Cells cells;
  int64_t begin = stream.tellg();
  while (column != kNoColumn && rows.Next(line)) {
    SplitRow(line, heading.delimiter(), 0, cells);
    if (column < cells.size()) trials.Add(cells[column], begin, rows.line());
    begin = stream.tellg();
  }
  return trials.Take();
}

Importer MakeTableImporter() {
  return {"table", "plain table with a mapping", {}, nullptr, ImportTable, nullptr};
}

}  // namespace graspbench
