#pragma once
/** @file
When the phases of reach and grasp begin and end: medians over trials, as shares of the time from
the onset to the lift-off. Transport: fast approach, slow approach (from the re-acceleration to the
end of the movement), lift-off. Grasp: pre-grasp (to the widest opening), closure (to the last
contact), stabilisation (to the lift-off). Source of the phases: the thesis, figure 2.1, after
Jeannerod (1984). */

#include <array>
#include <cstddef>
#include <vector>

namespace graspbench {

struct StudyTrial;

/** Instants that begin or end a phase. */
enum PhaseInstant { kOnset, kPeakOpening, kSlowApproach, kMovementEnd, kLastContact, kLiftOff };
inline constexpr size_t kNumPhaseInstants = 6;
/** Of one trial, by PhaseInstant, on any clock [s]; NaN: not found. */
using PhaseTimes = std::array<double, kNumPhaseInstants>;

struct PhaseCourse {
  std::array<double, kNumPhaseInstants> at{};  ///< share, by PhaseInstant; NaN: no trial has it
  std::array<int, kNumPhaseInstants> num_trials{};  ///< that have it, with onset and lift-off
};

/** Trials without onset or lift-off take no part. */
PhaseCourse SummarisePhases(const std::vector<PhaseTimes>& trials);
/** Of people. @param trials  those removed are left out. */
PhaseCourse SummarisePhases(const std::vector<StudyTrial>& trials);

}  // namespace graspbench
