#pragma once
/** @file
Names the columns of a plain table, in YAML:

    unit: mm
    points:
      index: [indexXraw, indexYraw, indexZraw]
      thumb: [thumbXraw, thumbYraw, thumbZraw]
    time: globalTime        # optional; without it rate_hz is needed
    time_unit: ms           # s (default), ms or us
    rate_hz: 85             # optional; without it the inverse of the median interval
    trial: trialN           # optional; one file, many trials: --trial chooses
    occluded: fingersOccluded   # optional; a value other than 0 makes all points invalid
    channels: {touch: ft1}      # optional; forces or touch switches, at the rate of the rows
    heading: false              # optional; the table starts with numbers: columns are 1, 2, ..
    layout: freemocap           # optional; columns as a tool writes them, see table_layouts.h
    scale: 25                   # optional; a coordinate is so many of the unit
    glove: {hand: shadow, ..}   # optional; joint angles instead of points, see glove.h */

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "human_study/recording/importers/glove.h"

namespace graspbench {

struct TableMapping {
  struct Point {
    std::string label;
    std::vector<std::string> columns;  ///< x, y, z
  };
  std::vector<Point> points;
  std::string layout;  ///< a TableLayout's id; empty: none
  std::string unit;
  double scale = 1.0;
  std::string time;  ///< empty: none
  double seconds_per_time_unit = 1.0;
  double rate = 0.0;  ///< [Hz]; 0: not stated
  std::string trial;
  std::string occluded;
  std::vector<std::pair<std::string, std::string>> channels;  ///< label, column
  GloveMapping glove;
  bool has_heading = true;  ///< else columns are named by their numbers from 1
};

/** @throws Error(kNotFound, kFormat) with file and line of every problem. */
TableMapping LoadTableMapping(const std::filesystem::path& path);

/** The trials a table holds, in their order. @throws as LoadRecording. */
std::vector<std::string> FindTableTrials(const std::filesystem::path& table,
                                         const TableMapping& mapping);

}  // namespace graspbench
