#pragma once
/** @file
Doubts about a trial that follow from its whole recording: frame losses hidden by an even clock, and
digits that were not measured. */

#include <vector>

#include "human_study/events/doubts/plausibility.h"
#include "human_study/study/run/prepare_recording.h"

namespace graspbench {

/** - frame_jump: frames are missing in two places of the trial, or 10 ms in one (lost_frames.h);
- constant_shape: three digits or more keep all mutual distances within 3 mm while moving: a rigid
  hand model, whose contacts are meaningless.
@param trial  a part of the recording. */
std::vector<Doubt> FindRecordingFaults(const PreparedRecording& recording, const ReachTrial& trial);

}  // namespace graspbench
