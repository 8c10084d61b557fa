#pragma once
/** @file
GFT% and GOT% (core/grasp/contact_timing.h) of groups of trials, of robots and people alike, so that
both stand side by side as the same numbers. */

#include <string>
#include <vector>

#include "core/grasp/contact_timing.h"
#include "core/statistics/summary.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Ratios of a group of trials. */
struct TimingRatios {
  Answer<Summary> gft, got;
  int num_without_gft = 0;  ///< a digit never touched, or the closure took no time
};
TimingRatios SummariseTimings(const std::vector<ContactTiming>& timings);

/** A robot's trials of one hand: of all grasps (empty name) or one. */
struct TimingGroup {
  std::string hand, grasp;  ///< ids
  TimingRatios ratios;
};
/** By hand in the plan's order: all grasps, then each; a hand with one grasp has that alone. Trials
that failed numerically are left out. */
std::vector<TimingGroup> ListTimingGroups(const Session& session);

}  // namespace graspbench
