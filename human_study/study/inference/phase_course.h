#pragma once
/** @file
Start and end of the phases of reach and grasp: medians over trials, as shares of the time from the
onset to the lift-off. Transport: fast approach, slow approach (from the re-acceleration to the end
of the movement), lift-off. Grasp: pre-grasp (to the widest opening), closure (to the last contact),
stabilisation (to the lift-off). Source of the phases: the thesis, figure 2.1, after Jeannerod
(1984). */

#include <array>
#include <cstddef>
#include <vector>

namespace graspbench {

struct StudyTrial;

/** Instants at which phases begin or end. */
enum PhaseInstant { kOnset, kPeakOpening, kSlowApproach, kMovementEnd, kLastContact, kLiftOff };
inline constexpr size_t kNumPhaseInstants = 6;
/** Instants of one trial, by PhaseInstant, on any clock [s]; NaN: not found. */
using PhaseTimes = std::array<double, kNumPhaseInstants>;

struct PhaseCourse {
  std::array<double, kNumPhaseInstants> at{};  ///< share, by PhaseInstant; NaN: no trial has it
  std::array<int, kNumPhaseInstants> num_trials{};  ///< with it, onset and lift-off
};

/** Summarises trials; those without onset or lift-off are ignored. */
PhaseCourse SummarisePhases(const std::vector<PhaseTimes>& trials);
/** Summarises a study's trials. @param trials  removed ones are ignored. */
PhaseCourse SummarisePhases(const std::vector<StudyTrial>& trials);

}  // namespace graspbench
