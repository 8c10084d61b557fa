#include "human_study/recording/recording.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/base/error.h"
#include "core/base/text/text.h"

namespace graspbench {

size_t RecordedPoint::CountStates(SampleState state) const {
  return static_cast<size_t>(std::count(states.begin(), states.end(), state));
}

Eigen::Vector3d RecordedPoint::CalcMeanPosition() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  size_t count = 0;
  for (size_t frame = 0; frame < states.size(); ++frame) {
    if (states[frame] == SampleState::kInvalid) continue;
    sum += Position(frame);
    ++count;
  }
  if (count == 0) return Eigen::Vector3d::Constant(std::nan(""));
  return sum / static_cast<double>(count);
}

void RecordedPoint::Resize(size_t num_frames) {
  xyz.resize(3 * num_frames, std::numeric_limits<float>::quiet_NaN());
  states.resize(num_frames, SampleState::kInvalid);
}

void RecordedPoint::SetMeasured(size_t frame, double x, double y, double z) {
  const float values[3] = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  if (!std::isfinite(values[0]) || !std::isfinite(values[1]) || !std::isfinite(values[2])) {
    return SetInvalid(frame);
  }
  std::copy(values, values + 3, &xyz[3 * frame]);
  states[frame] = SampleState::kMeasured;
}

void RecordedPoint::SetInvalid(size_t frame) {
  std::fill_n(&xyz[3 * frame], 3, std::numeric_limits<float>::quiet_NaN());
  states[frame] = SampleState::kInvalid;
}

const RecordedPoint& Recording::FindPoint(const std::string& label) const {
  std::vector<std::string> labels;
  for (const RecordedPoint& point : points) {
    if (point.label == label) return point;
    labels.push_back(point.label);
  }
  throw Error(ErrorKind::kNotFound,
              "no point \"" + label + "\" in the recording" + SuggestNames(label, labels));
}

void MakeLabelsUnique(Recording& recording, const std::string& where) {
  std::set<std::string> taken;
  for (const RecordedPoint& point : recording.points) taken.insert(point.label);
  const auto find_free = [&](const std::string& stem, int& number) {
    std::string label;
    do {
      label = stem + "_" + std::to_string(number++);
    } while (!taken.insert(label).second);
    return label;
  };
  std::map<std::string, int> next_number;
  size_t num_missing = 0;
  for (size_t i = 0; i < recording.points.size(); ++i) {
    std::string& label = recording.points[i].label;
    if (label.empty()) {
      int number = static_cast<int>(i) + 1;
      label = find_free("point", number);
      ++num_missing;
      continue;
    }
    const auto [entry, is_first] = next_number.emplace(label, 2);
    if (is_first) continue;
    const std::string original = label;
    label = find_free(original, entry->second);
    recording.Note("duplicate_label", where,
                   "label \"" + original + "\" appears again at point " + std::to_string(i + 1) +
                       "; called \"" + label + "\"");
  }
  if (num_missing > 0) {
    recording.Note(
        "missing_label", where,
        std::to_string(num_missing) + " points have no label; called \"point_\" and their number");
  }
}

double FindMetresPerUnit(const std::string& unit) {
  std::string name;
  for (const char c : unit) {
    name += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  }
  static const std::map<std::string, double> known = {{"m", 1.0},
                                                      {"meter", 1.0},
                                                      {"meters", 1.0},
                                                      {"metre", 1.0},
                                                      {"metres", 1.0},
                                                      {"cm", 1e-2},
                                                      {"centimeter", 1e-2},
                                                      {"centimeters", 1e-2},
                                                      {"centimetres", 1e-2},
                                                      {"mm", 1e-3},
                                                      {"millimeter", 1e-3},
                                                      {"millimeters", 1e-3},
                                                      {"millimetres", 1e-3},
                                                      {"um", 1e-6},
                                                      {"\xc2\xb5m", 1e-6},
                                                      {"in", 0.0254},
                                                      {"inch", 0.0254},
                                                      {"inches", 0.0254},
                                                      {"ft", 0.3048},
                                                      {"feet", 0.3048}};
  const auto found = known.find(name);
  return found == known.end() ? std::nan("") : found->second;
}

void SetLengthUnit(Recording& recording, const std::string& unit, const std::string& where) {
  const double metres = FindMetresPerUnit(unit);
  for (RecordedPoint& point : recording.points) {
    point.unit = unit;
    point.metres_per_unit = metres;
  }
  if (!std::isfinite(metres) && !recording.points.empty()) {
    recording.Note("unit_missing", where,
                   unit.empty()
                       ? "no length unit is stated; positions in metres are missing until one is "
                         "given (--unit mm)"
                       : "\"" + unit +
                             "\" is not a known length unit; positions in metres are missing until "
                             "one is given (--unit mm)");
  }
}

void CheckLengthUnits(const Recording& recording, const std::string& file) {
  const auto is_known = [](const RecordedPoint& point) { return point.IsLength(); };
  if (recording.points.empty() ||
      std::any_of(recording.points.begin(), recording.points.end(), is_known)) {
    return;
  }
  throw Error(ErrorKind::kFormat, file +
                                      ": the length unit is not stated, and none is guessed; name "
                                      "it (--unit mm or --unit m)");
}

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
