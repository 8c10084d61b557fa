#pragma once
/** @file
Doubts about a trial that follow from its whole recording: labels that two markers exchange, frame
losses hidden by an even clock, and digits that were not measured. */

#include <vector>

#include "human_study/events/doubts/plausibility.h"
#include "human_study/study/run/prepare_recording.h"

namespace graspbench {

/** - label_jump: two markers exchange their labels within the trial (exchanged_labels.h);
- frame_jump: frames are missing in two places of the trial, or 10 ms in one (lost_frames.h);
- constant_shape: three digits or more keep all mutual distances within 3 mm while moving: a rigid
  hand model, whose contacts are meaningless.
@param trial  a part of the recording. */
std::vector<Doubt> FindRecordingFaults(const PreparedRecording& recording, const ReachTrial& trial);

}  // namespace graspbench
