#pragma once
/** @file
One motion-capture recording in memory, whatever file it came from.

Coordinates are kept as 32-bit floats in the file's own unit, as the formats store them, so that a
file can be written back without loss and a long recording fits into memory. Accessors return metres
in double precision (RecordedPoint::Position). A coordinate of 1 m is resolved to 0.06 um, three
orders below the noise of the cameras.

Clock: without time stamps, frame number f is at (f - 1) / rate. A recording that starts at frame 1
therefore starts at zero, and a cropped one keeps its times. */

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"

namespace graspbench {

enum class SampleState : uint8_t {
  kMeasured,  ///< seen by the cameras
  kFilled,    ///< computed or interpolated: by the recording software or by our own cleaning
  kInvalid,   ///< missing; its coordinates are NaN
};
struct SampleStateRow {
  SampleState value;
  const char* name;  ///< in files
};
inline constexpr SampleStateRow kSampleStates[] = {{SampleState::kMeasured, "measured"},
                                                   {SampleState::kFilled, "filled"},
                                                   {SampleState::kInvalid, "invalid"}};
inline const char* NameOf(SampleState state) { return RowOf(kSampleStates, state).name; }

/** One named point over all frames. */
struct RecordedPoint {
  std::string label;  ///< unique in its recording
  std::string unit;   ///< as the file states it: "mm"
  /** Length of `unit` [m]; NaN when the file does not state a unit or the values are not lengths
  (C3D also stores angles and forces as points). */
  double metres_per_unit = std::numeric_limits<double>::quiet_NaN();
  std::vector<float> xyz;           ///< 3 x num_frames, in `unit`; NaN where invalid
  std::vector<SampleState> states;  ///< num_frames
  std::vector<float> residuals;     ///< num_frames, in `unit`; empty: the format has none

  bool IsLength() const { return std::isfinite(metres_per_unit); }
  /** In the laboratory's frame [m]; NaN where invalid or not a length. */
  Eigen::Vector3d Position(size_t frame) const {
    const float* p = &xyz[3 * frame];
    return metres_per_unit * Eigen::Vector3d(p[0], p[1], p[2]);
  }
  size_t CountStates(SampleState state) const;
  /** Mean position over the valid samples [m]; NaN without any. */
  Eigen::Vector3d CalcMeanPosition() const;

  void Resize(size_t num_frames);
  /** Stores a measured sample in file units; a non-finite coordinate makes it invalid. */
  void SetMeasured(size_t frame, double x, double y, double z);
  void SetInvalid(size_t frame);
  /** Appends a frame as SetMeasured does. */
  void Append(double x, double y, double z) {
    Resize(states.size() + 1);
    SetMeasured(states.size() - 1, x, y, z);
  }
};

struct AnalogChannel {
  std::string label;
  std::string unit;            ///< of the samples, as the file states it
  double rate = 0.0;           ///< [Hz]
  std::vector<float> samples;  ///< physical values: offset and scale are applied
};

enum class EventSource {
  kEventGroup,  ///< C3D's EVENT parameters, or the event list of another format
  kHeader,      ///< the events of a C3D header, at most 18
};

struct RecordedEvent {
  std::string label;
  std::string context;  ///< side or subject ("Left"); empty when the file has none
  double time = 0.0;    ///< on the recording's clock [s]
  EventSource source = EventSource::kEventGroup;
};

/** An accepted deviation from the file format. */
struct ImportFinding {
  std::string code;   ///< stable, for programs: "duplicate_label"
  std::string where;  ///< "POINT:LABELS", "byte 512", "line 3"
  std::string text;   ///< what was found and what was assumed
};

struct Recording {
  std::string format;     ///< id of the importer: "c3d"
  std::string processor;  ///< C3D: "Intel", "DEC" or "MIPS" and "float" or "integer"; else empty
  double rate = std::numeric_limits<double>::quiet_NaN();  ///< nominal [Hz]; NaN: not stated
  int first_frame = 1;                                     ///< number of the first stored frame
  size_t num_frames = 0;
  double start_time = 0.0;    ///< of the first stored frame [s]
  std::vector<double> times;  ///< [s] one per frame; empty: even sampling from start_time
  std::vector<RecordedPoint> points;
  std::vector<AnalogChannel> analog;
  std::vector<RecordedEvent> events;
  std::vector<ImportFinding> findings;

  double Time(size_t frame) const {
    return times.empty() ? start_time + static_cast<double>(frame) / rate : times[frame];
  }
  /** @throws Error(kNotFound) listing the labels. */
  const RecordedPoint& FindPoint(const std::string& label) const;
  void Note(std::string code, std::string where, std::string text) {
    findings.push_back({std::move(code), std::move(where), std::move(text)});
  }
};

/** Appends "_2", "_3", .. to repeated point labels and notes each ("duplicate_label"); a point
without a label becomes "point_<number>" ("missing_label"). */
void MakeLabelsUnique(Recording& recording, const std::string& where);

/** Returns the length [m] of "mm", "Millimeters", "m", "cm", "um", "in", "ft", ..; NaN for anything
else. */
double FindMetresPerUnit(const std::string& unit);

/** Sets the unit of every point. If it is unknown or empty, `metres_per_unit` stays NaN and a
finding "unit_missing" advises the user. */
void SetLengthUnit(Recording& recording, const std::string& unit, const std::string& where);

/** @throws Error(kFormat) when a point's unit is unknown, with advice. */
void CheckLengthUnits(const Recording& recording, const std::string& file);

// Summaries of a recording, as text (`graspbench mocap info`) and as JSON (`--json`).
/** Keys: format, processor, points, frames, first_frame, rate_hz, duration_s, unit, labels,
invalid_samples and filled_samples (by label), analog_channels, analog_rate_hz, analog_labels,
events, findings, mean_m (by label: mean position over the valid samples [m], null without any). */
Json DescribeRecording(const Recording& recording);

/** The summary as text, one fact per line. */
std::string FormatRecording(const Recording& recording);

}  // namespace graspbench
