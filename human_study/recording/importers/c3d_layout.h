#pragma once
/** @file
Where a C3D file's data lie and how many there are, from places that contradict each other.

The same counts stand in the header, in the parameters and in the file's size. The rules of choice
are in the source; each contradiction becomes a finding. */

#include <cstdint>
#include <string>

#include "human_study/recording/importers/c3d_parameters.h"
#include "human_study/recording/importers/importer.h"

namespace graspbench {

struct C3dLayout {
  size_t num_points = 0;
  size_t num_channels = 0;
  size_t samples_per_frame = 0;  ///< of each analog channel
  bool is_float = false;
  double scale = 1.0;  ///< units of length per integer step; of the residual in every file
  uint64_t data_position = 0;
  size_t num_frames = 0;
  int first_frame = 1;
  double rate = 0.0;  ///< [Hz]; NaN when not stated

  size_t num_analog() const { return num_channels * samples_per_frame; }
  size_t value_size() const { return is_float ? 4 : 2; }
  size_t frame_size() const { return (4 * num_points + num_analog()) * value_size(); }
};

/** Notes go to `recording.findings`. The layout never reaches past the end of the file.
@throws Error(kFormat) with the byte where the data should go on, when the file holds fewer frames
than every count says and options.accept_truncated is not set. */
C3dLayout FindC3dLayout(const C3dHead& head, const C3dParameters& parameters,
                        const ImportOptions& options, const std::string& file,
                        Recording& recording);

}  // namespace graspbench
