/** @file
Motion-BIDS (Jeung et al. 2024): `.._motion.tsv` without a heading, one column a channel, described
by `.._channels.tsv` and `.._motion.json` beside it; `.._events.tsv` when present. Channels of type
POS become points, LATENCY the time stamps, the rest analog channels at the same rate. */

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "core/base/text/json.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/importers/text_rows.h"

namespace graspbench {
namespace {

struct Channel {
  std::string name, component, type, tracked_point, units;
};

/** Rows of a tab-separated table by the names of its first line. */
std::vector<std::map<std::string, std::string>> ParseTable(const std::string& text,
                                                           const std::string& file) {
  std::istringstream stream(text);
  LineReader reader(stream, file);
  Cells cells;
  const std::string head(reader.Require("the names of its columns"));
  Cells names;
  SplitCells(head, '\t', names);
  std::vector<std::map<std::string, std::string>> rows;
  std::string_view line;
  while (reader.Next(line)) {
    SplitCells(line, '\t', cells);
    if (IsBlank(cells)) continue;
    if (cells.size() != names.size()) {
      reader.Fail("the row has " + std::to_string(cells.size()) + " columns, expected " +
                  std::to_string(names.size()));
    }
    rows.emplace_back();
    for (size_t i = 0; i < names.size(); ++i) {
      rows.back()[std::string(names[i])] = std::string(cells[i]);
    }
  }
  return rows;
}

std::string FindCell(const std::map<std::string, std::string>& row, const char* name) {
  const auto found = row.find(name);
  return found == row.end() || found->second == "n/a" ? "" : found->second;
}

std::vector<Channel> ParseChannels(const std::string& text, const std::string& file) {
  std::vector<Channel> channels;
  for (const auto& row : ParseTable(text, file)) {
    channels.push_back({FindCell(row, "name"), FindCell(row, "component"), FindCell(row, "type"),
                        FindCell(row, "tracked_point"), FindCell(row, "units")});
  }
  return channels;
}

double ParseRate(const std::string& text, const std::string& file) {
  const Json json = Json::try_parse(text);
  if (!json.is_object()) FailAtLine(file, 1, "is not a JSON object");
  const Json* const rate = json.find("SamplingFrequency");
  if (rate == nullptr || !rate->is_number() || !(rate->get<double>() > 0) ||
      !(rate->get<double>() < 1e6)) {
    FailAtLine(file, 1, "SamplingFrequency is absent or not a number above 0");
  }
  return rate->get<double>();
}

/** Where each column goes. */
struct Columns {
  std::vector<std::array<size_t, 3>> points;
  std::vector<size_t> analog;
  size_t latency = SIZE_MAX;
};

Columns AssignColumns(const std::vector<Channel>& channels, const std::string& file,
                      Recording& recording) {
  Columns columns;
  std::map<std::string, size_t> index;
  for (size_t c = 0; c < channels.size(); ++c) {
    const Channel& channel = channels[c];
    if (channel.type == "LATENCY") {
      columns.latency = c;
      continue;
    }
    const size_t axis = channel.component == "x"   ? 0
                        : channel.component == "y" ? 1
                        : channel.component == "z" ? 2
                                                   : 3;
    if (channel.type != "POS" || axis == 3) {
      columns.analog.push_back(c);
      recording.analog.push_back({channel.name, channel.units, recording.rate, {}});
      continue;
    }
    const auto [entry, is_new] = index.emplace(channel.tracked_point, recording.points.size());
    if (is_new) {
      recording.points.emplace_back();
      RecordedPoint& point = recording.points.back();
      point.label = channel.tracked_point;
      point.unit = channel.units;
      point.metres_per_unit = FindMetresPerUnit(channel.units);
      columns.points.push_back({SIZE_MAX, SIZE_MAX, SIZE_MAX});
      if (!point.IsLength()) {
        FailAtLine(file, static_cast<int>(c) + 2,
                   "units \"" + channel.units + "\" of " + channel.name + " are not a length");
      }
    }
    columns.points[entry->second][axis] = c;
  }
  for (size_t i = 0; i < columns.points.size(); ++i) {
    for (const size_t c : columns.points[i]) {
      if (c == SIZE_MAX) {
        FailAtLine(file, 1,
                   "tracked point \"" + recording.points[i].label +
                       "\" lacks one of its components x, y, z");
      }
    }
  }
  return columns;
}

void ReadEvents(const ImportSource& source, const std::string& stem, Recording& recording) {
  // Events belong to the task, not to one tracking system.
  std::string task_stem = stem;
  if (const size_t entity = stem.find("_tracksys-"); entity != std::string::npos) {
    task_stem.erase(entity, std::min(stem.find('_', entity + 1), stem.size()) - entity);
  }
  const std::string file = task_stem + "_events.tsv";
  const auto events = source.read_sibling(file);
  if (!events) return;
  int line_number = 1;
  for (const auto& row : ParseTable(*events, file)) {
    ++line_number;
    const Cells onset = {row.count("onset") ? std::string_view(row.at("onset")) : ""};
    std::istringstream nothing;
    const double time = ParseNumber(onset, 0, LineReader(nothing, file));
    if (!std::isfinite(time)) FailAtLine(file, line_number, "the event has no onset");
    recording.events.push_back({FindCell(row, "trial_type"), "", time, EventSource::kEventGroup});
  }
}

Recording ImportMotionBids(const ImportSource& source, const ImportOptions& options) {
  const std::string name = std::filesystem::path(source.name).filename().string();
  const std::string end = "_motion.tsv";
  const std::string stem = name.size() > end.size() ? name.substr(0, name.size() - end.size()) : "";
  const auto require = [&](const std::string& sibling) {
    std::optional<std::string> text = source.read_sibling(sibling);
    if (!text) {
      throw Error(ErrorKind::kNotFound, source.name + ": \"" + sibling +
                                            "\", which describes its columns, is not beside it");
    }
    return *text;
  };
  Recording recording;
  const std::string channel_file = stem + "_channels.tsv";
  recording.rate = ParseRate(require(stem + "_motion.json"), stem + "_motion.json");
  const std::vector<Channel> channels = ParseChannels(require(channel_file), channel_file);
  const Columns columns = AssignColumns(channels, channel_file, recording);
  MakeLabelsUnique(recording, channel_file);

  LineReader reader(source.stream, source.name);
  std::string_view line;
  Cells cells;
  std::vector<double> times;
  OddSamples odd;
  while (reader.Next(line)) {
    SplitCells(line, '\t', cells);
    if (IsBlank(cells)) continue;
    if (!HasAllColumns(cells, channels.size(), reader, options, recording)) break;
    for (size_t i = 0; i < columns.points.size(); ++i) {
      AppendTriple(cells, columns.points[i], reader, recording.points[i], odd);
    }
    for (size_t a = 0; a < columns.analog.size(); ++a) {
      recording.analog[a].samples.push_back(
          static_cast<float>(ParseNumber(cells, columns.analog[a], reader)));
    }
    if (columns.latency != SIZE_MAX) times.push_back(ParseNumber(cells, columns.latency, reader));
    ++recording.num_frames;
  }
  NoteOdd(odd, recording);
  SettleTimes(std::move(times), 1, source.name, recording);
  ReadEvents(source, stem, recording);
  return recording;
}

}  // namespace

Importer MakeMotionBidsImporter() {
  return {"motion_bids", "Motion-BIDS", {"_motion.tsv"}, nullptr, ImportMotionBids, nullptr};
}

}  // namespace graspbench
