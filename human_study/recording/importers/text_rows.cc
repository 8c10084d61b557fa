#include "human_study/recording/importers/text_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text/text.h"
#include "core/base/whole_number.h"
#include "core/statistics/summary.h"
#include "human_study/recording/importers/importer.h"

namespace graspbench {
namespace {

/** First byte and one past the last byte of a line, without its ending. */
std::pair<size_t, size_t> FindLineBounds(const std::string& bytes, int line) {
  size_t start = 0;
  for (int k = 1; k < line; ++k) {
    const size_t end = bytes.find('\n', start);
    if (end == std::string::npos) return {bytes.size(), bytes.size()};
    start = end + 1;
  }
  size_t end = std::min(bytes.find('\n', start), bytes.size());
  if (end > start && bytes[end - 1] == '\r') --end;
  return {start, end};
}

}  // namespace

bool HasAllColumns(const Cells& cells, size_t num_columns, const LineReader& reader,
                   const ImportOptions& options, Recording& recording) {
  if (cells.size() >= num_columns) return true;
  const std::string text = "the row has " + std::to_string(cells.size()) + " columns, expected " +
                           std::to_string(num_columns);
  if (!options.accept_truncated) {
    reader.Fail(text +
                "; the file is cut off or damaged here (--accept-truncated reads what comes "
                "before)");
  }
  recording.Note("truncated", "line " + std::to_string(reader.line()),
                 text + "; nothing is read from there on");
  return false;
}

void AppendTriple(const Cells& cells, const std::array<size_t, 3>& columns,
                  const LineReader& reader, RecordedPoint& point, OddSamples& odd) {
  const double x = ParseNumber(cells, columns[0], reader);
  const double y = ParseNumber(cells, columns[1], reader);
  const double z = ParseNumber(cells, columns[2], reader);
  point.Append(x, y, z);
  if (x == 0 && y == 0 && z == 0) {
    point.SetInvalid(point.states.size() - 1);
    ++odd.num_zeros;
  }
  for (const double value : {x, y, z}) {
    if (!std::isfinite(value) || std::abs(value) <= std::numeric_limits<float>::max()) continue;
    ++odd.num_huge;
    return;
  }
}

void AppendTriple(const Cells& cells, size_t column, const LineReader& reader, RecordedPoint& point,
                  OddSamples& odd) {
  AppendTriple(cells, {column, column + 1, column + 2}, reader, point, odd);
}

void NoteOdd(const OddSamples& odd, Recording& recording) {
  if (odd.num_zeros > 0) {
    recording.Note(
        "zero_coordinates", "data",
        std::to_string(odd.num_zeros) + " samples at exactly (0, 0, 0); taken as invalid");
  }
  if (odd.num_huge > 0) {
    recording.Note("huge_coordinates", "data",
                   std::to_string(odd.num_huge) +
                       " samples with a coordinate beyond 3.4e38, which is no place; taken as "
                       "invalid");
  }
}

void NoteFrameCount(double declared, const std::string& where, Recording& recording) {
  if (declared == static_cast<double>(recording.num_frames)) return;
  recording.Note("frame_count_disputed", where,
                 "promises " + FormatSignificant(declared, 6) + " frames, the file holds " +
                     std::to_string(recording.num_frames) + "; those are taken");
}

void SettleTimes(std::vector<double> times, int first_line, const std::string& file,
                 Recording& recording) {
  recording.start_time = (recording.first_frame - 1) / recording.rate;
  if (times.empty()) return;
  std::vector<double> intervals;
  for (size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1])) {
      FailAtLine(file, first_line + static_cast<int>(i),
                 "time is " + FormatSignificant(times[i], 6) + " s" +
                     (i > 0 ? " after " + FormatSignificant(times[i - 1], 6) + " s" : "") +
                     "; times must increase (does the file hold several trials?)");
    }
    if (i > 0) intervals.push_back(times[i] - times[i - 1]);
  }
  recording.start_time = times[0];
  if (intervals.empty()) return;
  const auto is_even = [&](double rate) {
    for (size_t i = 0; i < times.size(); ++i) {
      if (std::abs((times[i] - times[0]) * rate - static_cast<double>(i)) > 0.05) return false;
    }
    return true;
  };
  if (!std::isfinite(recording.rate)) {
    const double mean_rate = static_cast<double>(intervals.size()) / (times.back() - times[0]);
    recording.rate = is_even(mean_rate) ? mean_rate : 1.0 / CalcMedian(intervals);
    recording.Note(
        "rate_from_times", "time column",
        "no rate is stated; the intervals give " + FormatSignificant(recording.rate, 6) + " Hz");
  }
  if (is_even(recording.rate)) return;
  const auto [shortest, longest] = std::minmax_element(intervals.begin(), intervals.end());
  recording.Note("irregular_times", "time column",
                 "intervals run from " + FormatSignificant(1e3 * *shortest, 6) + " to " +
                     FormatSignificant(1e3 * *longest, 6) + " ms and do not keep to " +
                     FormatSignificant(recording.rate, 6) +
                     " Hz; the time stamps are used, not the rate");
  recording.times = std::move(times);
}

std::string FindLine(const std::string& bytes, int line) {
  const auto [start, end] = FindLineBounds(bytes, line);
  return bytes.substr(start, end - start);
}

char FindDelimiter(std::string_view row) {
  for (const char delimiter : {'\t', ';', ','}) {
    if (row.find(delimiter) != std::string_view::npos) return delimiter;
  }
  return kBlanks;
}

void SplitRow(std::string_view line, char delimiter, size_t num_columns, Cells& cells) {
  if (delimiter != kBlanks) return SplitCells(line, delimiter, cells);
  cells.clear();
  for (size_t begin = 0; (begin = line.find_first_not_of(kBlanks, begin)) != line.npos;) {
    const size_t end = std::min(line.find(kBlanks, begin), line.size());
    cells.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  if (!cells.empty() && cells.size() < num_columns) {
    Cells single;
    SplitCells(line, kBlanks, single);
    while (single.size() > num_columns && single.back().empty()) single.pop_back();
    if (single.size() == num_columns) cells = std::move(single);
  }
  if (cells.empty()) cells.emplace_back();
}

FrameRows ReadFrameRows(LineReader& reader, char delimiter, const std::vector<size_t>& columns,
                        const ImportOptions& options, Recording& recording) {
  FrameRows rows;
  size_t width = 2;
  for (const size_t column : columns) width = std::max(width, column + 3);
  std::string_view line;
  Cells cells;
  OddSamples odd;
  while (reader.Next(line)) {
    SplitRow(line, delimiter, width, cells);
    if (IsBlank(cells)) continue;
    if (!HasAllColumns(cells, width, reader, options, recording)) break;
    if (recording.num_frames == 0) {
      rows.first_line = reader.line();
      recording.first_frame =
          ToWhole<int>(ParseHeaderNumber(cells[0], "the first frame's number", -1e9, 1e9, reader));
    }
    rows.times.push_back(ParseNumber(cells, 1, reader));
    for (size_t i = 0; i < columns.size(); ++i) {
      AppendTriple(cells, columns[i], reader, recording.points[i], odd);
    }
    ++recording.num_frames;
  }
  NoteOdd(odd, recording);
  return rows;
}

void ReplaceLine(std::string& bytes, int line, const std::string& text) {
  const auto [start, end] = FindLineBounds(bytes, line);
  bytes.replace(start, end - start, text);
}

}  // namespace graspbench
