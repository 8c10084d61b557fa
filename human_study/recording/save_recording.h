#pragma once
/** @file
Writes a recording in the format given by the extension of the file name.

    name   what it is                           what is lost
    .c3d   C3D, Intel, floating point           nothing; uneven time stamps are refused
           (C3dWriteOptions)
    .tsv   Qualisys TSV, millimetres            analog channels, contexts of events; filled samples
                                                make a trajectory "Mixed"
    .csv   plain table: frame, time_s, then     analog channels, events
           <label>_x_m, _y_m, _z_m, _state */

#include <filesystem>
#include <iosfwd>

#include "human_study/recording/importers/c3d_parameters.h"
#include "human_study/recording/recording.h"

namespace graspbench {

/** Writes the file. Points that are not positions (angles, forces) are left out.
@returns the number of points left out.
@throws Error(kUsage) for another extension, Error(kUnsupported) when the format cannot hold the
recording, Error(kFormat) when no point has a known length unit, Error(kIo). */
size_t SaveRecording(const std::filesystem::path& path, const Recording& recording);

void WriteQualisysTsv(std::ostream& out, const Recording& recording);
void WritePlainCsv(std::ostream& out, const Recording& recording);

/** Writes a recording as C3D, in any variant of the format.

Coordinates, residual states, analog channels, events and labels survive; floating point keeps every
bit, integers are rounded to `scale`. The file contains no personal data. Above 65,535 frames the
counts of the header saturate; POINT:LONG_FRAMES and TRIAL:ACTUAL_END_FIELD then hold the true
values. Above 255 points or channels the arrays continue in LABELS2, LABELS3, .. Points that are not
positions are left out. */
struct C3dWriteOptions {
  C3dProcessor processor = C3dProcessor::kIntel;
  bool is_float = true;
  /** Length of an integer step, in the recording's unit; 0: the range divided by 32,000. */
  double scale = 0.0;
  /** Stores integer analog data as unsigned 16 bit, with ANALOG:FORMAT and an offset of 32,768. */
  bool analog_is_unsigned = false;
  int parameter_block = 2;
};

/** @throws Error(kUnsupported) when the format cannot hold the recording: uneven times, no frames,
no rate, points in different units, analog rates that are not multiples of the rate, more than
65,535 points.
@throws Error(kIo). */
void WriteC3d(std::ostream& out, const Recording& recording, const C3dWriteOptions& options = {});

}  // namespace graspbench
