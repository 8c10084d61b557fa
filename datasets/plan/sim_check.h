#pragma once
/** @file
Values of the simulation that contradict each other, in a session or a profile. */

#include <string>
#include <utility>
#include <vector>

#include "core/physics/sim_config.h"

namespace graspbench {

/** Keys ("sim.multibody") with what is wrong; empty: nothing. Ranges of single values are checked
where the keys are listed. */
std::vector<std::pair<std::string, std::string>> FindSimProblems(const SimConfig& sim);

}  // namespace graspbench
