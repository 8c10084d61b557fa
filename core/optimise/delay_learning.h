#pragma once
/** @file
Step 1, what no pre-grasp reaches: each digit waits at the start of closure until the others come.
With m_d the median over trials of digit d's first contact and M the largest of them,

    delay_d <- delay_d + gain (M - m_d),   then less the least of them

so that GFT% comes to its floor (core/grasp/gft_floor.h) when the delayed digits meet the object
where they met it before. They need not: what a digit no longer pushes lies elsewhere. So the rule is
used twice, the second time with half the gain, and the better of both is kept. A digit that never
touched keeps its delay. Proposed by graspbench. */

#include <map>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/optimise/learning_trial.h"

namespace graspbench {

/** The closing schedules of the grasp after `trials` of it; those of its digits that need none are
left out. Its speeds stay. */
std::map<std::string, ClosingSchedule> LearnDelays(const Grasp& grasp,
                                                   const std::vector<LearningTrial>& trials,
                                                   double gain);

/** "TH waits 88 ms, FF 26 ms"; empty where no digit waits. */
std::string DescribeDelays(const Grasp& grasp);

}  // namespace graspbench
