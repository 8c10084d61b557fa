/** @file
NDI N3D (Northern Digital, Optotrak): a header of 256 bytes (32, items, sub-items, frames, rate,
then texts), and 32-bit little-endian floats, frame by frame. -3.697314e28 marks a missing value.
Lengths are millimetres by NDI's convention; the file has neither unit nor labels. */

#include <algorithm>
#include <cctype>
#include <cmath>

#include "human_study/recording/importers/c3d_parameters.h"
#include "human_study/recording/importers/importer.h"

namespace graspbench {
namespace {

constexpr size_t kHeaderSize = 256;
constexpr size_t kTextStart = 13;
constexpr float kMissing = -3.6e28f;  // anything below

constexpr auto kIntel = C3dProcessor::kIntel;

bool RecognisesN3d(std::string_view head) {
  return head.size() >= kHeaderSize && head[0] == 32 && head[3] == 3 && head[4] == 0;
}

/** The number of frames to read of those promised, from what the file holds after its header. */
uint64_t SettleFrames(const ImportSource& source, const ImportOptions& options, uint64_t num_frames,
                      uint64_t frame_size, uint64_t available, Recording& recording) {
  const uint64_t file_size = kHeaderSize + available;
  if (num_frames * frame_size > available) {
    const uint64_t held = available / frame_size;
    const std::string text = "the header promises " + std::to_string(num_frames) +
                             " frames, the file holds " + std::to_string(held);
    if (!options.accept_truncated || held == 0) {
      FailAtByte(source.name, file_size,
                 text +
                     "; it is cut off or its count is wrong (--accept-truncated reads what is "
                     "there)");
    }
    recording.Note("truncated", "byte " + std::to_string(file_size), text + "; those are taken");
    return held;
  }
  if (num_frames * frame_size < available) {
    recording.Note("data_left_over",
                   "byte " + std::to_string(kHeaderSize + num_frames * frame_size),
                   std::to_string(available - num_frames * frame_size) +
                       " bytes follow the frames of the header; they are not read");
  }
  return num_frames;
}

Recording ImportN3d(const ImportSource& source, const ImportOptions& options) {
  std::istream& stream = source.stream;
  stream.seekg(0, std::ios::end);
  const auto file_size = static_cast<uint64_t>(stream.tellg());
  stream.seekg(0);
  uint8_t header[kHeaderSize];
  if (file_size < kHeaderSize) {
    FailAtByte(source.name, file_size, "the file ends here; an N3D header alone has 256 bytes");
  }
  stream.read(reinterpret_cast<char*>(header), kHeaderSize);
  if (header[0] != 32) {
    FailAtByte(source.name, 0,
               "found " + std::to_string(header[0]) + ", expected 32, the mark of an NDI file");
  }
  const size_t num_points = DecodeC3dWord<kIntel>(header + 1);
  const size_t num_values = DecodeC3dWord<kIntel>(header + 3);
  uint64_t num_frames = DecodeC3dWord<kIntel>(header + 5) +
                        65536u * static_cast<uint64_t>(DecodeC3dWord<kIntel>(header + 7));
  if (num_values != 3) {
    FailAtByte(source.name, 3,
               "each item has " + std::to_string(num_values) +
                   " values; only positions (3 values) can be read");
  }
  Recording recording;
  recording.rate = DecodeC3dFloat<kIntel>(header + 9);
  if (!(recording.rate > 0 && recording.rate < 1e6)) {
    FailAtByte(source.name, 9, "the rate is not a number above 0 Hz");
  }
  const uint64_t frame_size = 12 * num_points;
  num_frames =
      SettleFrames(source, options, num_frames, frame_size, file_size - kHeaderSize, recording);
  if (num_points == 0) num_frames = 0;
  recording.num_frames = static_cast<size_t>(num_frames);
  recording.points.resize(num_points);
  for (size_t i = 0; i < num_points; ++i) {
    recording.points[i].label = "marker_" + std::to_string(i + 1);
    recording.points[i].Resize(recording.num_frames);
  }
  recording.Note("missing_label", "file", "the format has no labels; markers are numbered from 1");
  SetLengthUnit(recording, options.unit.empty() ? "mm" : options.unit, "file");
  if (options.unit.empty()) {
    recording.Note("unit_by_convention", "file",
                   "no unit is stated; millimetres, NDI's own unit, are taken (--unit changes it)");
  }
  std::vector<uint8_t> row(static_cast<size_t>(frame_size));
  for (size_t frame = 0; frame < recording.num_frames; ++frame) {
    stream.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(row.size()));
    if (!stream) throw Error(ErrorKind::kIo, "cannot read the data of \"" + source.name + "\"");
    for (size_t i = 0; i < num_points; ++i) {
      float p[3];
      for (size_t k = 0; k < 3; ++k) p[k] = DecodeC3dFloat<kIntel>(&row[4 * (3 * i + k)]);
      if (p[0] < kMissing || p[1] < kMissing || p[2] < kMissing) continue;  // stays invalid
      recording.points[i].SetMeasured(frame, p[0], p[1], p[2]);
    }
  }
  return recording;
}

/** The rest of the header holds a comment, the time and the date of recording. */
std::vector<PersonalField> RedactN3d(std::string& bytes, const std::string& name) {
  if (bytes.size() < kHeaderSize) FailAtByte(name, bytes.size(), "the file ends in its header");
  std::vector<PersonalField> fields;
  for (size_t i = kTextStart; i < kHeaderSize;) {
    size_t end = i;
    while (end < kHeaderSize && bytes[end] >= 32 && bytes[end] < 127) ++end;
    std::string text = bytes.substr(i, end - i);
    text.erase(text.find_last_not_of(' ') + 1);
    if (text.size() > 2) fields.push_back({"byte " + std::to_string(i), text});
    std::fill(bytes.begin() + static_cast<long>(i), bytes.begin() + static_cast<long>(end), ' ');
    i = end + 1;
  }
  return fields;
}

}  // namespace

Importer MakeN3dImporter() {
  return {"n3d", "NDI N3D", {".n3d"}, RecognisesN3d, ImportN3d, RedactN3d};
}

}  // namespace graspbench
