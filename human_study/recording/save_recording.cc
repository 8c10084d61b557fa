#include "human_study/recording/save_recording.h"

#include <charconv>
#include <ostream>
#include <sstream>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/csv.h"
#include "core/base/units.h"
#include "human_study/recording/c3d_writer.h"

namespace graspbench {
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
    if (c == '\t' || c == ',' || c == '"' || c == '\n' || c == '\r') c = '_';
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
