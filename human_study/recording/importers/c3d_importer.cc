/** @file
C3D, all processors, integer and floating point. The format's rules: c3d.org user guide. */

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/whole_number.h"
#include "human_study/recording/importers/c3d_parameters.h"
#include "human_study/recording/importers/importer.h"

namespace graspbench {
namespace {

/** How the file uses its residuals; decides what they mean. */
struct ResidualCounts {
  size_t negative_with_coordinates = 0;
  size_t zero = 0;
  size_t positive = 0;
  size_t zero_coordinates = 0;  ///< exactly at the origin although not marked invalid
  size_t not_finite = 0;
  size_t fractional = 0;
};

/** Physical value = (stored - offset) * scale. */
struct AnalogScale {
  double offset = 0.0;
  double scale = 1.0;
  bool is_unsigned = false;
};

template <C3dProcessor processor, bool is_float>
float DecodeValue(const uint8_t* p) {
  if constexpr (is_float) return DecodeC3dFloat<processor>(p);
  return static_cast<int16_t>(DecodeC3dWord<processor>(p));
}

/** Residual in integer steps, or -1 for an invalid sample. The high byte of the word is the mask of
the cameras that saw the point. */
float DecodeResidual(float word, ResidualCounts& counts) {
  if (!(word >= 0.0f)) return -1.0f;
  if (word != std::floor(word)) {
    ++counts.fractional;
    return word;
  }
  return static_cast<float>(ToWhole<uint32_t>(std::min(word, 65535.0f)) & 0xff);
}

template <C3dProcessor processor, bool is_float>
void DecodePoints(const uint8_t* chunk, size_t num_frames, size_t first, const C3dLayout& layout,
                  Recording& recording, ResidualCounts& counts) {
  constexpr size_t kSize = is_float ? 4 : 2;
  const float scale = is_float ? 1.0f : static_cast<float>(layout.scale);
  const float residual_scale = static_cast<float>(layout.scale);
  for (size_t i = 0; i < layout.num_points; ++i) {
    RecordedPoint& point = recording.points[i];
    const uint8_t* p = chunk + 4 * kSize * i;
    for (size_t frame = first; frame < first + num_frames; ++frame, p += layout.frame_size()) {
      float* xyz = &point.xyz[3 * frame];
      for (int k = 0; k < 3; ++k) {
        xyz[k] = scale * DecodeValue<processor, is_float>(p + kSize * static_cast<size_t>(k));
      }
      const float residual =
          DecodeResidual(DecodeValue<processor, is_float>(p + 3 * kSize), counts);
      const bool is_finite =
          std::isfinite(xyz[0]) && std::isfinite(xyz[1]) && std::isfinite(xyz[2]);
      const bool is_origin = xyz[0] == 0 && xyz[1] == 0 && xyz[2] == 0;
      point.residuals[frame] = residual * residual_scale;
      SampleState state = residual == 0.0f ? SampleState::kFilled : SampleState::kMeasured;
      if (residual < 0.0f) {
        state = SampleState::kInvalid;
        if (is_finite && !is_origin) ++counts.negative_with_coordinates;
      } else if (!is_finite) {
        state = SampleState::kInvalid;
        ++counts.not_finite;
      } else if (is_origin && point.IsLength()) {
        state = SampleState::kInvalid;
        ++counts.zero_coordinates;
      } else {
        ++(residual == 0.0f ? counts.zero : counts.positive);
      }
      point.states[frame] = state;
    }
  }
}

template <C3dProcessor processor, bool is_float>
void DecodeAnalog(const uint8_t* chunk, size_t num_frames, const C3dLayout& layout,
                  const std::vector<AnalogScale>& scales, Recording& recording) {
  constexpr size_t kSize = is_float ? 4 : 2;
  for (size_t c = 0; c < layout.num_channels; ++c) {
    std::vector<float>& samples = recording.analog[c].samples;
    const AnalogScale& s = scales[c];
    for (size_t frame = 0; frame < num_frames; ++frame) {
      const uint8_t* p = chunk + frame * layout.frame_size() + (4 * layout.num_points + c) * kSize;
      for (size_t k = 0; k < layout.samples_per_frame; ++k, p += layout.num_channels * kSize) {
        double value = DecodeValue<processor, is_float>(p);
        if (!is_float && s.is_unsigned && value < 0) value += 65536;
        samples.push_back(static_cast<float>((value - s.offset) * s.scale));
      }
    }
  }
}

template <C3dProcessor processor, bool is_float>
void DecodeData(std::istream& stream, const C3dLayout& layout,
                const std::vector<AnalogScale>& scales, const std::string& file,
                Recording& recording, ResidualCounts& counts) {
  constexpr size_t kChunk = 1 << 18;  // fits the processor's cache
  const size_t frames_per_chunk = std::max<size_t>(1, kChunk / layout.frame_size());
  std::vector<uint8_t> chunk(frames_per_chunk * layout.frame_size());
  stream.seekg(static_cast<std::streamoff>(layout.data_position));
  for (size_t first = 0; first < layout.num_frames; first += frames_per_chunk) {
    const size_t num_frames = std::min(frames_per_chunk, layout.num_frames - first);
    stream.read(reinterpret_cast<char*>(chunk.data()),
                static_cast<std::streamsize>(num_frames * layout.frame_size()));
    if (!stream) throw Error(ErrorKind::kIo, "cannot read the data of \"" + file + "\"");
    DecodePoints<processor, is_float>(chunk.data(), num_frames, first, layout, recording, counts);
    DecodeAnalog<processor, is_float>(chunk.data(), num_frames, layout, scales, recording);
  }
}

void DecodeData(C3dProcessor processor, std::istream& stream, const C3dLayout& layout,
                const std::vector<AnalogScale>& scales, const std::string& file,
                Recording& recording, ResidualCounts& counts) {
  const auto decode = [&](auto for_float, auto for_integer) {
    (layout.is_float ? for_float : for_integer)(stream, layout, scales, file, recording, counts);
  };
  using P = C3dProcessor;
  switch (processor) {
    case P::kIntel:
      return decode(DecodeData<P::kIntel, true>, DecodeData<P::kIntel, false>);
    case P::kDec:
      return decode(DecodeData<P::kDec, true>, DecodeData<P::kDec, false>);
    case P::kMips:
      return decode(DecodeData<P::kMips, true>, DecodeData<P::kMips, false>);
  }
}

void MakePoints(const C3dParameters& parameters, const ImportOptions& options,
                const C3dLayout& layout, Recording& recording) {
  recording.points.resize(layout.num_points);
  if (layout.num_points == 0) return;
  const std::vector<std::string> labels = parameters.Texts("POINT", "LABELS");
  if (labels.size() > layout.num_points) {
    recording.Note("extra_labels", "POINT:LABELS",
                   std::to_string(labels.size()) + " labels for " +
                       std::to_string(layout.num_points) + " points; the first ones are taken");
  }
  for (size_t i = 0; i < std::min(labels.size(), layout.num_points); ++i) {
    recording.points[i].label = labels[i];
  }
  std::vector<std::string> units = parameters.Texts("POINT", "UNITS");
  if ((units.empty() || units[0].empty()) && !options.unit.empty()) units = {options.unit};
  SetLengthUnit(recording, units.empty() ? "" : units[0], "POINT:UNITS");
  if (units.size() >= layout.num_points) {
    for (size_t i = 0; i < layout.num_points; ++i) {
      recording.points[i].unit = units[i];
      recording.points[i].metres_per_unit = FindMetresPerUnit(units[i]);
    }
  }
  // Results of models are stored as points: POINT:ANGLES, .. list them by label.
  static const std::pair<const char*, const char*> kTypes[] = {
      {"ANGLES", "ANGLE_UNITS"}, {"FORCES", "FORCE_UNITS"},   {"MOMENTS", "MOMENT_UNITS"},
      {"POWERS", "POWER_UNITS"}, {"SCALARS", "SCALAR_UNITS"}, {"REACTIONS", "REACTION_UNITS"}};
  size_t num_others = 0;
  for (const auto& [list, unit_name] : kTypes) {
    const std::vector<std::string> listed = parameters.Texts("POINT", list);
    const std::set<std::string> members(listed.begin(), listed.end());
    const std::vector<std::string> unit = parameters.Texts("POINT", unit_name);
    for (RecordedPoint& point : recording.points) {
      if (point.label.empty() || members.count(point.label) == 0) continue;
      point.unit = unit.empty() ? "" : unit[0];
      point.metres_per_unit = std::nan("");
      ++num_others;
    }
  }
  if (num_others > 0) {
    recording.Note("not_positions", "POINT:TYPE_GROUPS",
                   std::to_string(num_others) +
                       " points hold angles, forces or other results, not positions; they keep "
                       "their units and have no position in metres");
  }
  MakeLabelsUnique(recording, "POINT:LABELS");
  for (RecordedPoint& point : recording.points) {
    point.Resize(layout.num_frames);
    point.residuals.resize(layout.num_frames);
  }
}

std::vector<AnalogScale> MakeAnalog(const C3dParameters& parameters, const C3dLayout& layout,
                                    Recording& recording) {
  std::vector<AnalogScale> scales(layout.num_channels);
  recording.analog.resize(layout.num_channels);
  if (layout.num_channels == 0) return scales;
  const std::vector<std::string> labels = parameters.Texts("ANALOG", "LABELS");
  const std::vector<std::string> units = parameters.Texts("ANALOG", "UNITS");
  const std::vector<std::string> format = parameters.Texts("ANALOG", "FORMAT");
  const bool is_unsigned = !format.empty() && format[0] == "UNSIGNED";
  const std::vector<double> offset = parameters.Numbers("ANALOG", "OFFSET", is_unsigned);
  const std::vector<double> scale = parameters.Numbers("ANALOG", "SCALE");
  const std::vector<double> general = parameters.Numbers("ANALOG", "GEN_SCALE");
  if (scale.size() < layout.num_channels || offset.size() < layout.num_channels ||
      general.empty()) {
    recording.Note("missing_parameter", "ANALOG:SCALE",
                   "SCALE, OFFSET or GEN_SCALE do not cover all " +
                       std::to_string(layout.num_channels) +
                       " channels; scale 1 and offset 0 are taken where absent");
  }
  for (size_t c = 0; c < layout.num_channels; ++c) {
    AnalogChannel& channel = recording.analog[c];
    channel.label =
        c < labels.size() && !labels[c].empty() ? labels[c] : "analog_" + std::to_string(c + 1);
    channel.unit = c < units.size() ? units[c] : "";
    channel.rate = layout.rate * static_cast<double>(layout.samples_per_frame);
    channel.samples.reserve(layout.num_frames * layout.samples_per_frame);
    scales[c].is_unsigned = is_unsigned;
    scales[c].offset = c < offset.size() ? offset[c] : 0.0;
    scales[c].scale = (c < scale.size() ? scale[c] : 1.0) * (general.empty() ? 1.0 : general[0]);
  }
  return scales;
}

/** Turns the words of the file into the three states, once all of them are known. */
void SettleStates(const ImportOptions& options, const ResidualCounts& counts,
                  Recording& recording) {
  const auto samples = [](size_t n) {
    return std::to_string(n) + (n == 1 ? " sample" : " samples");
  };
  const bool has_valid = counts.zero + counts.positive > 0;
  const bool only_negative = !has_valid && counts.negative_with_coordinates > 0;
  const bool revive = only_negative && !options.trust_residuals;
  const bool all_zero = counts.positive == 0 && counts.zero > 0;
  if (only_negative) {
    recording.Note(
        "all_residuals_negative", "data",
        "every residual is negative, which marks all samples invalid, but " +
            samples(counts.negative_with_coordinates) + " hold coordinates; they are " +
            (revive ? "taken as measured (--trust-residuals refuses them)" : "refused as asked"));
  }
  if (all_zero) {
    recording.Note("all_residuals_zero", "data",
                   "every residual is 0, which marks computed samples; measured and filled cannot "
                   "be told apart, and all are taken as measured");
  }
  if (counts.zero_coordinates > 0) {
    recording.Note("zero_coordinates", "data",
                   samples(counts.zero_coordinates) +
                       " at exactly (0, 0, 0) although not marked invalid; taken as invalid");
  }
  if (counts.not_finite > 0) {
    recording.Note("not_finite", "data",
                   samples(counts.not_finite) +
                       " with coordinates that are not numbers although not marked invalid; taken "
                       "as invalid");
  }
  if (counts.fractional > 0) {
    recording.Note("fractional_residual", "data",
                   samples(counts.fractional) +
                       " with a residual word that is not whole; taken as the residual itself");
  }
  for (RecordedPoint& point : recording.points) {
    for (size_t frame = 0; frame < recording.num_frames; ++frame) {
      SampleState& state = point.states[frame];
      const float* p = &point.xyz[3 * frame];
      const bool has_coordinates = std::isfinite(p[0] + p[1] + p[2]) && (p[0] || p[1] || p[2]);
      if (revive && has_coordinates) state = SampleState::kMeasured;
      if (all_zero && state == SampleState::kFilled) state = SampleState::kMeasured;
      if (state == SampleState::kInvalid) point.SetInvalid(frame);
    }
  }
}

void ReadEventGroup(const C3dParameters& parameters, Recording& recording) {
  const std::vector<double> used = parameters.Numbers("EVENT", "USED", true);
  const std::vector<double> times = parameters.Numbers("EVENT", "TIMES");
  const std::vector<std::string> labels = parameters.Texts("EVENT", "LABELS");
  const std::vector<std::string> contexts = parameters.Texts("EVENT", "CONTEXTS");
  size_t count = times.size() / 2;
  if (!used.empty()) {
    const std::optional<size_t> stated = FindCount(used[0], static_cast<double>(count));
    if (!stated) {
      recording.Note(
          "event_count_disputed", "EVENT:USED",
          fmt::format("counts {:g} events, EVENT:TIMES holds {}; those are taken", used[0], count));
    }
    count = stated.value_or(count);
  }
  for (size_t i = 0; i < count; ++i) {
    recording.events.push_back({i < labels.size() ? labels[i] : "",
                                i < contexts.size() ? contexts[i] : "",
                                60.0 * times[2 * i] + times[2 * i + 1],  // minutes, seconds
                                EventSource::kEventGroup});
  }
}

void ReadHeaderEvents(const C3dHead& head, Recording& recording) {
  int count = head.Word(c3d_header::kEventCount);
  if (count > kC3dMaxHeaderEvents) {
    recording.Note("event_count_disputed", "byte 300",
                   "the header counts " + std::to_string(count) +
                       " events; it has room for 18, and none is read");
    count = 0;
  }
  const bool has_long_labels = head.Word(c3d_header::kEventKey) == kC3dKey;
  const size_t label_size = has_long_labels ? 4 : 2;
  if (count > 0 && !has_long_labels) {
    recording.Note("short_event_labels", "byte 298",
                   "the key for labels of four letters is absent; labels have two");
  }
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<size_t>(i);
    std::string label = head.header.substr(c3d_header::kEventLabels + label_size * k, label_size);
    label.erase(label.find_last_not_of(std::string(" \0", 2)) + 1);
    // Header times count from the first stored frame, those of EVENT from frame 1.
    recording.events.push_back({label, "",
                                recording.start_time + head.Float(c3d_header::kEventTimes + 4 * k),
                                EventSource::kHeader});
  }
  if (head.Word(c3d_header::kLabelRangeKey) == kC3dKey) {
    recording.Note("label_range_section", "byte 294",
                   "a label and range section is announced at block " +
                       std::to_string(head.Word(c3d_header::kLabelRangeBlock)) +
                       "; its content was never specified and is not read");
  }
}

Recording ImportC3d(const ImportSource& source, const ImportOptions& options) {
  Recording recording;
  const C3dHead head = ReadC3dHead(source.stream, source.name);
  const C3dParameters parameters(head.section, head.position, head.processor, source.name);
  recording.findings = parameters.findings();
  const C3dLayout layout = FindC3dLayout(head, parameters, options, source.name, recording);
  recording.processor =
      std::string(NameOf(head.processor)) + (layout.is_float ? " float" : " integer");
  recording.rate = layout.rate;
  recording.first_frame = layout.first_frame;
  recording.num_frames = layout.num_frames;
  recording.start_time = (layout.first_frame - 1) / layout.rate;
  MakePoints(parameters, options, layout, recording);
  const std::vector<AnalogScale> scales = MakeAnalog(parameters, layout, recording);
  if (layout.num_frames > 0) {
    ResidualCounts counts;
    DecodeData(head.processor, source.stream, layout, scales, source.name, recording, counts);
    SettleStates(options, counts, recording);
  }
  ReadEventGroup(parameters, recording);
  ReadHeaderEvents(head, recording);
  if (parameters.HasGroup("ROTATION")) {
    recording.Note("rotations_skipped", "ROTATION", "rotation data are present and not read");
  }
  std::string personal;
  for (const C3dParameter* parameter : FindPersonalParameters(parameters)) {
    personal += (personal.empty() ? "" : ", ") + parameter->Name();
  }
  if (!personal.empty()) {
    recording.Note("personal_data", personal,
                   "text about a person or a date (graspbench mocap redact blanks it)");
  }
  return recording;
}

}  // namespace

Importer MakeC3dImporter() {
  return {"c3d",
          "C3D",
          {".c3d"},
          [](std::string_view head) {
            return head.size() >= 2 && static_cast<uint8_t>(head[1]) == kC3dMark &&
                   static_cast<uint8_t>(head[0]) >= 2;
          },
          ImportC3d,
          RedactC3d};
}

}  // namespace graspbench
