#include "human_study/recording/describe_recording.h"

#include <set>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

std::string FormatUnit(const Recording& recording) {
  std::set<std::string> units;
  for (const RecordedPoint& point : recording.points) {
    if (point.IsLength()) units.insert(point.unit);
  }
  std::string text;
  for (const std::string& unit : units) text += (text.empty() ? "" : ", ") + unit;
  return text;
}

const char* NameOf(EventSource source) {
  return source == EventSource::kHeader ? "header" : "event_group";
}

}  // namespace

Json DescribeRecording(const Recording& recording) {
  Json labels = Json::array(), analog_labels = Json::array(), events = Json::array(),
       findings = Json::array();
  Json::object_t invalid, filled, means;  // labels are unique
  for (const RecordedPoint& point : recording.points) {
    const Eigen::Vector3d mean = point.CalcMeanPosition();
    labels.push_back(point.label);
    invalid.emplace_back(point.label, point.CountStates(SampleState::kInvalid));
    filled.emplace_back(point.label, point.CountStates(SampleState::kFilled));
    means.emplace_back(point.label, mean.allFinite() ? JsonVector(mean) : Json(nullptr));
  }
  for (const AnalogChannel& channel : recording.analog) analog_labels.push_back(channel.label);
  for (const RecordedEvent& event : recording.events) {
    events.push_back({{"label", event.label},
                      {"context", event.context},
                      {"time_s", JsonNumber(event.time)},
                      {"source", NameOf(event.source)}});
  }
  for (const ImportFinding& finding : recording.findings) {
    findings.push_back({{"code", finding.code}, {"where", finding.where}, {"text", finding.text}});
  }
  const std::string unit = FormatUnit(recording);
  return Json{
      {"format", recording.format},
      {"processor", recording.processor.empty() ? Json(nullptr) : Json(recording.processor)},
      {"points", recording.points.size()},
      {"frames", recording.num_frames},
      {"first_frame", recording.first_frame},
      {"rate_hz", JsonNumber(recording.rate)},
      {"duration_s",
       JsonNumber(recording.num_frames == 0
                      ? 0.0
                      : recording.Time(recording.num_frames - 1) - recording.Time(0))},
      {"unit", unit.empty() ? Json(nullptr) : Json(unit)},
      {"labels", labels},
      {"invalid_samples", invalid},
      {"filled_samples", filled},
      {"analog_channels", recording.analog.size()},
      {"analog_rate_hz",
       recording.analog.empty() ? Json(nullptr) : JsonNumber(recording.analog[0].rate)},
      {"analog_labels", analog_labels},
      {"events", events},
      {"findings", findings},
      {"mean_m", means}};
}

std::string FormatRecording(const Recording& recording) {
  const std::string unit = FormatUnit(recording);
  std::string text = "format       " + recording.format +
                     (recording.processor.empty() ? "" : ", " + recording.processor) + "\n";
  text += "frames       " + std::to_string(recording.num_frames) + " from number " +
          std::to_string(recording.first_frame) + " at " + FormatSignificant(recording.rate, 6) +
          " Hz" + (recording.times.empty() ? "" : " (own time stamps)") + "\n";
  text += "unit         " + (unit.empty() ? "not stated" : unit) + "\n";
  text += "points       " + std::to_string(recording.points.size()) + "\n";
  for (const RecordedPoint& point : recording.points) {
    const size_t invalid = point.CountStates(SampleState::kInvalid);
    const size_t filled = point.CountStates(SampleState::kFilled);
    text += "  " + point.label;
    if (!point.IsLength()) text += "  (not a position: " + point.unit + ")";
    if (invalid > 0) text += "  " + std::to_string(invalid) + " invalid";
    if (filled > 0) text += "  " + std::to_string(filled) + " filled";
    text += "\n";
  }
  if (!recording.analog.empty()) {
    text += "analog       " + std::to_string(recording.analog.size()) + " channels at " +
            FormatSignificant(recording.analog[0].rate, 6) + " Hz:";
    for (const AnalogChannel& channel : recording.analog) text += " " + channel.label;
    text += "\n";
  }
  if (!recording.events.empty()) {
    text += "events       " + std::to_string(recording.events.size()) + "\n";
    for (const RecordedEvent& event : recording.events) {
      text += "  " + FormatSignificant(event.time, 6) + " s  " + event.label +
              (event.context.empty() ? "" : " (" + event.context + ")") +
              (event.source == EventSource::kHeader ? "  [header]" : "") + "\n";
    }
  }
  text += "findings     " + std::to_string(recording.findings.size()) + "\n";
  for (const ImportFinding& finding : recording.findings) {
    text += "  " + finding.code + " at " + finding.where + ": " + finding.text + "\n";
  }
  return text;
}

}  // namespace graspbench
