#include "human_study/recording/save_recording.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ostream>
#include <sstream>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/csv.h"
#include "core/base/units.h"

namespace graspbench {

namespace {

constexpr size_t kMaxEntries = 255;  // of one dimension of a parameter

/** Appends records of the parameter section. */
class ParameterWriter {
 public:
  explicit ParameterWriter(C3dProcessor processor) : processor_(processor) {}

  void Group(int id, const std::string& name) {
    group_ = id;
    Start(-id, name);
    AppendC3dWord(bytes_, processor_, 3);
    bytes_ += '\0';  // no description
  }
  void Words(const std::string& name, const std::vector<uint16_t>& values, bool is_array = true) {
    Numbers(name, 2, values, is_array,
            [this](uint16_t v) { AppendC3dWord(bytes_, processor_, v); });
  }
  void Word(const std::string& name, size_t value) {
    Words(name, {static_cast<uint16_t>(std::min<size_t>(value, kC3dMaxCount))}, false);
  }
  void Floats(const std::string& name, const std::vector<float>& values, bool is_array = true) {
    Numbers(name, 4, values, is_array, [this](float v) { AppendC3dFloat(bytes_, processor_, v); });
  }
  void Float(const std::string& name, double value) {
    Floats(name, {static_cast<float>(value)}, false);
  }
  /** Minutes and seconds, 2 x N. */
  void Times(const std::string& name, const std::vector<double>& times) {
    for (size_t first = 0, part = 1; first < times.size(); first += kMaxEntries, ++part) {
      const size_t count = std::min(kMaxEntries, times.size() - first);
      Start(group_, PartName(name, part));
      AppendC3dWord(bytes_, processor_, static_cast<uint16_t>(2 + 4 + 8 * count + 1));
      bytes_ += {4, 2, 2, static_cast<char>(count)};
      for (size_t i = first; i < first + count; ++i) {
        const double minutes = std::floor(times[i] / 60.0);
        AppendC3dFloat(bytes_, processor_, static_cast<float>(minutes));
        AppendC3dFloat(bytes_, processor_, static_cast<float>(times[i] - 60.0 * minutes));
      }
      bytes_ += '\0';
    }
  }
  void Texts(const std::string& name, const std::vector<std::string>& texts) {
    for (size_t first = 0, part = 1; first < texts.size(); first += kMaxEntries, ++part) {
      const size_t count = std::min(kMaxEntries, texts.size() - first);
      size_t length = 1;
      for (const std::string& text : texts) length = std::max(length, text.size());
      length = std::min<size_t>(length, 127);
      Start(group_, PartName(name, part));
      AppendC3dWord(bytes_, processor_, static_cast<uint16_t>(2 + 4 + length * count + 1));
      bytes_ += {-1, 2, static_cast<char>(length), static_cast<char>(count)};
      for (size_t i = first; i < first + count; ++i) {
        std::string text = texts[i];
        text.resize(length, ' ');
        bytes_ += text;
      }
      bytes_ += '\0';
    }
  }
  /** The whole section, padded to blocks. */
  std::string Finish() const {
    std::string section = bytes_;
    section += std::string(2, '\0');
    section.resize((section.size() + 4 + kC3dBlock - 1) / kC3dBlock * kC3dBlock - 4);
    const size_t num_blocks = (section.size() + 4) / kC3dBlock;
    const char head[4] = {1, static_cast<char>(kC3dMark),
                          static_cast<char>(std::min<size_t>(num_blocks, 255)),
                          static_cast<char>(processor_)};
    return std::string(head, 4) + section;
  }

 private:
  static std::string PartName(const std::string& name, size_t part) {
    return part == 1 ? name : name + std::to_string(part);
  }
  void Start(int id, const std::string& name) {
    bytes_ += static_cast<char>(name.size());
    bytes_ += static_cast<char>(id);
    bytes_ += name;
  }
  template <class T, class Append>
  void Numbers(const std::string& name, int type, const std::vector<T>& values, bool is_array,
               Append append) {
    for (size_t first = 0, part = 1; first < values.size(); first += kMaxEntries, ++part) {
      const size_t count = std::min(kMaxEntries, values.size() - first);
      Start(group_, PartName(name, part));
      const size_t size = static_cast<size_t>(type) * count;
      AppendC3dWord(bytes_, processor_, static_cast<uint16_t>(2 + 2 + is_array + size + 1));
      bytes_ += static_cast<char>(type);
      bytes_ += static_cast<char>(is_array);
      if (is_array) bytes_ += static_cast<char>(count);
      for (size_t i = first; i < first + count; ++i) append(values[i]);
      bytes_ += '\0';
    }
  }

  C3dProcessor processor_;
  int group_ = 0;
  std::string bytes_;
};

/** How analog values are stored: physical = (stored - offset) * scale. */
struct StoredChannel {
  float scale = 1.0f;
  int offset = 0;
};

struct Plan {
  C3dWriteOptions options;
  std::vector<const RecordedPoint*> points;
  size_t samples_per_frame = 0;
  double scale = 1.0;
  std::vector<StoredChannel> channels;
};

[[noreturn]] void Refuse(const std::string& text) {
  throw Error(ErrorKind::kUnsupported, "cannot write C3D: " + text);
}

Plan MakePlan(const Recording& recording, const C3dWriteOptions& options) {
  Plan plan;
  plan.options = options;
  plan.scale = options.scale;
  if (recording.num_frames == 0) Refuse("the recording holds no frames");
  if (!std::isfinite(recording.rate)) Refuse("the recording states no rate");
  if (recording.first_frame < 0) Refuse("frames are numbered from below 0");
  if (!recording.times.empty()) {
    Refuse("the recording has uneven time stamps; resample it first");
  }
  if (recording.points.size() > kC3dMaxCount || recording.analog.size() > kC3dMaxCount) {
    Refuse("more than 65,535 points or channels");
  }
  float largest = 0.0f;
  for (const RecordedPoint& point : recording.points) {
    if (!point.IsLength()) continue;
    plan.points.push_back(&point);
    if (point.unit != plan.points[0]->unit) {
      Refuse("points have different units (\"" + plan.points[0]->unit + "\" and \"" + point.unit +
             "\" of " + point.label + ")");
    }
    for (const float value : point.xyz) {
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    }
  }
  if (plan.scale <= 0) plan.scale = largest > 0 ? largest / 32000.0 : 1.0;
  for (const AnalogChannel& channel : recording.analog) {
    const double ratio = channel.rate / recording.rate;
    const auto samples = static_cast<size_t>(std::lround(ratio));
    if (!(std::abs(ratio - std::round(ratio)) < 1e-6) || samples == 0 ||
        channel.samples.size() != samples * recording.num_frames ||
        (plan.samples_per_frame != 0 && samples != plan.samples_per_frame)) {
      Refuse("channel " + channel.label +
             " does not have the same whole number of samples in every frame");
    }
    plan.samples_per_frame = samples;
    StoredChannel stored;
    if (!options.is_float) {
      float peak = 0.0f;
      for (const float value : channel.samples) {
        if (std::isfinite(value)) peak = std::max(peak, std::abs(value));
      }
      stored.scale = peak > 0 ? peak / 32000.0f : 1.0f;
      stored.offset = options.analog_is_unsigned ? 32768 : 0;
    }
    plan.channels.push_back(stored);
  }
  return plan;
}

void FormatAnalogGroup(const Recording& recording, const Plan& plan, ParameterWriter& out) {
  std::vector<std::string> labels, units;
  std::vector<float> scales;
  std::vector<uint16_t> offsets;
  for (size_t c = 0; c < recording.analog.size(); ++c) {
    labels.push_back(recording.analog[c].label);
    units.push_back(recording.analog[c].unit);
    scales.push_back(plan.channels[c].scale);
    offsets.push_back(static_cast<uint16_t>(plan.channels[c].offset));
  }
  out.Group(2, "ANALOG");
  out.Word("USED", recording.analog.size());
  if (recording.analog.empty()) return;
  out.Float("RATE", recording.rate * static_cast<double>(plan.samples_per_frame));
  out.Float("GEN_SCALE", 1.0);
  out.Texts("LABELS", labels);
  out.Texts("UNITS", units);
  out.Floats("SCALE", scales);
  out.Words("OFFSET", offsets);
  if (plan.options.analog_is_unsigned) out.Texts("FORMAT", {"UNSIGNED"});
}

std::string FormatParameters(const Recording& recording, const Plan& plan, size_t data_block) {
  ParameterWriter out(plan.options.processor);
  std::vector<std::string> labels;
  for (const RecordedPoint* point : plan.points) labels.push_back(point->label);
  out.Group(1, "POINT");
  out.Word("USED", plan.points.size());
  out.Float("SCALE", plan.options.is_float ? -plan.scale : plan.scale);
  out.Float("RATE", recording.rate);
  out.Word("DATA_START", data_block);
  out.Word("FRAMES", recording.num_frames);
  if (recording.num_frames > kC3dMaxCount) {
    out.Float("LONG_FRAMES", static_cast<double>(recording.num_frames));
  }
  out.Texts("LABELS", labels);
  out.Texts("UNITS", {plan.points.empty() ? "" : plan.points[0]->unit});
  FormatAnalogGroup(recording, plan, out);

  const auto halves = [](size_t n) {
    return std::vector<uint16_t>{static_cast<uint16_t>(n & 0xffff), static_cast<uint16_t>(n >> 16)};
  };
  const auto first = static_cast<size_t>(recording.first_frame);
  out.Group(3, "TRIAL");
  out.Words("ACTUAL_START_FIELD", halves(first));
  out.Words("ACTUAL_END_FIELD", halves(first + recording.num_frames - 1));

  std::vector<std::string> event_labels, contexts;
  std::vector<double> times;
  for (const RecordedEvent& event : recording.events) {
    if (event.source != EventSource::kEventGroup) continue;
    event_labels.push_back(event.label);
    contexts.push_back(event.context);
    times.push_back(event.time);
  }
  if (!times.empty()) {
    out.Group(4, "EVENT");
    out.Word("USED", times.size());
    out.Texts("LABELS", event_labels);
    out.Texts("CONTEXTS", contexts);
    out.Times("TIMES", times);
  }
  return out.Finish();
}

std::string FormatHeader(const Recording& recording, const Plan& plan, size_t data_block) {
  const C3dProcessor processor = plan.options.processor;
  std::string header(kC3dBlock, '\0');
  const auto put_word = [&](size_t at, size_t value) {
    std::string bytes;
    AppendC3dWord(bytes, processor, static_cast<uint16_t>(std::min<size_t>(value, kC3dMaxCount)));
    header.replace(at, 2, bytes);
  };
  const auto put_float = [&](size_t at, double value) {
    std::string bytes;
    AppendC3dFloat(bytes, processor, static_cast<float>(value));
    header.replace(at, 4, bytes);
  };
  const auto first = static_cast<size_t>(recording.first_frame);
  header[0] = static_cast<char>(plan.options.parameter_block);
  header[1] = static_cast<char>(kC3dMark);
  put_word(c3d_header::kPoints, plan.points.size());
  put_word(c3d_header::kAnalogPerFrame, recording.analog.size() * plan.samples_per_frame);
  put_word(c3d_header::kFirstFrame, first);
  put_word(c3d_header::kLastFrame, first + recording.num_frames - 1);
  put_float(c3d_header::kScale, plan.options.is_float ? -plan.scale : plan.scale);
  put_word(c3d_header::kDataStart, data_block);
  put_word(c3d_header::kAnalogSamples, plan.samples_per_frame);
  put_float(c3d_header::kRate, recording.rate);
  put_word(c3d_header::kEventKey, kC3dKey);
  size_t num_events = 0;
  for (const RecordedEvent& event : recording.events) {
    if (event.source != EventSource::kHeader || num_events == kC3dMaxHeaderEvents) continue;
    put_float(c3d_header::kEventTimes + 4 * num_events, event.time - recording.start_time);
    std::string label = event.label;
    label.resize(4, ' ');
    header.replace(c3d_header::kEventLabels + 4 * num_events, 4, label);
    ++num_events;
  }
  put_word(c3d_header::kEventCount, num_events);
  return header;
}

/** Appends a value as float or as the nearest integer. */
void AppendValue(std::string& row, const Plan& plan, float value, double scale, int offset) {
  if (!std::isfinite(value)) value = 0.0f;
  if (plan.options.is_float) {
    AppendC3dFloat(row, plan.options.processor, value);
    return;
  }
  const int low = offset > 0 ? 0 : -32768, high = offset > 0 ? 65535 : 32767;
  const auto stored =
      static_cast<int>(std::clamp<double>(std::nearbyint(value / scale) + offset, low, high));
  AppendC3dWord(row, plan.options.processor, static_cast<uint16_t>(stored));
}

void AppendPoint(std::string& row, const Plan& plan, const RecordedPoint& point, size_t frame) {
  // Steps of the residual: at least 1 for a measured sample, because 0 means computed.
  int residual = point.states[frame] == SampleState::kInvalid ? -1 : 0;
  if (point.states[frame] == SampleState::kMeasured) {
    const double steps = point.residuals.empty() ? 1.0 : point.residuals[frame] / plan.scale;
    residual = static_cast<int>(std::clamp(std::nearbyint(steps), 1.0, 255.0));
  }
  for (int k = 0; k < 3; ++k) {
    AppendValue(row, plan, point.xyz[3 * frame + static_cast<size_t>(k)], plan.scale, 0);
  }
  if (plan.options.is_float) {
    AppendC3dFloat(row, plan.options.processor, static_cast<float>(residual));
  } else {
    AppendC3dWord(row, plan.options.processor, static_cast<uint16_t>(residual));
  }
}

}  // namespace

void WriteC3d(std::ostream& out, const Recording& recording, const C3dWriteOptions& options) {
  const Plan plan = MakePlan(recording, options);
  const auto first_block = static_cast<size_t>(options.parameter_block);
  const size_t num_blocks = FormatParameters(recording, plan, 0).size() / kC3dBlock;
  const size_t data_block = first_block + num_blocks;
  if (num_blocks > 255) Refuse("its labels need more than 255 blocks of parameters");
  std::string header = FormatHeader(recording, plan, data_block);
  header.resize((first_block - 1) * kC3dBlock, '\0');
  out << header << FormatParameters(recording, plan, data_block);
  size_t written = 0;
  std::string row;
  for (size_t frame = 0; frame < recording.num_frames; ++frame) {
    row.clear();
    for (const RecordedPoint* point : plan.points) AppendPoint(row, plan, *point, frame);
    for (size_t k = 0; k < plan.samples_per_frame; ++k) {
      for (size_t c = 0; c < recording.analog.size(); ++c) {
        AppendValue(row, plan, recording.analog[c].samples[frame * plan.samples_per_frame + k],
                    plan.channels[c].scale, plan.channels[c].offset);
      }
    }
    out << row;
    written += row.size();
  }
  out << std::string((kC3dBlock - written % kC3dBlock) % kC3dBlock, '\0');
  if (!out) throw Error(ErrorKind::kIo, "cannot write the C3D file; is the disk full?");
}

namespace {

/** Shortest text that reads back as the same number. */
template <class T>
std::string FormatExact(T value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

/** To the nanosecond: the last bits of a product are no information. */
std::string FormatTime(double time) { return FormatExact(std::round(time * 1e9) / 1e9); }

std::vector<const RecordedPoint*> FindPositions(const Recording& recording) {
  std::vector<const RecordedPoint*> positions;
  for (const RecordedPoint& point : recording.points) {
    if (point.IsLength()) positions.push_back(&point);
  }
  return positions;
}

/** A label must not break the table it names a column of, nor be run by a spreadsheet. */
std::string CleanLabel(std::string label) {
  for (char& c : label) {
    if (c == '\t' || c == ',' || c == ';' || c == '"' || c == '\n' || c == '\r') c = '_';
  }
  const std::string heading = label + "_x";  // "-5" alone is a number
  if (GuardCell(heading) != heading) label[0] = '_';
  return label;
}

int64_t FrameNumber(const Recording& recording, size_t frame) {
  return recording.first_frame + static_cast<int64_t>(frame);
}

}  // namespace

void WriteQualisysTsv(std::ostream& out, const Recording& recording) {
  if (!recording.times.empty()) {
    throw Error(ErrorKind::kUnsupported,
                "cannot write Qualisys TSV: the recording has uneven time stamps; write .csv or "
                "resample it first");
  }
  const std::vector<const RecordedPoint*> positions = FindPositions(recording);
  out << "NO_OF_FRAMES\t" << recording.num_frames << "\nNO_OF_CAMERAS\t0\nNO_OF_MARKERS\t"
      << positions.size() << "\nFREQUENCY\t" << FormatExact(recording.rate)
      << "\nNO_OF_ANALOG\t0\nANALOG_FREQUENCY\t0\nDESCRIPTION\t--\nTIME_STAMP\t--\n"
         "DATA_INCLUDED\t3D\n";
  for (const RecordedEvent& event : recording.events) {
    const double frame =
        recording.first_frame + (event.time - recording.start_time) * recording.rate;
    out << "EVENT\t" << CleanLabel(event.label) << '\t' << std::lround(frame) << '\t'
        << FormatTime(event.time) << '\n';
  }
  std::string names = "MARKER_NAMES", types = "TRAJECTORY_TYPES", heading = "Frame\tTime";
  for (const RecordedPoint* point : positions) {
    const std::string label = CleanLabel(point->label);
    names += '\t' + label;
    types += point->CountStates(SampleState::kFilled) > 0 ? "\tMixed" : "\tMeasured";
    heading += '\t' + label + " X\t" + label + " Y\t" + label + " Z";
  }
  out << names << '\n' << types << '\n' << heading << '\n';
  for (size_t frame = 0; frame < recording.num_frames; ++frame) {
    std::string row =
        std::to_string(FrameNumber(recording, frame)) + '\t' + FormatTime(recording.Time(frame));
    for (const RecordedPoint* point : positions) {
      const bool is_valid = point->states[frame] != SampleState::kInvalid;
      const Eigen::Vector3d p = point->Position(frame);
      for (int k = 0; k < 3; ++k) {
        row += '\t';
        if (is_valid) row += FormatExact(static_cast<float>(MmFromM(p[k])));
      }
    }
    out << row << '\n';
  }
}

void WritePlainCsv(std::ostream& out, const Recording& recording) {
  const std::vector<const RecordedPoint*> positions = FindPositions(recording);
  std::string heading = "frame,time_s";
  for (const RecordedPoint* point : positions) {
    const std::string label = CleanLabel(point->label);
    heading += ',' + label + "_x_m," + label + "_y_m," + label + "_z_m," + label + "_state";
  }
  out << heading << '\n';
  for (size_t frame = 0; frame < recording.num_frames; ++frame) {
    const double time = recording.Time(frame);
    std::string row = std::to_string(FrameNumber(recording, frame)) + ',' +
                      (std::isfinite(time) ? FormatTime(time) : "");
    for (const RecordedPoint* point : positions) {
      const bool is_valid = point->states[frame] != SampleState::kInvalid;
      const Eigen::Vector3d p = point->Position(frame);
      for (int k = 0; k < 3; ++k) {
        row += ',';
        if (is_valid) row += FormatExact(static_cast<float>(p[k]));
      }
      row += ',';
      row += NameOf(point->states[frame]);
    }
    out << row << '\n';
  }
}

size_t SaveRecording(const std::filesystem::path& path, const Recording& recording) {
  const std::string extension = path.extension().string();
  std::ostringstream out;
  CheckLengthUnits(recording, path.string());
  if (extension == ".c3d") {
    WriteC3d(out, recording);
  } else if (extension == ".tsv") {
    WriteQualisysTsv(out, recording);
  } else if (extension == ".csv") {
    WritePlainCsv(out, recording);
  } else {
    throw Error(ErrorKind::kUsage,
                "\"" + path.string() + "\": recordings are written as .c3d, .tsv or .csv");
  }
  WriteFileAtomically(path, out.str());
  return recording.points.size() - FindPositions(recording).size();
}

}  // namespace graspbench
