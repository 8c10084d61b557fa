#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/text/text.h"
#include "core/base/whole_number.h"
#include "human_study/recording/importers/c3d_parameters.h"
#include "human_study/recording/importers/importer.h"

namespace graspbench {
namespace {

constexpr double kMaxFrames = 2147483647.0;

std::string FormatWhole(double value) { return std::to_string(ToWhole<int64_t>(value)); }

/** A whole number in [0, max], or NaN. */
double RoundCount(double value, double max) {
  const std::optional<size_t> count = FindCount(value, max);
  return count ? static_cast<double>(*count) : std::nan("");
}

/** The same of a parameter. */
double FindParameterCount(const C3dParameters& parameters, const char* group, const char* name,
                          double max = kC3dMaxCount) {
  const C3dParameter* parameter = parameters.Find(group, name);
  return RoundCount(parameter == nullptr ? std::nan("") : parameter->Unsigned(), max);
}

/** Two 16-bit halves, low first, as TRIAL stores frame numbers. */
double FindLongCount(const C3dParameters& parameters, const char* name) {
  const C3dParameter* parameter = parameters.Find("TRIAL", name);
  if (parameter == nullptr || parameter->num_numbers() < 2) return std::nan("");
  const double value =
      RoundCount(parameter->Unsigned(0) + 65536.0 * parameter->Unsigned(1), kMaxFrames);
  // 65,535 is what writers put that know no better (-1, 0).
  return value != kC3dMaxCount ? value : std::nan("");
}

void FindPointCount(const C3dHead& head, const C3dParameters& parameters, C3dLayout& layout,
                    Recording& recording) {
  const int in_header = head.Word(c3d_header::kPoints);
  const double used = FindParameterCount(parameters, "POINT", "USED");
  if (std::isnan(used)) {
    recording.Note("missing_parameter", "POINT:USED",
                   "absent; the header's " + FormatWhole(in_header) + " points are taken");
  } else if (used != in_header) {
    recording.Note("point_count_disputed", "POINT:USED",
                   "says " + FormatWhole(used) + " points, the header " + FormatWhole(in_header) +
                       "; the parameter is taken");
  }
  layout.num_points = ToWhole<size_t>(std::isnan(used) ? in_header : used);
}

void FindAnalogCount(const C3dHead& head, const C3dParameters& parameters, C3dLayout& layout,
                     Recording& recording) {
  const auto per_frame = static_cast<size_t>(head.Word(c3d_header::kAnalogPerFrame));
  const auto samples = static_cast<size_t>(head.Word(c3d_header::kAnalogSamples));
  const double used = FindParameterCount(parameters, "ANALOG", "USED");
  if (std::isnan(used) || (used == 0 && per_frame > 0)) {
    layout.samples_per_frame = samples > 0 ? samples : 1;
    layout.num_channels = per_frame / layout.samples_per_frame;
    if (per_frame > 0) {
      recording.Note("missing_parameter", "ANALOG:USED",
                     "absent or 0 although the header counts " + FormatWhole(per_frame) +
                         " analog values a frame; " + FormatWhole(layout.num_channels) +
                         " channels are taken");
    }
  } else {
    layout.num_channels = ToWhole<size_t>(used);
    layout.samples_per_frame = samples;
    if (layout.num_channels == 0) layout.samples_per_frame = 0;
    if (layout.num_analog() != per_frame) {
      const bool fits = layout.num_channels > 0 && per_frame % layout.num_channels == 0;
      const size_t taken = fits ? per_frame / layout.num_channels : samples;
      recording.Note("analog_count_disputed", "byte 5",
                     "the header counts " + FormatWhole(per_frame) +
                         " analog values a frame, but " + FormatWhole(used) + " channels of " +
                         FormatWhole(samples) + " samples; " + FormatWhole(taken) +
                         " samples a channel are taken");
      layout.samples_per_frame = taken;
    }
  }
}

void FindScale(const C3dHead& head, const C3dParameters& parameters, const std::string& file,
               C3dLayout& layout, Recording& recording) {
  const double in_header = head.Float(c3d_header::kScale);
  const C3dParameter* parameter = parameters.Find("POINT", "SCALE");
  double scale = parameter == nullptr ? std::nan("") : parameter->Number();
  if (!std::isfinite(scale) || scale == 0) {
    scale = in_header;
    if (layout.num_points > 0) {
      recording.Note(
          "missing_parameter", "POINT:SCALE",
          "absent, 0 or not a number; the header's " + std::to_string(in_header) + " is taken");
    }
  } else if (std::signbit(scale) != std::signbit(in_header)) {
    recording.Note("scale_disputed", "POINT:SCALE",
                   "is " + std::to_string(scale) + ", the header says " +
                       std::to_string(in_header) + "; the parameter decides that the data are " +
                       (scale < 0 ? "floating point" : "integers"));
  }
  if ((!std::isfinite(scale) || scale == 0) && layout.num_points > 0) {
    FailAtByte(file, c3d_header::kScale,
               "neither POINT:SCALE nor the header gives a scale factor, so integers and floating "
               "point cannot be told apart");
  }
  layout.is_float = scale < 0;
  layout.scale = std::abs(scale);
}

void FindRate(const C3dHead& head, const C3dParameters& parameters, C3dLayout& layout,
              Recording& recording) {
  const double in_header = head.Float(c3d_header::kRate);
  const C3dParameter* parameter = parameters.Find("POINT", "RATE");
  const double rate = parameter == nullptr ? std::nan("") : parameter->Number();
  // The bounds of every importer: what lies outside is no rate of a recording.
  const auto is_rate = [](double value) { return value >= 1e-6 && value <= 1e6; };
  layout.rate = is_rate(rate) ? rate : is_rate(in_header) ? in_header : std::nan("");
  if (!is_rate(rate)) {
    recording.Note("missing_parameter", "POINT:RATE",
                   is_rate(in_header) ? "absent, or not from 1e-06 to 1000000; the header's " +
                                            std::to_string(in_header) + " Hz is taken"
                                      : "absent, and the header has no rate either; times are "
                                        "missing, none is invented");
  } else if (is_rate(in_header) && std::abs(rate - in_header) > 1e-3 * rate) {
    recording.Note("rate_disputed", "POINT:RATE",
                   "says " + std::to_string(rate) + " Hz, the header " + std::to_string(in_header) +
                       " Hz; the parameter is taken");
  }
}

void FindDataPosition(const C3dHead& head, const C3dParameters& parameters, const std::string& file,
                      C3dLayout& layout, Recording& recording) {
  const int in_header = head.Word(c3d_header::kDataStart);
  const double parameter = FindParameterCount(parameters, "POINT", "DATA_START");
  const auto is_block = [&](double block) {
    return block >= 2 &&
           (block - 1) * static_cast<double>(kC3dBlock) <= static_cast<double>(head.file_size);
  };
  if (!is_block(in_header) && !is_block(parameter)) {
    if (layout.frame_size() == 0) {
      layout.data_position = head.file_size;
      return;
    }
    FailAtByte(
        file, c3d_header::kDataStart,
        "the data are said to start at block " + std::to_string(in_header) +
            ", which the file of " + std::to_string(head.file_size) + " bytes does not hold" +
            (std::isnan(parameter) ? "" : "; POINT:DATA_START says " + FormatWhole(parameter)));
  }
  const double taken = is_block(in_header) ? in_header : parameter;
  if (in_header != parameter && !std::isnan(parameter)) {
    recording.Note("data_start_disputed", "POINT:DATA_START",
                   "says block " + FormatWhole(parameter) + ", the header " +
                       FormatWhole(in_header) + "; " + FormatWhole(taken) + " is taken");
  }
  layout.data_position = (ToWhole<uint64_t>(taken) - 1) * kC3dBlock;
}

struct FrameCount {
  double count;
  double first;
  const char* where;
};

/** All places that count frames, best first, without those that say nothing. */
std::vector<FrameCount> FindFrameCounts(const C3dHead& head, const C3dParameters& parameters) {
  const double first = head.Word(c3d_header::kFirstFrame);
  const double last = head.Word(c3d_header::kLastFrame);
  const double start = FindLongCount(parameters, "ACTUAL_START_FIELD");
  const double end = FindLongCount(parameters, "ACTUAL_END_FIELD");
  std::vector<FrameCount> counts = {
      {end - start + 1, start, "TRIAL:ACTUAL_END_FIELD"},
      {FindParameterCount(parameters, "POINT", "LONG_FRAMES", kMaxFrames), first,
       "POINT:LONG_FRAMES"},
      {FindParameterCount(parameters, "POINT", "FRAMES", kMaxFrames), first, "POINT:FRAMES"},
      {last - first + 1, first, "the header"}};
  // A word cannot count above 65,535; where something counts higher, such a count is saturated.
  const bool is_long = std::any_of(counts.begin(), counts.end(),
                                   [](const FrameCount& c) { return c.count > kC3dMaxCount; });
  counts.erase(std::remove_if(counts.begin(), counts.end(),
                              [&](const FrameCount& c) {
                                return !(c.count >= 1) ||
                                       (is_long && std::abs(c.count - kC3dMaxCount) <= 1);
                              }),
               counts.end());
  return counts;
}

/** Whether 16-bit places may say this of `num_frames`: a count or a last frame that cannot grow
further, or a count that began at 0 again. */
bool IsSaturated(const FrameCount& c, uint64_t num_frames) {
  const auto is_most = [](double value) { return std::abs(value - kC3dMaxCount) <= 1; };
  return num_frames > kC3dMaxCount &&
         (is_most(c.count) || is_most(c.first + c.count - 1) ||
          num_frames % (kC3dMaxCount + 1) == ToWhole<uint64_t>(c.count));
}

/** The first count that fills the file exactly, up to the padding of the last block, is right;
when none does, the best place is believed. Where the only counts are 16-bit ones that a longer
recording exceeds, the size of the file counts (c3d.org, "Reading the frame count", lists the places
that a writer should have used; some use none of them). */
void FindFrames(const C3dHead& head, const C3dParameters& parameters, const ImportOptions& options,
                const std::string& file, C3dLayout& layout, Recording& recording) {
  layout.first_frame = head.Word(c3d_header::kFirstFrame);
  std::vector<FrameCount> counts = FindFrameCounts(head, parameters);
  const uint64_t available = head.file_size - layout.data_position;
  if (layout.frame_size() == 0 || (counts.empty() && available < layout.frame_size())) {
    recording.Note("no_data", "header",
                   layout.frame_size() == 0 ? "neither points nor analog channels are stored"
                                            : "no frames are stored");
    return;
  }
  if (counts.empty()) {
    FailAtByte(file, c3d_header::kFirstFrame,
               "the frames run from " + std::to_string(layout.first_frame) + " to " +
                   std::to_string(head.Word(c3d_header::kLastFrame)) +
                   " and no parameter counts them either");
  }
  const auto num_whole = available / layout.frame_size();
  const auto capacity = static_cast<double>(num_whole);
  const auto left_over = [&](const FrameCount& c) {
    return static_cast<double>(available) - c.count * static_cast<double>(layout.frame_size());
  };
  auto taken = std::find_if(counts.begin(), counts.end(), [&](const FrameCount& c) {
    return left_over(c) >= 0 && left_over(c) < static_cast<double>(kC3dBlock);
  });
  if (taken == counts.end() && std::all_of(counts.begin(), counts.end(), [&](const FrameCount& c) {
        return IsSaturated(c, num_whole);
      })) {
    recording.Note("frame_count_from_size", counts.front().where,
                   "says " + FormatWhole(counts.front().count) +
                       " frames, as many as 16 bits hold, the file holds " + FormatWhole(capacity) +
                       "; those are taken, of which the last ones may be padding");
    counts = {{capacity, counts.front().first, "the size of the file"}};
    taken = counts.begin();
  }
  if (taken == counts.end()) taken = counts.begin();
  if (taken->count > capacity) {
    const std::string text = taken->where + std::string(" promises ") + FormatWhole(taken->count) +
                             " frames of " + std::to_string(layout.frame_size()) +
                             " bytes, the file holds " + FormatWhole(capacity);
    if (!options.accept_truncated || capacity < 1) {
      FailAtByte(file, head.file_size,
                 text +
                     "; it is cut off or its counts are wrong (--accept-truncated reads what is "
                     "there)");
    }
    recording.Note("truncated", "byte " + std::to_string(head.file_size),
                   text + "; those are taken");
    taken->count = capacity;
  } else if (left_over(*taken) >= static_cast<double>(kC3dBlock)) {
    recording.Note("data_left_over",
                   "byte " + FormatWhole(static_cast<double>(head.file_size) - left_over(*taken)),
                   FormatWhole(left_over(*taken)) + " bytes follow the " +
                       FormatWhole(taken->count) + " frames of " + taken->where +
                       "; they are not read");
  }
  for (const FrameCount& c : counts) {
    if (c.count == taken->count) continue;
    recording.Note("frame_count_disputed", c.where,
                   "says " + FormatWhole(c.count) + " frames, " + taken->where + " " +
                       FormatWhole(taken->count) + ", which is taken by the size of the file");
  }
  layout.num_frames = ToWhole<size_t>(taken->count);
  layout.first_frame = ToWhole<int>(taken->first);
}

}  // namespace

C3dLayout FindC3dLayout(const C3dHead& head, const C3dParameters& parameters,
                        const ImportOptions& options, const std::string& file,
                        Recording& recording) {
  C3dLayout layout;
  FindPointCount(head, parameters, layout, recording);
  FindAnalogCount(head, parameters, layout, recording);
  FindScale(head, parameters, file, layout, recording);
  FindRate(head, parameters, layout, recording);
  FindDataPosition(head, parameters, file, layout, recording);
  FindFrames(head, parameters, options, file, layout, recording);
  return layout;
}

}  // namespace graspbench
