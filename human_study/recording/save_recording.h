#pragma once
/** @file
Writes a recording in the format its file name asks for.

    name   what it is                           what is lost
    .c3d   C3D, Intel, floating point           nothing; uneven time stamps are refused
           (c3d_writer.h)
    .tsv   Qualisys TSV, millimetres            analog channels, contexts of events; filled samples
                                                make a trajectory "Mixed"
    .csv   plain table: frame, time_s, then     analog channels, events
           <label>_x_m, _y_m, _z_m, _state */

#include <filesystem>
#include <iosfwd>

#include "human_study/recording/recording.h"

namespace graspbench {

/** Points that are no positions (angles, forces) are left out.
@returns how many were.
@throws Error(kUsage) for another extension, Error(kUnsupported) when the format cannot hold the
recording, Error(kFormat) when no point has a known length unit, Error(kIo). */
size_t SaveRecording(const std::filesystem::path& path, const Recording& recording);

void WriteQualisysTsv(std::ostream& out, const Recording& recording);
void WritePlainCsv(std::ostream& out, const Recording& recording);

}  // namespace graspbench
