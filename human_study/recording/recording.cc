#include "human_study/recording/recording.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/base/error.h"

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

}  // namespace graspbench
