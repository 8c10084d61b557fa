#pragma once
/** @file
What is in a recording, for people (`graspbench mocap info`) and for programs (`--json`). */

#include <string>

#include "core/base/text/json.h"
#include "human_study/recording/recording.h"

namespace graspbench {

/** Keys: format, processor, points, frames, first_frame, rate_hz, duration_s, unit, labels,
invalid_samples and filled_samples (by label), analog_channels, analog_rate_hz, analog_labels,
events, findings, mean_m (by label: mean position over the valid samples [m], null without any). */
Json DescribeRecording(const Recording& recording);

/** The same as text, one fact a line. */
std::string FormatRecording(const Recording& recording);

}  // namespace graspbench
