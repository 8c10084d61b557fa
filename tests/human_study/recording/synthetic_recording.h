#pragma once
/** @file
Recordings with known content, for round trips. */

#include <cmath>
#include <sstream>
#include <string>

#include "human_study/recording/importers/importer.h"
#include "human_study/recording/save_recording.h"
#include "tests/human_study/faults.h"

namespace graspbench {

/** Point i moves on its own ellipse; every 7th sample of the last point is invalid, every 11th
filled. Two analog channels of four samples a frame, two events of each kind. */
inline Recording MakeSyntheticRecording(size_t num_frames, size_t num_points) {
  Recording recording;
  recording.rate = 100.0;
  recording.first_frame = 5;
  recording.start_time = 0.04;
  recording.num_frames = num_frames;
  recording.points.resize(num_points);
  for (size_t i = 0; i < num_points; ++i) {
    RecordedPoint& point = recording.points[i];
    point.label = "P" + std::to_string(i + 1);
    point.residuals.assign(num_frames, 0.5f);
    for (size_t frame = 0; frame < num_frames; ++frame) {
      const double angle = 0.01 * static_cast<double>(frame) + static_cast<double>(i);
      point.Append(300.0 * std::cos(angle), 200.0 * std::sin(angle),
                   900.0 + static_cast<double>(i % 100));
      if (i + 1 < num_points) continue;
      if (frame % 7 == 3) point.SetInvalid(frame);
      if (frame % 11 == 5 && frame % 7 != 3) point.states[frame] = SampleState::kFilled;
    }
  }
  SetLengthUnit(recording, "mm", "test");
  for (int c = 0; c < 2; ++c) {
    AnalogChannel channel{"A" + std::to_string(c + 1), "N", 400.0, {}};
    for (size_t k = 0; k < 4 * num_frames; ++k) {
      channel.samples.push_back(
          static_cast<float>((c + 1) * std::sin(0.02 * static_cast<double>(k))));
    }
    recording.analog.push_back(std::move(channel));
  }
  recording.events = {{"touch", "Left", 0.25, EventSource::kEventGroup},
                      {"lift", "Right", 75.5, EventSource::kEventGroup},
                      {"RHS", "", 1.5, EventSource::kHeader},
                      {"RTO", "", 2.25, EventSource::kHeader}};
  return recording;
}

inline std::string FormatC3d(const Recording& recording, const C3dWriteOptions& options = {}) {
  std::ostringstream out;
  WriteC3d(out, recording, options);
  return out.str();
}

/** Imports bytes as if they were a file of that name. */
inline Recording ImportBytes(const std::string& bytes, const std::string& id,
                             const ImportOptions& options = {}) {
  std::istringstream stream(bytes);
  const auto no_sibling = [](const std::string&) { return std::nullopt; };
  return ImportRecording(FindImporter(id, "", ""), {stream, "file", no_sibling}, options);
}

/** Message of the Error that importing throws; empty when it throws none. */
inline std::string ImportFault(const std::string& bytes, const std::string& id,
                               const ImportOptions& options = {}) {
  return FaultOf([&] { ImportBytes(bytes, id, options); });
}

inline size_t CountFindings(const Recording& recording, const std::string& code) {
  size_t count = 0;
  for (const ImportFinding& finding : recording.findings) count += finding.code == code;
  return count;
}

}  // namespace graspbench
