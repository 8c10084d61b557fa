#pragma once
/** @file
Doubts about a trial that its recording as a whole shows: labels that two markers exchange, frames that
an even clock hides, and digits that were not measured. */

#include <vector>

#include "human_study/events/doubts/plausibility.h"
#include "human_study/study/run/prepare_recording.h"

namespace graspbench {

/** - label_jump: two markers exchange their labels within the trial (exchanged_labels.h);
- frame_jump: frames are missing in two places of the trial, or 10 ms in one (lost_frames.h);
- constant_shape: three digits or more keep all their distances within 3 mm while they travel: a hand
  model that was placed, whose contacts mean nothing.
@param trial  a part of the recording. */
std::vector<Doubt> FindRecordingFaults(const PreparedRecording& recording, const ReachTrial& trial);

}  // namespace graspbench
